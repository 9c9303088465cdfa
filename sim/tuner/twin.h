// SPDX-License-Identifier: MIT
// The controllers in double precision, with the gains as they were typed and no
// rounding: what the integers cost is the difference.
#ifndef TUNER_TWIN_H
#define TUNER_TWIN_H
#include "pid_double.h"

struct twin {
    int kind;    // enum tuner_controller
    double sign; // -1: reverse acting
    struct pid_double exact;
    double sum;
    double errors[3];
    int ticks; // until the next derivative sample
    double delta;
};

// From tuner_params, before the first step.
void twin_begin(struct twin *self);

// What tuner_events say, as the library's controller is told.
void twin_event(struct twin *self, int what, double a, double b);

// The output in counts. `error` is what a note's controller gets.
double twin_step(struct twin *self, double setpoint, double measurement,
                 double error);

#endif
