// SPDX-License-Identifier: MIT
// fixpid_autotune on six plants, the loops with what it found, and experiments
// that must fail.
#include <math.h>
#include <stdio.h>

#include "fixpid_autotune.h"
#include "loops.h"

#define STEPS_MAX 200000
#define ROBUSTNESS_Q4 FIXPID_AUTOTUNE_SAFE

// A plant, its actuator, where it is to be tuned, and how long the loop with
// its gains is watched.
struct subject {
    const struct plant_counts *plant;
    int16_t output_min;
    int16_t output_max;
    int16_t setpoint;
    uint16_t timeout_steps;
    int steps;
};

static const struct plant_counts slow_answer = {.name = "lag 10, dead time 50",
                                                .gain = 3.0,
                                                .lag_steps = 10.0,
                                                .delay_steps = 50,
                                                .noise_counts = 1,
                                                .sensor_max = 1023.0};
static const struct plant_counts servo = {.name = "servo: integrator, lag 20",
                                          .gain = 0.02,
                                          .second_lag_steps = 20.0,
                                          .delay_steps = 2,
                                          .noise_counts = 1,
                                          .sensor_max = 1023.0};

static const struct subject subjects[] = {
    {&trials[0].plant, 0, 255, 700, 1000, 800},
    {&trials[1].plant, 0, 255, 600, 1000, 800},
    {&slow_answer, 0, 255, 400, 1000, 1600},
    {&trials[2].plant, -255, 255, 400, 1000, 800},
    {&servo, -255, 255, 400, 1000, 1600},
    {&trials[4].plant, 0, 255, 600, 6000, 9000},
};

struct tuned {
    uint8_t status;
    int steps;
    struct fixpid_autotune tuner;
};

static struct fixpid_autotune_config config_for(const struct subject *subject)
{
    return (struct fixpid_autotune_config){
        .output_min = subject->output_min,
        .output_max = subject->output_max,
        .output_rest = 0,
        .measurement_min = -1023,
        .measurement_max = (int16_t)subject->plant->sensor_max,
        .timeout_steps = subject->timeout_steps,
        .cycles = 1,
    };
}

static struct tuned experiment(const struct subject *subject,
                               const struct fixpid_autotune_config *config,
                               struct motion *motion)
{
    struct tuned tuned = {.steps = 0};

    (void)fixpid_autotune_init(&tuned.tuner, config);
    motion_start(motion, subject->plant);
    do {
        motion_move(motion,
                    fixpid_autotune_step(&tuned.tuner, subject->setpoint,
                                         motion_read(motion)));
        tuned.steps++;
        tuned.status = fixpid_autotune_status(&tuned.tuner);
    } while (tuned.status == FIXPID_AUTOTUNE_RUNNING &&
             tuned.steps < STEPS_MAX);
    return tuned;
}

// To the setpoint, from rest, with these gains.
static void print_loop(const struct subject *subject,
                       const struct fixpid_pid_config *config,
                       struct motion *motion)
{
    const double setpoint = subject->setpoint;
    const uint32_t noise = motion->noise;
    struct fixpid_pid pid;
    double overshoot = 0.0;
    double iae = 0.0;
    int settled = 0;

    (void)fixpid_pid_init(&pid, config);
    motion_start(motion, subject->plant);
    motion->noise = noise; // goes on
    for (int step = 0; step < subject->steps; step++) {
        motion_move(motion, fixpid_pid_step(&pid, subject->setpoint,
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

// What the experiment found out, 0 where the plant integrates.
static void print_process(const struct tuned *tuned)
{
    struct fixpid_autotune_process model = {.gain_q8 = 0};
    const bool found = fixpid_autotune_model(&tuned->tuner, &model);
    const bool lag = found && model.lag_q4 != FIXPID_AUTOTUNE_INTEGRATING;

    (void)printf("%.9g;%.9g;%.9g;%.9g;", lag ? model.gain_q8 / 256.0 : 0.0,
                 lag ? model.lag_q4 / 16.0 : 0.0, model.dead_q4 / 16.0,
                 model.slope_q24 / 16777216.0);
}

void print_autotune(void)
{
    static const struct {
        const char *name;
        uint8_t rule;
    } rules[] = {{"PI", FIXPID_AUTOTUNE_PI}, {"PID", FIXPID_AUTOTUNE_PID}};

    (void)printf("plant;status;steps;k;t;l;slope;rule;kp;ki;kd;filter;"
                 "overshoot;settled;iae\n");
    for (size_t i = 0; i < sizeof(subjects) / sizeof(subjects[0]); i++) {
        const struct subject *const subject = &subjects[i];
        const struct fixpid_autotune_config how = config_for(subject);
        struct motion motion;
        const struct tuned tuned = experiment(subject, &how, &motion);
        for (size_t r = 0; r < sizeof(rules) / sizeof(rules[0]); r++) {
            struct fixpid_pid_config config = {
                .output_min = subject->output_min,
                .output_max = subject->output_max,
            };
            (void)printf("%s;%d;%d;", subject->plant->name, (int)tuned.status,
                         tuned.steps);
            print_process(&tuned);
            (void)printf("%s;", rules[r].name);
            (void)fixpid_autotune_result(&tuned.tuner, rules[r].rule,
                                         ROBUSTNESS_Q4, &config);
            print_loop(subject, &config, &motion);
        }
    }
}

static void print_failure(const char *what, uint8_t expected,
                          const struct subject *subject,
                          const struct fixpid_autotune_config *config)
{
    struct motion motion;
    struct fixpid_pid_config gains = {.output_max = 255};
    const struct tuned tuned = experiment(subject, config, &motion);
    const bool refused = !fixpid_autotune_result(
        &tuned.tuner, FIXPID_AUTOTUNE_PI, ROBUSTNESS_Q4, &gains);

    (void)printf("%s;%d;%d;%d;%d\n", what, (int)expected, (int)tuned.status,
                 tuned.steps, refused ? 1 : 0);
}

void print_failures(void)
{
    struct plant_counts plant = trials[0].plant;
    struct subject subject = subjects[0];
    struct fixpid_autotune_config config = config_for(&subject);

    (void)printf("what;expected;status;steps;refused\n");
    subject.plant = &plant;
    plant.sensor_max = 2000.0;
    config.measurement_max = 2000;
    subject.setpoint = 1100;
    print_failure("setpoint out of reach", FIXPID_AUTOTUNE_NO_OSCILLATION,
                  &subject, &config);

    subject.setpoint = 500;
    config.measurement_max = 515;
    print_failure("sensor's end 15 counts above the setpoint",
                  FIXPID_AUTOTUNE_SATURATED, &subject, &config);

    config.measurement_max = 2000;
    plant.lag_steps = 1.0;
    plant.delay_steps = 2;
    print_failure("a plant of 3 steps", FIXPID_AUTOTUNE_TOO_FAST, &subject,
                  &config);

    plant = trials[4].plant;
    plant.lag_steps = 30000.0;
    plant.second_lag_steps = 3000.0;
    plant.noise_counts = 0;
    config.swing = 800;
    config.cycles = 4;
    subject.setpoint = 500;
    config.timeout_steps = 32767;
    print_failure("lags of 30 000 and 3 000 steps", FIXPID_AUTOTUNE_TOO_SLOW,
                  &subject, &config);
}
