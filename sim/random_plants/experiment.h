// SPDX-License-Identifier: MIT
// fixpid_autotune in the controller's place on a bench.
#ifndef EXPERIMENT_H
#define EXPERIMENT_H
#include "bench.h"
#include "design.h"
#include "fixpid_autotune.h"

// Two rules with three words of robustness each.
#define DESIGNS 6
#define DESIGN_PI_SAFE 1

struct experiment {
    struct fixpid_autotune autotune;
    uint8_t status;
    long steps;
    long outside; // steps with an output beyond the range that was given
};

// No experiment is longer: 34 + 97 * 32767 steps.
#define EXPERIMENT_STEPS 4000000L

// With this output at rest; the first step is the caller's.
void experiment_start(struct experiment *self, const struct subject *subject,
                      double rest);

// Does the subject's experiment to its end.
void experiment_run(struct experiment *self, const struct subject *subject);

// "PI quick", "PI safe", "PI calm", and "PID ..." the same; what the tuners'
// results are asked for; and what they answer.
const char *design_name(int number);
uint8_t design_rule(int number);
uint8_t design_robustness(int number);
struct design design_of(const struct fixpid_pid_gains *gains);

struct design experiment_design(const struct experiment *self, int number);

// One of enum fixpid_autotune_cause.
int experiment_reason(const struct experiment *self, int number);

#endif
