// SPDX-License-Identifier: MIT
// The definitions of fixpid_slew, fixpid_tpo, fixpid_guard, fixpid_gains and
// fixpid_table in 64-bit arithmetic. Recorded rows, random calls and chips
// compare with them.
#ifndef REFERENCE_CONTROL_H
#define REFERENCE_CONTROL_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_gains.h"
#include "fixpid_guard.h"
#include "fixpid_table.h"
#include "fixpid_tpo.h"

struct reference_slew {
    int64_t value, rise, fall; // x 2^16
};

void reference_slew_init(struct reference_slew *self, int64_t rise,
                         int64_t fall);
void reference_slew_seed(struct reference_slew *self, int64_t value);
int64_t reference_slew_step(struct reference_slew *self, int64_t target);

// An all-zero one is refused, like the module.
struct reference_tpo {
    int64_t full, window, minimum_on, minimum_off;
    int64_t carry; // duty * steps, from one window to the next
    int64_t pulse; // on-steps of this window
    int64_t at;    // steps of this window that are over
};

bool reference_tpo_init(struct reference_tpo *self,
                        const struct fixpid_tpo_config *config);
void reference_tpo_reset(struct reference_tpo *self);
bool reference_tpo_step(struct reference_tpo *self, int64_t duty);

// Where the reading is, and what an end of the output pushes it out of.
enum reference_zone { REFERENCE_INSIDE, REFERENCE_BELOW, REFERENCE_ABOVE };

// An all-zero one is refused, like the module.
struct reference_guard {
    int64_t output_min, output_max, measurement_min, measurement_max;
    int64_t reach_min, reach_max, band, patience; // patience 0: refused
    bool reverse, noisy;
    int64_t last, run, hold, count, mark, anchor, swings, strikes;
    enum reference_zone zone, end, outside;
    unsigned flags;
};

bool reference_guard_init(struct reference_guard *self,
                          const struct fixpid_guard_config *config);
void reference_guard_reset(struct reference_guard *self);
void reference_guard_acknowledge(struct reference_guard *self);
unsigned reference_guard_step(struct reference_guard *self, int64_t setpoint,
                              int64_t measurement, int64_t output);
unsigned reference_guard_flags(const struct reference_guard *self);
bool reference_guard_from_model(struct fixpid_guard_config *config,
                                const struct fixpid_guard_model *model);

bool reference_gains_from_milli(struct fixpid_pid_gains *gains,
                                const struct fixpid_gains_milli *milli,
                                int64_t rate_milli, int64_t filter);
bool reference_gains_to_milli(struct fixpid_gains_milli *milli,
                              const struct fixpid_pid_gains *gains,
                              int64_t rate_milli);

bool reference_table_valid(const struct fixpid_table *self);
// pre: it is valid, or has one point or none
int64_t reference_table_at(const struct fixpid_table *self, int64_t x);

#endif
