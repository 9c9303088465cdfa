// SPDX-License-Identifier: MIT
#include "law.h"

#include <math.h>

static double limited(const struct law *self, double value)
{
    return fmin(fmax(value, self->output_min), self->output_max);
}

void law_init(struct law *self, enum law_without without,
              const struct law_gains *gains, double setpoint_weight,
              double output_min, double output_max)
{
    *self = (struct law){
        .without = without,
        .gains = *gains,
        .setpoint_weight = setpoint_weight,
        .output_min = output_min,
        .output_max = output_max,
        .first = true,
    };
    if (without == LAW_EIGHT_FRACTIONAL_BITS) {
        self->gains.ki = floor(gains->ki * 256.0 + 0.5) / 256.0;
    }
}

// What lowered limits make wind-up is dropped.
void law_set_limits(struct law *self, double output_min, double output_max)
{
    const double fed = self->feedforward;
    const double others = self->proportional + self->derivative;

    self->output_min = output_min;
    self->output_max = output_max;
    if (self->manual || self->seeded) {
        self->held = limited(self, self->held);
    } else if (self->without != LAW_NO_ANTI_WINDUP) {
        self->integral =
            fmin(self->integral, output_max - fed - fmin(others, 0.0));
        self->integral =
            fmax(self->integral, output_min - fed - fmax(others, 0.0));
    }
}

void law_set_manual(struct law *self, double output)
{
    self->manual = true;
    self->seeded = false;
    self->held = limited(self, output);
}

void law_set_auto(struct law *self)
{
    self->seeded = self->manual && self->without != LAW_NO_SEED;
    self->manual = false;
}

static double derivative(struct law *self, double error, double measurement)
{
    const bool on_error = self->without == LAW_DERIVATIVE_ON_ERROR;
    const double input = on_error ? -error : measurement;
    const double fall = self->first ? 0.0 : self->previous - input;
    const double share = 1.0 / (double)(1 << self->gains.filter);

    self->first = false;
    self->previous = input;
    return self->derivative * (1.0 - share) + self->gains.kd * share * fall;
}

static double within_range(const struct law *self, double integral)
{
    if (self->integral_min == self->integral_max) {
        return integral;
    }
    return fmin(fmax(integral, self->integral_min), self->integral_max);
}

// The integral that is kept, of a candidate that leads to this output.
static double kept(const struct law *self, double candidate, double output,
                   double error)
{
    const bool deeper = (output > self->output_max && error > 0.0) ||
                        (output < self->output_min && error < 0.0);
    switch (self->without) {
    case LAW_NO_ANTI_WINDUP:
        return candidate;
    case LAW_SIGN_BLIND:
        return limited(self, output) == output ? candidate : self->integral;
    case LAW_INTEGRAL_CLAMPED:
        return limited(self, candidate);
    default:
        return deeper ? self->integral : candidate;
    }
}

double law_step(struct law *self, double setpoint, double measurement)
{
    const double error = setpoint - measurement;

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
    self->integral = kept(self, candidate, others + candidate, error);
    if (self->without == LAW_INTEGRAL_CLAMPED) {
        return limited(self, others + self->integral);
    }
    return limited(self, others + candidate);
}
