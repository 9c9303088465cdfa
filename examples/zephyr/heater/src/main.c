// SPDX-License-Identifier: MIT
// The quick start under Zephyr. The boiler is simulated: read
// a converter and set a PWM in its place.
#include <zephyr/kernel.h>

#include "fixpid_pid.h"

#define PERIOD_MS 1000 // of a step

int main(void)
{
    const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1.0, 0.3, 0, FIXPID_PERIOD_MS(PERIOD_MS), 0),
        .output_min = 0,
        .output_max = 255}; // full power
    struct fixpid_pid heater;
    int heat = 0; // of the simulated boiler

    (void)fixpid_pid_init(&heater, &config);
    for (int second = 0; second <= 10; second++) {
        const int16_t tenths = (int16_t)(200 + (heat / 2)); // of a degree
        const int16_t power = fixpid_pid_step(&heater, 600, tenths);
        heat += power - (heat / 8);
        printk("%2d s: %d.%d C, power %3d\n", second, tenths / 10, tenths % 10,
               power);
        k_msleep(PERIOD_MS);
    }
    return 0;
}
