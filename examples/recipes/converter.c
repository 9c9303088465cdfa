// SPDX-License-Identifier: MIT
// A converter of 16 unsigned bits, 0..65535. As an int16_t it would turn
// negative at 32768. With 32768 taken from setpoint and measurement alike, the
// error is what it was.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 2000

// recipe
static struct fixpid_pid pid;

static int16_t centred(uint16_t reading)
{
    return (int16_t)(reading - INT32_C(32768));
}

static int16_t control(uint16_t setpoint, uint16_t reading)
{
    return fixpid_pid_step(&pid, centred(setpoint), centred(reading));
}
// end of recipe

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(0.03125, 0.001, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};
    static const struct plant_counts process = {.gain = 64.0,
                                                .lag_steps = 50.0,
                                                .delay_steps = 2,
                                                .sensor_max = 32767.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &process);
    (void)printf("time_s,setpoint,value,output\n");
    for (int k = 0; k < STEPS; k++) {
        const uint16_t setpoint = (k < STEPS / 2) ? 45000u : 20000u;
        const double most = 65535.0;
        const double level = (motion.value > most) ? most : motion.value;
        const int16_t output =
            control(setpoint, (uint16_t)(level < 0.0 ? 0.0 : level));
        motion_move(&motion, output);
        (void)printf("%d,%u,%.6g,%d\n", k, (unsigned)setpoint, motion.value,
                     output);
    }
    return 0;
}
