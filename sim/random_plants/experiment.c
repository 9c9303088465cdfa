// SPDX-License-Identifier: MIT
#include "experiment.h"

#include <math.h>
#include <stddef.h>

static const uint8_t robustness[] = {
    FIXPID_AUTOTUNE_QUICK, FIXPID_AUTOTUNE_SAFE, FIXPID_AUTOTUNE_CALM};

uint8_t design_rule(int number)
{
    return (uint8_t)((number < 3) ? FIXPID_AUTOTUNE_PI : FIXPID_AUTOTUNE_PID);
}

uint8_t design_robustness(int number)
{
    return robustness[number % 3];
}

// All of the output, or a part around its rest.
static int end_of(const struct subject *subject, double rest, int sign)
{
    const double span = subject->output_max - subject->output_min;
    const double end = rest + (sign * subject->each_side * span);

    if (subject->each_side == 0.0) {
        return (sign < 0) ? subject->output_min : subject->output_max;
    }
    return (int)fmin(fmax(end, subject->output_min), subject->output_max);
}

void experiment_start(struct experiment *self, const struct subject *subject,
                      double rest)
{
    const struct fixpid_autotune_config config = {
        .output_min = (int16_t)end_of(subject, rest, -1),
        .output_max = (int16_t)end_of(subject, rest, 1),
        .output_rest = (int16_t)rest,
        // A machine may read 0 at rest.
        .measurement_min = (subject->machine != NULL) ? -1 : 0,
        .measurement_max = (int16_t)subject->sensor_max,
        .timeout_steps = (uint16_t)subject->timeout_steps,
        .cycles = (uint8_t)subject->cycles,
        .reverse = subject->reverse,
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
    static struct bench bench;

    experiment_start(self, subject, rest);
    bench_start(&bench, subject);
    while (self->status == FIXPID_AUTOTUNE_RUNNING &&
           self->steps < EXPERIMENT_STEPS) {
        const int16_t measurement = (int16_t)bench_read(&bench);
        const int16_t output =
            fixpid_autotune_step(&self->autotune, setpoint, measurement);
        if (output < subject->output_min || output > subject->output_max) {
            self->outside++;
        }
        bench_drive(&bench, output);
        self->steps++;
        self->status = fixpid_autotune_status(&self->autotune);
    }
}

const char *design_name(int number)
{
    static const char *const names[DESIGNS] = {
        "PI quick", "PI safe", "PI calm", "PID quick", "PID safe", "PID calm"};

    return names[number];
}

struct design design_of(const struct fixpid_pid_gains *gains)
{
    return (struct design){.found = true,
                           .kp = gains->kp_q8 / 256.0,
                           .ki = gains->ki_q24 / 16777216.0,
                           .kd = gains->kd_q8 / 256.0,
                           .filter = gains->derivative_filter};
}

struct design experiment_design(const struct experiment *self, int number)
{
    struct fixpid_pid_config config;

    if (!fixpid_autotune_result(&self->autotune, design_rule(number),
                                design_robustness(number), &config)) {
        return (struct design){.found = false};
    }
    return design_of(&config.gains);
}

int experiment_reason(const struct experiment *self, int number)
{
    return fixpid_autotune_reason(&self->autotune, design_rule(number),
                                  design_robustness(number));
}
