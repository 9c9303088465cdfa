/* SPDX-License-Identifier: MIT */
/* What the files in C90 see of the controller. */
#ifndef HEATER_H
#define HEATER_H

int heater_init(void);                          /* 0 if it was refused */
int heater_step(int setpoint, int measurement); /* ten times a second */

#endif
