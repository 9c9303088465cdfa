// SPDX-License-Identifier: MIT
// The one file of the project that is compiled as C99, with those of src/.
#include "heater.h"

#include "fixpid_pid.h"

static struct fixpid_pid heater;

static const struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(2, 0.1, 0, 10, 0),
    .output_min = 0,
    .output_max = 1023};

int heater_init(void)
{
    return fixpid_pid_init(&heater, &config) ? 1 : 0;
}

int heater_step(int setpoint, int measurement)
{
    return fixpid_pid_step(&heater, (int16_t)setpoint, (int16_t)measurement);
}
