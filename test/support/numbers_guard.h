// SPDX-License-Identifier: MIT
// Random arguments of fixpid_guard: legal ones, their ends often, and a few
// that are not.
#ifndef NUMBERS_GUARD_H
#define NUMBERS_GUARD_H
#include "fixpid_guard.h"

// What a guard is given, step by step.
struct numbers_guard {
    int16_t setpoint;
    int16_t measurement;
    int16_t output;
};

// Short patiences and narrow bands, so that many alarms are seen.
void numbers_guard_config(struct fixpid_guard_config *config);

// The next step of that configuration: what it was, or near it, or at an end.
void numbers_guard_move(struct numbers_guard *now,
                        const struct fixpid_guard_config *config);

#endif
