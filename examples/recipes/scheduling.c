// SPDX-License-Identifier: MIT
// Gain scheduling: a process that is four times as strong above 500 counts gets
// other gains there, without a bump of the output at any error.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 3000

// recipe
static struct fixpid_pid pid;

static int16_t control(int16_t setpoint, int16_t measurement)
{
    static const struct fixpid_pid_gains low =
        FIXPID_PID_GAINS(4, 0.1, 0, 1, 0);
    static const struct fixpid_pid_gains high =
        FIXPID_PID_GAINS(1, 0.025, 0, 1, 0);
    static bool is_high = false;
    const bool was_high = is_high;

    // 20 counts of hysteresis, so that noise does not switch
    is_high = measurement > (was_high ? 490 : 510);
    if (is_high != was_high) {
        (void)fixpid_pid_set_gains(&pid, is_high ? &high : &low);
        fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
    }
    return fixpid_pid_step(&pid, setpoint, measurement);
}
// end of recipe

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(4, 0.1, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};
    struct plant_counts process = {.lag_steps = 40.0,
                                   .delay_steps = 2,
                                   .noise_counts = 1,
                                   .sensor_max = 4095.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &process);
    (void)printf("time_s,setpoint,value,output\n");
    for (int k = 0; k < STEPS; k++) {
        const int16_t setpoint = (int16_t)((k < STEPS / 3)       ? 400
                                           : (k < 2 * STEPS / 3) ? 800
                                                                 : 400);
        const int16_t output = control(setpoint, motion_read(&motion));
        // 1 count a count below 500, 4 above
        const double strength =
            (output < 500) ? output : 500 + 4.0 * (output - 500);
        process.gain = 1.0;
        motion_move(&motion, strength);
        (void)printf("%d,%d,%.6g,%d\n", k, setpoint, motion.value, output);
    }
    return 0;
}
