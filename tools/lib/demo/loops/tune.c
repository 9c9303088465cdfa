// SPDX-License-Identifier: MIT
// fixpid_autotune on five plants, the loops with what it found, and four
// experiments that must fail.
#include <math.h>
#include <stdio.h>

#include "fixpid_autotune.h"
#include "loops.h"

#define STEPS_MAX 60000

struct tuned {
    uint8_t status;
    int steps;
    struct fixpid_autotune tuner;
};

static struct fixpid_autotune_config config_for(const struct plant *plant)
{
    return (struct fixpid_autotune_config){
        .output_low = plant->relay_low,
        .output_high = plant->relay_high,
        .measurement_min = -32000,
        .measurement_max = (int16_t)(plant->sensor_max - 1.0),
        .hysteresis = 4,
        .timeout_steps = plant->timeout_steps,
        .cycles = 4,
    };
}

static struct tuned experiment(const struct plant *plant,
                               const struct fixpid_autotune_config *config,
                               struct motion *motion)
{
    struct tuned tuned = {.steps = 0};

    (void)fixpid_autotune_init(&tuned.tuner, config);
    motion_start(motion, plant);
    do {
        motion_move(motion,
                    fixpid_autotune_step(&tuned.tuner, (int16_t)plant->tune_at,
                                         motion_read(motion)));
        tuned.steps++;
        tuned.status = fixpid_autotune_status(&tuned.tuner);
    } while (tuned.status == FIXPID_AUTOTUNE_RUNNING &&
             tuned.steps < STEPS_MAX);
    return tuned;
}

// The first setpoint of the plant, from rest, with these gains.
static void print_loop(const struct plant *plant,
                       const struct fixpid_pid_config *config,
                       struct motion *motion)
{
    const double setpoint = plant->setpoints[0];
    const int steps = (plant->kind == PLANT_OVEN) ? 9000 : 800;
    const uint32_t noise = motion->noise;
    struct fixpid_pid pid;
    double overshoot = 0.0;
    double iae = 0.0;
    int settled = 0;

    (void)fixpid_pid_init(&pid, config);
    motion_start(motion, plant);
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
    for (int i = 0; i < PLANTS; i++) {
        const struct plant *const plant = &plants[i];
        const struct fixpid_autotune_config how = config_for(plant);
        struct motion motion;
        const struct tuned tuned = experiment(plant, &how, &motion);
        for (uint8_t rule = FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI;
             rule <= FIXPID_AUTOTUNE_TYREUS_LUYBEN_PID; rule++) {
            const struct law_gains none = {0.0, 0.0, 0.0, 0};
            struct fixpid_pid_config config =
                loop_config(&none, 1.0, plant->output_min, plant->output_max);
            (void)printf("%s;%d;%d;%s;", plant->name, (int)tuned.status,
                         tuned.steps, rules[rule]);
            (void)fixpid_autotune_result(&tuned.tuner, rule, &config.gains);
            print_loop(plant, &config, &motion);
        }
    }
}

static void print_failure(const char *what, uint8_t expected,
                          const struct plant *plant,
                          const struct fixpid_autotune_config *config)
{
    struct motion motion;
    struct fixpid_pid_gains gains;
    const struct tuned tuned = experiment(plant, config, &motion);
    const bool refused = !fixpid_autotune_result(
        &tuned.tuner, FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI, &gains);

    (void)printf("%s;%d;%d;%d;%d\n", what, (int)expected, (int)tuned.status,
                 tuned.steps, refused ? 1 : 0);
}

void print_failures(void)
{
    struct plant plant = plants[0];
    struct fixpid_autotune_config config = config_for(&plant);

    (void)printf("what;expected;status;steps;refused\n");
    config.measurement_min = -5;
    config.measurement_max = 2000;
    config.timeout_steps = 600;
    plant.sensor_max = 2000.0;
    plant.tune_at = 1100.0;
    print_failure("setpoint out of reach", FIXPID_AUTOTUNE_NO_OSCILLATION,
                  &plant, &config);

    plant.tune_at = 500.0;
    config.measurement_max = 515;
    print_failure("sensor's end 15 counts above the setpoint",
                  FIXPID_AUTOTUNE_SATURATED, &plant, &config);

    config.measurement_max = 2000;
    config.hysteresis = 40;
    plant.delay_steps = 1;
    print_failure("hysteresis of 40 and no dead time",
                  FIXPID_AUTOTUNE_TOO_SMALL, &plant, &config);

    config.hysteresis = 4;
    config.measurement_min = -2000;
    plant.noise_counts = 400;
    print_failure("noise of 400 counts", FIXPID_AUTOTUNE_TOO_FAST, &plant,
                  &config);
}
