// SPDX-License-Identifier: MIT
// Another sample time while the loop runs: 10 steps a second, then 2. ki and kd
// belong to the rate, kp does not. The seed carries the output over.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define TENTHS 12000
#define SLOWER_AT 6000

// recipe
static struct fixpid_pid pid;

static void set_rate(bool slow)
{
    static const struct fixpid_pid_gains at_10_hz =
        FIXPID_PID_GAINS(2, 0.1, 4, 10, 2);
    static const struct fixpid_pid_gains at_2_hz =
        FIXPID_PID_GAINS(2, 0.1, 4, 2, 0);

    (void)fixpid_pid_set_gains(&pid, slow ? &at_2_hz : &at_10_hz);
    fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
}
// end of recipe

int main(void)
{
    static const struct fixpid_pid_config config = {.output_max = 1000};
    static const struct plant_counts process = {.gain = 1.0,
                                                .lag_steps = 200.0,
                                                .second_lag_steps = 50.0,
                                                .delay_steps = 5,
                                                .sensor_max = 4095.0};
    struct motion motion;
    int16_t output = 0;

    (void)fixpid_pid_init(&pid, &config);
    set_rate(false);
    motion_start(&motion, &process);
    (void)printf("time_s,setpoint,value,output\n");
    for (int k = 0; k < TENTHS; k++) {
        const int16_t setpoint = ((k / 3000) % 2 == 0) ? 600 : 400;
        if (k == SLOWER_AT) {
            set_rate(true);
        }
        if (k < SLOWER_AT || k % 5 == 0) {
            output = fixpid_pid_step(&pid, setpoint, motion_read(&motion));
        }
        motion_move(&motion, output);
        (void)printf("%.1f,%d,%.6g,%d\n", k / 10.0, setpoint, motion.value,
                     output);
    }
    return 0;
}
