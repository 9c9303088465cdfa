// SPDX-License-Identifier: MIT
// What a machine at its setpoint answers to a small change of its output, as a
// linear plant that is sampled.
#ifndef ANSWER_H
#define ANSWER_H
#include <complex.h>

#include "machine.h"

#define ANSWER_STEPS 3000

struct answer {
    int count;
    double change[ANSWER_STEPS]; // of the reading, in the steps after a pulse
    double fades; // and from then on, by this factor a step; 1: it integrates
    double least; // radians a step, below which nothing happens
};

void answer_of(struct answer *self, const struct machine *machine);

// From the held output to the sampled reading, 0 < radians <= pi per step.
double complex answer_response(const struct answer *self, double radians);

// Of its oscillation at -180 degrees, in steps; 0: there is none.
double answer_period(const struct answer *self);

#endif
