// SPDX-License-Identifier: MIT
// The two autotuners as one thing that takes a controller's place.
#ifndef EXPERIMENT_H
#define EXPERIMENT_H
#include "draw.h"
#include "fixpid_autotune.h"
#include "fixpid_relay.h"

struct experiment {
    bool is_relay; // fixpid_relay; else fixpid_autotune
    struct fixpid_relay relay;
    struct fixpid_autotune autotune;
    uint8_t status;
    long steps;
    long outside; // steps with an output beyond the range that was given
};

// Does the task's experiment to its end, or for STEPS_MAX steps.
void experiment_run(struct experiment *self, const struct task *task,
                    bool is_relay);

// The rules of its tuner, by their names in the header, and how many.
const char *const *experiment_rules(const struct experiment *self, int *count);

bool experiment_result(const struct experiment *self, int rule,
                       struct fixpid_pid_gains *gains);

#endif
