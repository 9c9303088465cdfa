// SPDX-License-Identifier: MIT
// fixpid_relay on five plants, the loops with what it found, and four
// experiments that must fail.
#include <math.h>
#include <stdio.h>

#include "fixpid_relay.h"
#include "loops.h"

#define STEPS_MAX 60000

struct tuned {
    uint8_t status;
    int steps;
    struct fixpid_relay tuner;
};

static struct fixpid_relay_config config_for(const struct trial *trial)
{
    return (struct fixpid_relay_config){
        .output_low = trial->relay_low,
        .output_high = trial->relay_high,
        .measurement_min = -32000,
        .measurement_max = (int16_t)(trial->plant.sensor_max - 1.0),
        .hysteresis = 4,
        .timeout_steps = trial->timeout_steps,
        .cycles = 4,
    };
}

static struct tuned experiment(const struct trial *trial,
                               const struct fixpid_relay_config *config,
                               struct motion *motion)
{
    struct tuned tuned = {.steps = 0};

    (void)fixpid_relay_init(&tuned.tuner, config);
    motion_start(motion, &trial->plant);
    do {
        motion_move(motion,
                    fixpid_relay_step(&tuned.tuner, (int16_t)trial->tune_at,
                                      motion_read(motion)));
        tuned.steps++;
        tuned.status = fixpid_relay_status(&tuned.tuner);
    } while (tuned.status == FIXPID_RELAY_RUNNING && tuned.steps < STEPS_MAX);
    return tuned;
}

// The first setpoint of the trial, from rest, with these gains.
static void print_loop(const struct trial *trial,
                       const struct fixpid_pid_config *config,
                       struct motion *motion)
{
    const double setpoint = trial->setpoints[0];
    const int steps = trial->tuned_steps;
    const uint32_t noise = motion->noise;
    struct fixpid_pid pid;
    double overshoot = 0.0;
    double iae = 0.0;
    int settled = 0;

    (void)fixpid_pid_init(&pid, config);
    motion_start(motion, &trial->plant);
    motion->noise = noise; // goes on
    for (int step = 0; step < steps; step++) {
        motion_move(motion, fixpid_pid_step(&pid, (int16_t)setpoint,
                                            motion_read(motion)));
        const double error = setpoint - motion->value;
        iae += fabs(error);
        overshoot = fmax(overshoot, -error);
        if (fabs(error) > 0.02 * setpoint) {
            settled = step + 1;
        }
    }
    (void)printf("%.9g;%.9g;%.9g;%d;%.9g;%d;%.9g\n",
                 config->gains.kp_q8 / 256.0, config->gains.ki_q24 / 16777216.0,
                 config->gains.kd_q8 / 256.0 *
                     (double)(1 << config->gains.derivative_filter),
                 config->gains.derivative_filter, 100.0 * overshoot / setpoint,
                 settled, iae);
}

void print_autotune(void)
{
    static const char *const rules[] = {"PI", "PID"};

    (void)printf("plant;status;steps;rule;kp;ki;kd;filter;overshoot;settled;"
                 "iae\n");
    for (int i = 0; i < TRIALS; i++) {
        const struct trial *const trial = &trials[i];
        const struct fixpid_relay_config how = config_for(trial);
        struct motion motion;
        const struct tuned tuned = experiment(trial, &how, &motion);
        for (uint8_t rule = FIXPID_RELAY_TYREUS_LUYBEN_PI;
             rule <= FIXPID_RELAY_TYREUS_LUYBEN_PID; rule++) {
            const struct law_gains none = {0.0, 0.0, 0.0, 0};
            struct fixpid_pid_config config =
                loop_config(&none, 1.0, trial->output_min, trial->output_max);
            (void)printf("%s;%d;%d;%s;", trial->plant.name, (int)tuned.status,
                         tuned.steps, rules[rule]);
            (void)fixpid_relay_result(&tuned.tuner, rule, &config.gains);
            print_loop(trial, &config, &motion);
        }
    }
}

static void print_failure(const char *what, uint8_t expected,
                          const struct trial *trial,
                          const struct fixpid_relay_config *config)
{
    struct motion motion;
    struct fixpid_pid_gains gains;
    const struct tuned tuned = experiment(trial, config, &motion);
    const bool refused = !fixpid_relay_result(
        &tuned.tuner, FIXPID_RELAY_TYREUS_LUYBEN_PI, &gains);

    (void)printf("%s;%d;%d;%d;%d\n", what, (int)expected, (int)tuned.status,
                 tuned.steps, refused ? 1 : 0);
}

void print_failures(void)
{
    struct trial trial = trials[0];
    struct fixpid_relay_config config = config_for(&trial);

    (void)printf("what;expected;status;steps;refused\n");
    config.measurement_min = -5;
    config.measurement_max = 2000;
    config.timeout_steps = 600;
    trial.plant.sensor_max = 2000.0;
    trial.tune_at = 1100.0;
    print_failure("setpoint out of reach", FIXPID_RELAY_NO_OSCILLATION, &trial,
                  &config);

    trial.tune_at = 500.0;
    config.measurement_max = 515;
    print_failure("sensor's end 15 counts above the setpoint",
                  FIXPID_RELAY_SATURATED, &trial, &config);

    config.measurement_max = 2000;
    config.hysteresis = 40;
    trial.plant.delay_steps = 1;
    print_failure("hysteresis of 40 and no dead time", FIXPID_RELAY_TOO_SMALL,
                  &trial, &config);

    config.hysteresis = 4;
    config.measurement_min = -2000;
    trial.plant.noise_counts = 400;
    print_failure("noise of 400 counts", FIXPID_RELAY_TOO_FAST, &trial,
                  &config);
}
