// SPDX-License-Identifier: MIT
// The law of fixpid_pid in double precision, to compare with. Units and signs
// are those of fixpid_pid.h; gains are per step. It has the integral's
// conditional anti-windup, a setpoint weight and the derivative's filter, and
// none of what happens beside a step.
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

    double integral;
    double derivative;
    double previous;
    bool first;
};

void pid_double_init(struct pid_double *self,
                     const struct pid_double_gains *gains,
                     double setpoint_weight, double output_min,
                     double output_max);

// The output before it is rounded to a whole count.
double pid_double_step(struct pid_double *self, double setpoint,
                       double measurement);

#endif
