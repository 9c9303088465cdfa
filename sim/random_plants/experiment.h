// SPDX-License-Identifier: MIT
// The autotuner as one thing that takes a controller's place.
#ifndef EXPERIMENT_H
#define EXPERIMENT_H
#include "draw.h"
#include "fixpid_autotune.h"

struct experiment {
    struct fixpid_autotune autotune;
    uint8_t status;
    long steps;
    long outside; // steps with an output beyond the range that was given
};

// Does the task's experiment to its end, or for STEPS_MAX steps.
void experiment_run(struct experiment *self, const struct task *task);

// The rules of its tuner, by their names in the header, and how many.
const char *const *experiment_rules(int *count);

bool experiment_result(const struct experiment *self, int rule,
                       struct fixpid_pid_gains *gains);

#endif
