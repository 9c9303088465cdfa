// SPDX-License-Identifier: MIT
// A broken sensor: readings at the ends of the converter. The drive goes off,
// and comes back without a jump when the sensor has been good for a second.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 6000 // 10 a second
#define BROKEN_FROM 2000
#define BROKEN_TO 2600

// recipe
static struct fixpid_pid pid;

#define READING_MIN 8
#define READING_MAX 1015
#define GOOD_STEPS 10

static int16_t control(int16_t setpoint, int16_t reading)
{
    static uint8_t good = GOOD_STEPS;

    if (reading < READING_MIN || reading > READING_MAX) {
        good = 0;
        fixpid_pid_set_manual(&pid, 0); // off, or what is safe
    } else if (good < GOOD_STEPS) {
        good++;
        if (good == GOOD_STEPS) {
            fixpid_pid_set_auto(&pid);
        }
    } else {
        // as always
    }
    return fixpid_pid_step(&pid, setpoint, reading);
}
// end of recipe

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0.05, 0, 10, 0),
        .output_min = 0,
        .output_max = 255};
    static const struct plant_counts oven = {.gain = 4.0,
                                             .lag_steps = 400.0,
                                             .delay_steps = 5,
                                             .noise_counts = 1,
                                             .sensor_max = 1023.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &oven);
    motion.value = 100.0; // the air
    (void)printf("time_s,setpoint,value,reading,output\n");
    for (int k = 0; k < STEPS; k++) {
        const bool broken = k >= BROKEN_FROM && k < BROKEN_TO;
        const int16_t reading = broken ? 1023 : motion_read(&motion);
        const int16_t output = control(600, reading);
        motion_move(&motion, output);
        (void)printf("%.1f,600,%.6g,%d,%d\n", k / 10.0, motion.value, reading,
                     output);
    }
    return 0;
}
