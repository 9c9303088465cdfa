// SPDX-License-Identifier: MIT
// The definition of fixpid_reaction in 64-bit arithmetic. Recorded rows, random
// calls and chips compare with it.
#ifndef REFERENCE_REACTION_H
#define REFERENCE_REACTION_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_reaction.h"

// An all-zero one is refused, like the module.
struct reference_reaction {
    struct fixpid_reaction_config config;
    int64_t status;
    int64_t listened; // steps
    int64_t start, low, high, first, base, band, reach, scale;
    int64_t n, b, left, sum, m[8]; // of the record
};

bool reference_reaction_init(struct reference_reaction *self,
                             const struct fixpid_reaction_config *config);
void reference_reaction_reset(struct reference_reaction *self);
int64_t reference_reaction_step(struct reference_reaction *self,
                                int64_t measurement);
int64_t reference_reaction_progress(const struct reference_reaction *self);
bool reference_reaction_model(const struct reference_reaction *self,
                              struct fixpid_reaction_process *process);
bool reference_reaction_result(const struct reference_reaction *self,
                               int64_t rule, int64_t robustness_q4,
                               struct fixpid_pid_gains *gains);

#endif
