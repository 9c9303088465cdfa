// SPDX-License-Identifier: MIT
// The definition of fixpid_reaction in 64-bit arithmetic. Recorded rows, random
// calls and chips compare with it.
//
// x is the reading's distance from the start, in the direction of the heat-up.
// The 32 steps before it tell the noise, peak to peak: the band. The record
// then keeps the means of up to 8 blocks of 2^b steps; when it is full, pairs
// become blocks of twice the length. A rise is taken across two blocks, so that
// a block's noise counts once. The record ends where the last rise is at most
// 9/8 of the largest one before it and above half of the steepest one, d.
//
// The tangent there, carried back to the step in which the output rose, misses
// the start by h. A steady drift of the start does not change h. It grows by
// half a band, which the noise leaves open, and by the slope of 1.5 steps for
// hold and sampling. With du the difference of both outputs and R the
// robustness in sixteenths:
//   H = 19 h (R + 18) / 256
//   C = H / slope                2.52 delays with R = 16
//   PI   kp = du / H             Ti = 3 C
//   PID  kp = 5/4 du / H         Ti = 2 C    Td = C / 8
// The constants come from a search on heaters: the largest ki for which 95 % of
// the loops have an Ms of at most 1.6.
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
