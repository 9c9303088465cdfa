// SPDX-License-Identifier: MIT
// A heater behind a solid-state relay, which is only on or off: windows of 5 s,
// no pulse and no gap shorter than 0.2 s.
#include <stdio.h>

#include "fixpid_pid.h"
#include "fixpid_tpo.h"
#include "plant_counts.h"

#define STEPS 18000 // half an hour, 10 a second

// recipe
#define FULL 1000

static struct fixpid_pid pid;
static struct fixpid_tpo relay;

static void start(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1.5, 0.04, 0, 10, 0),
        .output_min = 0,
        .output_max = FULL,
        .integral_min = 0,
        .integral_max = 0, // none of its own
        .setpoint_weight_q8 = 180,
    };
    static const struct fixpid_tpo_config windows = {
        .full = FULL, .window = 50, .minimum_on = 2, .minimum_off = 2};

    (void)fixpid_pid_init(&pid, &config);
    (void)fixpid_tpo_init(&relay, &windows);
}

static bool control(int16_t setpoint, int16_t measurement)
{
    return fixpid_tpo_step(&relay,
                           fixpid_pid_step(&pid, setpoint, measurement));
}
// end of recipe

int main(void)
{
    static const struct plant_counts heater = {.gain = 3200.0,
                                               .lag_steps = 600.0,
                                               .second_lag_steps = 100.0,
                                               .delay_steps = 1,
                                               .noise_counts = 2,
                                               .sensor_max = 4095.0};
    struct motion motion;

    start();
    motion_start(&motion, &heater);
    (void)printf("time_s,setpoint,value,duty,on\n");
    for (int k = 0; k < STEPS; k++) {
        const bool on = control(960, motion_read(&motion));
        motion_move(&motion, on ? 1.0 : 0.0);
        (void)printf("%.1f,960,%.6g,%d,%d\n", k / 10.0, motion.value,
                     fixpid_pid_output(&pid), on ? 1 : 0);
    }
    return 0;
}
