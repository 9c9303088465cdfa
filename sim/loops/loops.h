// SPDX-License-Identifier: MIT
// The comparisons: each prints rows of comma-separated values.
#ifndef LOOPS_H
#define LOOPS_H
#include "fixpid_pid.h"
#include "trials.h"

// fixpid_pid, or what it is compared with, as one thing in a loop.
struct loop {
    bool fixed; // fixpid_pid; else the law
    struct fixpid_pid pid;
    struct pid_double exact;
    struct motion motion;
    double output; // counts, as last given to the plant
};

// The configuration of fixpid_pid that comes closest to real gains.
struct fixpid_pid_config loop_config(const struct pid_double_gains *gains,
                                     double setpoint_weight, double output_min,
                                     double output_max);

// Both controllers with a trial's gains, its plant at rest. The actuator takes
// whole counts, of either of them.
void loop_start(struct loop *self, const struct trial *trial, bool fixed);

// One step; self->motion.value is what it led to.
void loop_step(struct loop *self, double setpoint);

void print_comparison(void); // of how well both do on five plants
void print_agreement(void);  // step by step, on the same readings
void print_autotune(void);
void print_failures(void);

#endif
