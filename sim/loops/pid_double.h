// SPDX-License-Identifier: MIT
// The law of fixpid_pid in double precision, to compare with.
//
// Units and signs are those of fixpid_pid.h; gains are per step. Left out are
// reverse action, which is the same law with both signals negated, and the
// limits of int16_t.
#ifndef PID_DOUBLE_H
#define PID_DOUBLE_H
#include <stdbool.h>

struct pid_double_gains {
    double kp;
    double ki; // per step
    double kd; // per step, before the filter
    int filter;
};

struct pid_double {
    struct pid_double_gains gains;
    double setpoint_weight;
    double output_min;
    double output_max;
    double integral_min; // none of its own if both are 0
    double integral_max;
    double feedforward;       // output counts, added to the terms
    bool derivative_on_error; // instead of on the measurement

    double proportional;
    double integral;
    double derivative;
    double previous;
    double held;
    bool first;
    bool seeded;
    bool manual;
};

void pid_double_init(struct pid_double *self,
                     const struct pid_double_gains *gains,
                     double setpoint_weight, double output_min,
                     double output_max);
void pid_double_set_limits(struct pid_double *self, double output_min,
                           double output_max);
void pid_double_set_manual(struct pid_double *self, double output);
void pid_double_set_auto(struct pid_double *self);

// The output before it is rounded to a whole count.
double pid_double_step(struct pid_double *self, double setpoint,
                       double measurement);

#endif
