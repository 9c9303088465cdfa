// SPDX-License-Identifier: MIT
// The five plants that a controller meets most, each with what the comparisons
// do with it: gains and setpoints.
#ifndef TRIALS_H
#define TRIALS_H
#include <stdint.h>

#include "pid_double.h"
#include "plant_counts.h"

#define TRIALS 5
#define TRIAL_SETPOINTS 3

struct trial {
    struct plant_counts plant;
    double output_min;
    double output_max;

    struct pid_double_gains gains;
    double setpoint_weight;

    // One after the other; the second is out of reach of all but the
    // integrator.
    double setpoints[TRIAL_SETPOINTS];
    int steps; // of each
};

extern const struct trial trials[TRIALS];

#endif
