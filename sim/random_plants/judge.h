// SPDX-License-Identifier: MIT
// How good gains are for a plant that is known exactly.
#ifndef JUDGE_H
#define JUDGE_H
#include "design.h"
#include "families.h"

#define JUDGE_FINE 2048
#define JUDGE_COARSE 256

// A plant's response at frequencies that are evenly spaced on a logarithmic
// scale, up to pi radians per step. What is between two of them is not seen.
// The search for the best controller has time for coarse ones only.
struct judge {
    int points;
    double complex before[JUDGE_FINE]; // 1 / z there
    double complex sum[JUDGE_FINE];    // 1 / (1 - 1 / z)
    double complex response[JUDGE_FINE];
    bool integrating;
    bool unstable;
};

// With so many points, JUDGE_FINE at most.
void judge_start(struct judge *self, const struct subject *subject, int points);

// Ms: the largest factor by which the sampled loop makes a disturbance greater
// than it is without a controller. HUGE_VAL if the loop is unstable, which
// Nyquist's curve shows by how often it goes around -1.
double judge_sensitivity(const struct judge *self, const struct design *design);

// The same for a row: 0 where there are no gains, and -1 where the loop is
// unstable.
double judge_told(const struct judge *self, const struct design *design);

// Of the PI controllers whose loop has at most this Ms, the one with the
// largest ki: it has the smallest sum of errors after a step of the load, which
// is 1 / ki. Not found if there is none.
struct design judge_best(const struct judge *self, double period_steps,
                         double most);

#endif
