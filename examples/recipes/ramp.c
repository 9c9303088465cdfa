// SPDX-License-Identifier: MIT
// Ramps: a setpoint that rises at 2 counts a second, and a valve that moves by
// at most 10 counts a second, which the controller must know.
#include <stdio.h>

#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "plant_counts.h"

#define STEPS 6000 // 10 a second

// recipe
static struct fixpid_pid pid;
static struct fixpid_slew ramp;
static struct fixpid_slew valve;

static void start(int16_t measurement)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1.5, 0.25, 0, 10, 0),
        .output_min = 0,
        .output_max = 1000};

    (void)fixpid_pid_init(&pid, &config);
    fixpid_slew_init(&ramp, FIXPID_SLEW_RATE(2, 10), FIXPID_SLEW_RATE(2, 10));
    fixpid_slew_seed(&ramp, measurement); // it begins where the process is
    fixpid_slew_init(&valve, FIXPID_SLEW_RATE(10, 10),
                     FIXPID_SLEW_RATE(10, 10));
}

// shown
static int16_t control(int16_t setpoint, int16_t measurement)
{
    const int16_t wanted =
        fixpid_pid_step(&pid, fixpid_slew_step(&ramp, setpoint), measurement);
    const int16_t output = fixpid_slew_step(&valve, wanted);

    fixpid_pid_track(&pid, output, 5); // Ti is 60 steps
    return output;
}
// end of shown
// end of recipe

static int16_t control_without(int16_t setpoint, int16_t measurement)
{
    const int16_t wanted = fixpid_pid_step(&pid, setpoint, measurement);

    return fixpid_slew_step(&valve, wanted);
}

static void run(int16_t (*step)(int16_t, int16_t), double *value)
{
    static const struct plant_counts process = {.gain = 1.0,
                                                .lag_steps = 40.0,
                                                .second_lag_steps = 20.0,
                                                .delay_steps = 1,
                                                .noise_counts = 2,
                                                .sensor_max = 4095.0};
    struct motion motion;

    motion_start(&motion, &process);
    start(motion_read(&motion));
    for (int k = 0; k < STEPS; k++) {
        motion_move(&motion, step(600, motion_read(&motion)));
        value[k] = motion.value;
    }
}

int main(void)
{
    static double with[STEPS];
    static double without[STEPS];

    run(control, with);
    run(control_without, without);
    (void)printf("time_s,setpoint,with,without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%.1f,600,%.6g,%.6g\n", k / 10.0, with[k], without[k]);
    }
    return 0;
}
