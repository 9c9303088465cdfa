// SPDX-License-Identifier: MIT
// The law of fixpid_pid in double precision, to compare with: whole, or with
// one feature taken away, as other controllers lack it.
//
// Units and signs are those of fixpid_pid.h; gains are per step. Left out are
// reverse action, which is the same law with both signals negated, and the
// limits of int16_t.
#ifndef LAW_H
#define LAW_H
#include <stdbool.h>

enum law_without {
    LAW_WHOLE,
    LAW_NO_ANTI_WINDUP,        // the integral always moves
    LAW_SIGN_BLIND,            // it rests while the output is limited, even
                               // where it would leave the limit
    LAW_INTEGRAL_CLAMPED,      // it is kept inside the output's range
    LAW_DERIVATIVE_ON_ERROR,   // instead of on the measurement
    LAW_EIGHT_FRACTIONAL_BITS, // of the integral gain
    LAW_NO_SEED                // manual to automatic: where the integral was
};

struct law_gains {
    double kp;
    double ki; // per step
    double kd; // per step, before the filter
    int filter;
};

struct law {
    enum law_without without;
    struct law_gains gains;
    double setpoint_weight;
    double output_min;
    double output_max;
    double integral_min; // none of its own if both are 0
    double integral_max;
    double feedforward; // output counts, added to the terms

    double proportional;
    double integral;
    double derivative;
    double previous;
    double held;
    bool first;
    bool seeded;
    bool manual;
};

void law_init(struct law *self, enum law_without without,
              const struct law_gains *gains, double setpoint_weight,
              double output_min, double output_max);
void law_set_limits(struct law *self, double output_min, double output_max);
void law_set_manual(struct law *self, double output);
void law_set_auto(struct law *self);

// The output before it is rounded to a whole count.
double law_step(struct law *self, double setpoint, double measurement);

#endif
