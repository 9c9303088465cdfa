// SPDX-License-Identifier: MIT
// A row has the three bools of a configuration as bits of one byte, its
// options. The rows of fixpid_pid's definition are older than two things of
// today: a weight of 0 was what a bool says now, and they know only these
// flags.
#ifndef VECTORS_PID_H
#define VECTORS_PID_H
#include <stdint.h>

#include "fixpid_pid.h"

#define VECTORS_PID_FLAGS                                                      \
    (FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN | FIXPID_PID_FIRST |                \
     FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

#define VECTORS_PID_REVERSE 0x80u
#define VECTORS_PID_DERIVATIVE_ON_ERROR 0x40u
#define VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT 0x20u
#define VECTORS_PID_OPTIONS 0xE0u

// The options of an older row.
static inline uint8_t vectors_pid_options(int32_t options, int32_t weight)
{
    const unsigned weightless =
        (weight == 0) ? VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT : 0u;

    return (uint8_t)((unsigned)options | weightless);
}

// A row with any other bit stands for a configuration that is refused.
static inline void vectors_pid_set_options(struct fixpid_pid_config *config,
                                           unsigned options)
{
    config->reverse = (options & VECTORS_PID_REVERSE) != 0u;
    config->derivative_on_error =
        (options & VECTORS_PID_DERIVATIVE_ON_ERROR) != 0u;
    config->proportional_on_measurement =
        (options & VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT) != 0u;
    if ((options & ~VECTORS_PID_OPTIONS) != 0u) {
        config->setpoint_weight_q8 = UINT16_MAX;
    }
}

static inline uint8_t vectors_pid_options_of(
    const struct fixpid_pid_config *config)
{
    return (uint8_t)((config->reverse ? VECTORS_PID_REVERSE : 0u) |
                     (config->derivative_on_error
                          ? VECTORS_PID_DERIVATIVE_ON_ERROR
                          : 0u) |
                     (config->proportional_on_measurement
                          ? VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT
                          : 0u));
}

#endif
