// SPDX-License-Identifier: MIT
#include "pid_double.h"

#include <math.h>

static double limited(const struct pid_double *self, double value)
{
    return fmin(fmax(value, self->output_min), self->output_max);
}

void pid_double_init(struct pid_double *self,
                     const struct pid_double_gains *gains,
                     double setpoint_weight, double output_min,
                     double output_max)
{
    *self = (struct pid_double){
        .gains = *gains,
        .setpoint_weight = setpoint_weight,
        .output_min = output_min,
        .output_max = output_max,
        .first = true,
    };
}

// What lowered limits make wind-up is dropped.
void pid_double_set_limits(struct pid_double *self, double output_min,
                           double output_max)
{
    const double fed = self->feedforward;
    const double others = self->proportional + self->derivative;

    self->output_min = output_min;
    self->output_max = output_max;
    if (self->manual || self->seeded) {
        self->held = limited(self, self->held);
    } else {
        self->integral =
            fmin(self->integral, output_max - fed - fmin(others, 0.0));
        self->integral =
            fmax(self->integral, output_min - fed - fmax(others, 0.0));
    }
}

void pid_double_set_manual(struct pid_double *self, double output)
{
    self->manual = true;
    self->seeded = false;
    self->held = limited(self, output);
}

void pid_double_set_auto(struct pid_double *self)
{
    self->seeded = self->manual;
    self->manual = false;
}

static double derivative(struct pid_double *self, double error,
                         double measurement)
{
    const double input = self->derivative_on_error ? -error : measurement;
    const double fall = self->first ? 0.0 : self->previous - input;
    const double share = 1.0 / (double)(1 << self->gains.filter);

    self->first = false;
    self->previous = input;
    return self->derivative * (1.0 - share) + self->gains.kd * share * fall;
}

static double within_range(const struct pid_double *self, double integral)
{
    if (self->integral_min == self->integral_max) {
        return integral;
    }
    return fmin(fmax(integral, self->integral_min), self->integral_max);
}

// At rest, before a first step that nothing is held for: fixpid_pid_step says
// so.
static void rest(struct pid_double *self, double measurement)
{
    const double left = (self->setpoint_weight - 1.0) * measurement;
    const double output = limited(self, self->feedforward);

    self->integral = within_range(self, output - self->feedforward);
    self->integral = within_range(self, self->integral - self->gains.kp * left);
}

double pid_double_step(struct pid_double *self, double setpoint,
                       double measurement)
{
    const double error = setpoint - measurement;

    if (self->first && !self->manual && !self->seeded) {
        rest(self, measurement);
    }
    self->proportional =
        self->gains.kp * (self->setpoint_weight * setpoint - measurement);
    self->derivative = derivative(self, error, measurement);
    if (self->manual) {
        return self->held;
    }
    const double others =
        self->proportional + self->derivative + self->feedforward;
    if (self->seeded) {
        self->seeded = false;
        const double wanted = self->held - others;
        self->integral = within_range(self, wanted);
        return limited(self, self->held + (self->integral - wanted));
    }
    const double candidate =
        within_range(self, self->integral + self->gains.ki * error);
    const double output = others + candidate;
    // It rests while it would lead deeper into a limit.
    if (!(output > self->output_max && error > 0.0) &&
        !(output < self->output_min && error < 0.0)) {
        self->integral = candidate;
    }
    return limited(self, output);
}
