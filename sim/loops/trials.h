// SPDX-License-Identifier: MIT
// The five plants that a controller meets most, each with what the comparisons
// do with it: gains, setpoints and a relay experiment.
#ifndef TRIALS_H
#define TRIALS_H
#include <stdint.h>

#include "law.h"
#include "plant_counts.h"

#define TRIALS 5
#define TRIAL_SETPOINTS 3

struct trial {
    struct plant_counts plant;
    double output_min;
    double output_max;

    struct law_gains gains;
    double setpoint_weight;

    // One after the other; the second is out of reach of all but the
    // integrator.
    double setpoints[TRIAL_SETPOINTS];
    int steps; // of each

    // Of the relay experiment, and of the loop with the gains that it finds.
    int16_t relay_low;
    int16_t relay_high;
    double tune_at;
    uint16_t timeout_steps;
    int tuned_steps;
};

extern const struct trial trials[TRIALS];

#endif
