// SPDX-License-Identifier: MIT
#include "heater.h"

struct fixpid_pid heater;

bool heater_start(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0.1, 0, 10, 0),
        .output_min = 0,
        .output_max = 1023};

    return fixpid_pid_init(&heater, &config);
}

int16_t heater_step(int16_t temperature)
{
    return fixpid_pid_step(&heater, 600, temperature);
}
