// SPDX-License-Identifier: MIT
// A step of fixpid_autotune, by what it does, so that each kind is metered.
#ifndef CALLS_AUTOTUNE_H
#define CALLS_AUTOTUNE_H
#include "fixpid_autotune.h"

int16_t autotune_ordinary_step(FIXPID_DATA struct fixpid_autotune *self,
                               int16_t setpoint, int16_t measurement);
int16_t autotune_cycle_step(FIXPID_DATA struct fixpid_autotune *self,
                            int16_t setpoint, int16_t measurement);

#endif
