// SPDX-License-Identifier: MIT
// How good gains are for a plant that is known exactly.
#ifndef EVALUATION_H
#define EVALUATION_H
#include "fixpid_pid.h"
#include "response.h"

#define JUDGE_POINTS 701

// A plant with what its judgements need.
struct evaluation {
    const struct plant_lags *plant;
    double radians[JUDGE_POINTS]; // per step, up to pi
    double complex response[JUDGE_POINTS];
    double load; // output counts
    int steps;   // of its loops
    double best; // sum of the errors with the gains that knowledge gives
};

void evaluation_start(struct evaluation *self, const struct plant_lags *plant);

// Ms: the largest factor by which the loop makes a disturbance greater than it
// is without a controller.
double evaluation_sensitivity(const struct evaluation *self,
                              const struct fixpid_pid_gains *gains);

// Sum of the magnitude of the error after a step of the load, in a loop of
// fixpid_pid itself, over the sum with SIMC's gains for the true plant in
// double precision. A loop that does not come to rest has none: -1.
double evaluation_load(const struct evaluation *self,
                       const struct fixpid_pid_gains *gains);

#endif
