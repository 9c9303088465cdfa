// SPDX-License-Identifier: MIT
#include "pid_double.h"

#include <math.h>

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

static double derivative(struct pid_double *self, double measurement)
{
    const double fall = self->first ? 0.0 : self->previous - measurement;
    const double share = 1.0 / (double)(1 << self->gains.filter);

    self->first = false;
    self->previous = measurement;
    return self->derivative * (1.0 - share) + self->gains.kd * share * fall;
}

double pid_double_step(struct pid_double *self, double setpoint,
                       double measurement)
{
    const double error = setpoint - measurement;
    const double proportional =
        self->gains.kp * (self->setpoint_weight * setpoint - measurement);

    self->derivative = derivative(self, measurement);
    const double candidate = self->integral + self->gains.ki * error;
    const double output = proportional + self->derivative + candidate;
    // It rests while it would lead deeper into a limit.
    if (!(output > self->output_max && error > 0.0) &&
        !(output < self->output_min && error < 0.0)) {
        self->integral = candidate;
    }
    return fmin(fmax(output, self->output_min), self->output_max);
}
