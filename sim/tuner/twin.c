// SPDX-License-Identifier: MIT
#include "twin.h"

#include <math.h>

#include "fixpid_pid.h"
#include "params.h"
#include "plant.h"

#define SUM_MAX 30000.0 // FIXPID_AN964_SUM_LIMIT
#define TERM_MAX 120.0  // FIXPID_AN964_TERM_LIMIT
#define END_MAX 1000.0  // FIXPID_AN964_OUTPUT_LIMIT
#define ERROR_MAX 1023.0

static double limited(double value)
{
    return plant_limit(value, param(PARAM_OUTPUT_MIN), param(PARAM_OUTPUT_MAX));
}

void twin_begin(struct twin *self)
{
    const unsigned options = (unsigned)param(PARAM_OPTIONS);
    const int on_measurement =
        (options & TUNER_OPTION_PROPORTIONAL_ON_MEASUREMENT) != 0u;
    const double rate = param(PARAM_RATE);
    const struct pid_double_gains gains = {
        param(PARAM_KP), param(PARAM_KI) / rate, param(PARAM_KD) * rate,
        (int)param(PARAM_FILTER) & 7};

    *self = (struct twin){.kind = (int)param(PARAM_CONTROLLER), .sign = 1.0};
    if ((options & TUNER_OPTION_REVERSE) != 0u) {
        self->sign = -1.0;
    }
    pid_double_init(&self->exact, &gains,
                    on_measurement ? 0.0 : param(PARAM_WEIGHT),
                    param(PARAM_OUTPUT_MIN), param(PARAM_OUTPUT_MAX));
    self->exact.derivative_on_error =
        (options & TUNER_OPTION_DERIVATIVE_ON_ERROR) != 0u;
    self->exact.integral_min = param(PARAM_INTEGRAL_MIN);
    self->exact.integral_max = param(PARAM_INTEGRAL_MAX);
}

void twin_event(struct twin *self, int what, double a, double b)
{
    switch (what) {
    case EVENT_MANUAL:
        pid_double_set_manual(&self->exact, a);
        break;
    case EVENT_AUTO:
        pid_double_set_auto(&self->exact);
        break;
    case EVENT_LIMITS:
        pid_double_set_limits(&self->exact, a, b);
        break;
    case EVENT_FEEDFORWARD:
        self->exact.feedforward = a;
        break;
    default:
        break;
    }
}

static double an937(struct twin *self, double error)
{
    const double limit = param(PARAM_INTEGRAL_MAX);

    self->sum = plant_limit(self->sum + error, -limit, limit);
    if (self->ticks == 0) {
        self->ticks = (int)param(PARAM_FILTER);
        self->delta = error - self->errors[0];
        self->errors[0] = error;
    }
    self->ticks--;
    return limited(((param(PARAM_KP) * error) + (param(PARAM_KI) * self->sum) +
                    (param(PARAM_KD) * self->delta)) /
                   16.0);
}

static double an964(struct twin *self, double any_error)
{
    const double error = plant_limit(any_error, -ERROR_MAX, ERROR_MAX);

    self->sum = plant_limit(self->sum + error, 1.0 - SUM_MAX, SUM_MAX);
    const double rise =
        plant_limit(error - self->errors[2], -TERM_MAX, TERM_MAX);
    const double derivative =
        plant_limit(rise * param(PARAM_KD) / 32.0, -TERM_MAX, TERM_MAX);
    const double integral = self->sum / 256.0 * param(PARAM_KI) / 16.0;

    self->errors[2] = self->errors[1];
    self->errors[1] = self->errors[0];
    self->errors[0] = error;
    const double output =
        (error + integral + derivative) * param(PARAM_KP) / 1024.0;
    return limited(plant_limit(output, -END_MAX, END_MAX));
}

double twin_step(struct twin *self, double setpoint, double measurement,
                 double error)
{
    switch (self->kind) {
    case TUNER_AN937:
        return an937(self, error);
    case TUNER_AN964:
        return an964(self, error);
    default:
        return pid_double_step(&self->exact, self->sign * setpoint,
                               self->sign * measurement);
    }
}
