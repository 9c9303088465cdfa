// SPDX-License-Identifier: MIT
// A loop in operation gets new gains: the experiment keeps within a fifth of
// the actuator's range on each side of where the controller holds it, and so
// the process stays near its setpoint. Where the experiment finds no gains, the
// controller goes on with those that it has.
#include <stdio.h>

#include "fixpid_autotune.h"
#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 5000
#define RETUNED_AT 1000
#define DISTURBED_AT 1500
#define DISTURBED_TO 2600
#define DISTURBANCE (-350.0) // more than a fifth of the range makes up for
#define LOADED_AT 4000
#define LOAD (-100.0)

// recipe
#define FULL 1000
#define FIFTH (FULL / 5)
#define SETPOINT 500

static struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(0.5, 0.006, 0, 1, 0), // found somehow
    .output_min = 0,
    .output_max = FULL};
static struct fixpid_pid pid;
static struct fixpid_autotune tuner;
static bool tuning;

// When the user asks for it and the process is at rest: retune(FIFTH).
static void retune(int16_t range)
{
    const int16_t now = fixpid_pid_output(&pid);
    const struct fixpid_autotune_config experiment = {
        .output_min = (int16_t)((now > range) ? now - range : 0),
        .output_max = (int16_t)((now < FULL - range) ? now + range : FULL),
        .output_rest = now,
        .measurement_min = SETPOINT - 120, // what the process may do
        .measurement_max = SETPOINT + 120,
        .swing = 85, // a twelfth of the scale
        .timeout_steps = 600,
        .cycles = 2,
    };

    tuning = fixpid_autotune_init(&tuner, &experiment);
}

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

// One run with an experiment within this range, 0: none, and with a load that
// comes while it is under way.
static void run(int16_t range, double disturbance, struct sample *samples)
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

        if (k == RETUNED_AT && range != 0) {
            retune(range);
        }
        samples[k].output = control(SETPOINT, motion_read(&motion));
        motion_move(&motion, samples[k].output + load);
        samples[k].value = motion.value;
    }
    config = before;
}

int main(void)
{
    static struct sample narrow[STEPS];
    static struct sample whole[STEPS];
    static struct sample old[STEPS];
    static struct sample disturbed[STEPS];

    run(FIFTH, 0.0, narrow);
    run(FULL, 0.0, whole);
    run(0, 0.0, old);
    run(FIFTH, DISTURBANCE, disturbed);
    (void)printf("time_s,narrow,whole,old,disturbed,output,output_disturbed\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.6g,%.6g,%.6g,%.6g,%d,%d\n", k, narrow[k].value,
                     whole[k].value, old[k].value, disturbed[k].value,
                     (int)narrow[k].output, (int)disturbed[k].output);
    }
    return 0;
}
