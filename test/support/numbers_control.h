// SPDX-License-Identifier: MIT
// Random arguments of the modules beside fixpid_pid, and what they are made of.
// Those of each module are a source of their own, because SDCC links whole
// object files.
#ifndef NUMBERS_CONTROL_H
#define NUMBERS_CONTROL_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_gains.h"
#include "fixpid_guard.h"
#include "fixpid_table.h"
#include "fixpid_tpo.h"

// True once in `count` times.
bool numbers_one_in(uint32_t count);

// Any uint32_t, each number of bits as often as another.
uint32_t numbers_any_size(void);

// As far as `most` below or above, and wraps.
int16_t numbers_close_to(int16_t value, uint16_t most);

// Random arguments of fixpid_gains: legal ones, their ends often, and a few
// that are not.
void numbers_gains_milli(struct fixpid_gains_milli *milli);
uint32_t numbers_gains_rate(void);
uint8_t numbers_gains_filter(void);

// Random arguments of fixpid_guard, likewise. What a guard is given, step by
// step.
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

// A random rate of fixpid_slew, its ends often.
uint32_t numbers_slew_rate(void);

// Random points of fixpid_table, and where they are looked up.

// `most` points or fewer, nearly always in order. pre: most <= 255
uint8_t numbers_table_points(struct fixpid_table_point points[], uint8_t most);

// Where that table is looked up: at its points, near them, and elsewhere.
int16_t numbers_table_x(const struct fixpid_table_point points[],
                        uint8_t count);

// Random arguments of fixpid_tpo: legal ones, their ends often, and a few that
// are not.
void numbers_tpo_config(struct fixpid_tpo_config *config);

// Duties of that configuration's range, its ends, and others.
int16_t numbers_tpo_duty(int16_t full);

#endif
