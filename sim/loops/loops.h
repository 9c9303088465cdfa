// SPDX-License-Identifier: MIT
// The five plants that a controller meets most, each with what the comparisons
// do with it, and what is printed of them: rows of cells between semicolons.
#ifndef LOOPS_H
#define LOOPS_H
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

void print_comparison(void); // of how well both do on five plants
void print_agreement(void);  // step by step, on the same readings
void print_autotune(void);
void print_failures(void);

#endif
