// SPDX-License-Identifier: MIT
// A loop in operation gets new gains: the experiment starts at rest, from the
// output where the controller holds it, and so the process stays near its
// setpoint. Where the experiment finds no gains, the controller goes on with
// those that it has.
#include <stdio.h>

#include "fixpid_autotune.h"
#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 5000
#define RETUNED_AT 1000
#define DISTURBED_AT 1500
#define DISTURBED_TO 2600
#define DISTURBANCE (-350.0)
#define LOADED_AT 4000
#define LOAD (-100.0)

// recipe
#define FULL 1000
#define SETPOINT 500

static struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(0.5, 0.006, 0, 1, 0), // found somehow
    .output_min = 0,
    .output_max = FULL};
static struct fixpid_pid pid;
static struct fixpid_autotune tuner;
static bool tuning;

// shown
// When the user asks for it and the process is at rest.
static void retune(void)
{
    const struct fixpid_autotune_config experiment = {
        .output_min = 0,
        .output_max = FULL,
        .output_rest = fixpid_pid_output(&pid), // what holds the setpoint
        .measurement_min = SETPOINT - 120,      // what the process may do
        .measurement_max = SETPOINT + 120,
        .swing = 0, // the tuner chooses
        .timeout_steps = 600,
        .cycles = 1,
    };

    tuning = fixpid_autotune_init(&tuner, &experiment);
}
// end of shown

// Without gains the old ones stay, and the output goes on from where it was.
static void end_tuning(void)
{
    struct fixpid_autotune_process process;
    int16_t output = fixpid_pid_output(&pid);

    tuning = false;
    if (fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI, FIXPID_AUTOTUNE_SAFE,
                               &config) &&
        fixpid_autotune_model(&tuner, &process)) {
        (void)fixpid_pid_init(&pid, &config);
        output = process.holding;
    }
    fixpid_pid_seed(&pid, output);
}

static int16_t control(int16_t setpoint, int16_t measurement)
{
    int16_t output;

    if (!tuning) {
        return fixpid_pid_step(&pid, setpoint, measurement);
    }
    output = fixpid_autotune_step(&tuner, setpoint, measurement);
    if (fixpid_autotune_status(&tuner) != FIXPID_AUTOTUNE_RUNNING) {
        end_tuning();
    }
    return output;
}
// end of recipe

struct sample {
    double value;
    int16_t output;
};

// One run with an experiment or without, and with a load that comes while it is
// under way.
static void run(bool retuned, double disturbance, struct sample *samples)
{
    static const struct plant_counts process = {.gain = 0.9,
                                                .lag_steps = 60.0,
                                                .second_lag_steps = 15.0,
                                                .delay_steps = 8,
                                                .noise_counts = 1,
                                                .sensor_max = 1023.0};
    const struct fixpid_pid_config before = config;
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    tuning = false;
    motion_start(&motion, &process);
    for (int k = 0; k < STEPS; k++) {
        const bool disturbed = k >= DISTURBED_AT && k < DISTURBED_TO;
        const double load =
            (disturbed ? disturbance : 0.0) + ((k >= LOADED_AT) ? LOAD : 0.0);

        if (k == RETUNED_AT && retuned) {
            retune();
        }
        samples[k].output = control(SETPOINT, motion_read(&motion));
        motion_move(&motion, samples[k].output + load);
        samples[k].value = motion.value;
    }
    config = before;
}

int main(void)
{
    static struct sample retuned[STEPS];
    static struct sample old[STEPS];
    static struct sample disturbed[STEPS];

    run(true, 0.0, retuned);
    run(false, 0.0, old);
    run(true, DISTURBANCE, disturbed);
    (void)printf("time_s,retuned,old,disturbed,output,output_disturbed\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.6g,%.6g,%.6g,%d,%d\n", k, retuned[k].value,
                     old[k].value, disturbed[k].value, (int)retuned[k].output,
                     (int)disturbed[k].output);
    }
    return 0;
}
