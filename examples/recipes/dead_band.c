// SPDX-License-Identifier: MIT
// Dead band: a motor valve that should rest while the process is near enough.
// Within 4 counts the error counts as none, and the integral rests.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 4000

// recipe
#define BAND 4

static struct fixpid_pid pid;

static int16_t control(int16_t setpoint, int16_t measurement)
{
    const int32_t error = (int32_t)setpoint - measurement;
    const bool near = error <= BAND && error >= -BAND;

    return fixpid_pid_step(&pid, near ? measurement : setpoint, measurement);
}
// end of recipe

static int16_t control_without(int16_t setpoint, int16_t measurement)
{
    return fixpid_pid_step(&pid, setpoint, measurement);
}

static void run(int16_t (*step)(int16_t, int16_t), double *value,
                int16_t *output)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1, 0.02, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};
    static const struct plant_counts process = {.gain = 1.0,
                                                .lag_steps = 50.0,
                                                .delay_steps = 2,
                                                .noise_counts = 2,
                                                .sensor_max = 4095.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &process);
    for (int k = 0; k < STEPS; k++) {
        output[k] = step((k < STEPS / 2) ? 600 : 400, motion_read(&motion));
        motion_move(&motion, output[k]);
        value[k] = motion.value;
    }
}

int main(void)
{
    static double with[STEPS];
    static double without[STEPS];
    static int16_t valve[STEPS];
    static int16_t valve_without[STEPS];

    run(control, with, valve);
    run(control_without, without, valve_without);
    (void)printf("time_s,with,valve,without,valve_without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.6g,%d,%.6g,%d\n", k, with[k], valve[k], without[k],
                     valve_without[k]);
    }
    return 0;
}
