// SPDX-License-Identifier: MIT
#include "experiment.h"

#include <math.h>

#define CYCLES 2

static const uint8_t robustness[] = {
    FIXPID_AUTOTUNE_QUICK, FIXPID_AUTOTUNE_SAFE, FIXPID_AUTOTUNE_CALM};

static uint8_t rule_of(int number)
{
    return (uint8_t)((number < 3) ? FIXPID_AUTOTUNE_PI : FIXPID_AUTOTUNE_PID);
}

void experiment_start(struct experiment *self, const struct subject *subject,
                      double rest)
{
    const struct fixpid_autotune_config config = {
        .output_min = 0,
        .output_max = (int16_t)subject->output_max,
        .output_rest = (int16_t)rest,
        .measurement_min = 0,
        .measurement_max = (int16_t)subject->sensor_max,
        .swing = (uint16_t)subject->swing,
        .timeout_steps = (uint16_t)subject->timeout_steps,
        .cycles = CYCLES,
    };

    *self = (struct experiment){.status = FIXPID_AUTOTUNE_REFUSED};
    if (fixpid_autotune_init(&self->autotune, &config)) {
        self->status = FIXPID_AUTOTUNE_RUNNING;
    }
}

void experiment_run(struct experiment *self, const struct subject *subject)
{
    // An integrator from power-on needs its holding output, too, or it runs
    // away while the noise is measured.
    const bool holds = subject->at_rest || subject->plant.integrating;
    const double rest = holds ? subject->holding * subject->output_max : 0.0;
    const int16_t setpoint = (int16_t)subject->setpoint;
    struct bench bench;

    experiment_start(self, subject, rest);
    bench_start(&bench, subject);
    while (self->status == FIXPID_AUTOTUNE_RUNNING &&
           self->steps < EXPERIMENT_STEPS) {
        const int16_t measurement = (int16_t)bench_read(&bench);
        const int16_t output =
            fixpid_autotune_step(&self->autotune, setpoint, measurement);
        if (output < 0 || output > subject->output_max) {
            self->outside++;
        }
        bench_drive(&bench, output);
        self->steps++;
        self->status = fixpid_autotune_status(&self->autotune);
    }
}

const char *experiment_design_name(int number)
{
    static const char *const names[DESIGNS] = {
        "PI quick", "PI safe", "PI calm", "PID quick", "PID safe", "PID calm"};

    return names[number];
}

struct design experiment_design(const struct experiment *self, int number)
{
    struct fixpid_pid_config config;
    struct design design = {false, 0.0, 0.0, 0.0, 0};

    if (fixpid_autotune_result(&self->autotune, rule_of(number),
                               robustness[number % 3], &config)) {
        design.found = true;
        design.kp = config.gains.kp_q8 / 256.0;
        design.ki = config.gains.ki_q24 / 16777216.0;
        design.kd = config.gains.kd_q8 / 256.0;
        design.filter = config.gains.derivative_filter;
    }
    return design;
}

int experiment_reason(const struct experiment *self, int number)
{
    return fixpid_autotune_reason(&self->autotune, rule_of(number),
                                  robustness[number % 3]);
}
