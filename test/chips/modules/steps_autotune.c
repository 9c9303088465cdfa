// SPDX-License-Identifier: MIT
#include "calls_autotune.h"

int16_t autotune_ordinary_step(FIXPID_DATA struct fixpid_autotune *self,
                               int16_t setpoint, int16_t measurement)
{
    return fixpid_autotune_step(self, setpoint, measurement);
}

int16_t autotune_cycle_step(FIXPID_DATA struct fixpid_autotune *self,
                            int16_t setpoint, int16_t measurement)
{
    return fixpid_autotune_step(self, setpoint, measurement);
}
