// SPDX-License-Identifier: MIT
#ifndef HEATER_H
#define HEATER_H
#include "fixpid_pid.h"

extern struct fixpid_pid heater;

bool heater_start(void);
int16_t heater_step(int16_t temperature);

#endif
