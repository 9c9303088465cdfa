// SPDX-License-Identifier: MIT
// The quick start as a task of ESP-IDF. The boiler is simulated:
// read a converter and set a PWM in its place.
#include <stdio.h>

#include "fixpid_pid.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"

#define PERIOD_MS 1000 // of a step

void app_main(void)
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
        (void)printf("%2d s: %d.%d C, power %3d\n", second, tenths / 10,
                     tenths % 10, power);
        vTaskDelay(pdMS_TO_TICKS(PERIOD_MS));
    }
}
