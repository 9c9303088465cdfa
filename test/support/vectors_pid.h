// SPDX-License-Identifier: MIT
// The rows of fixpid_pid's definition are older than two things of today: a
// weight of 0 was what an option says now, and they know only these flags.
#ifndef VECTORS_PID_H
#define VECTORS_PID_H
#include <stdint.h>

#include "fixpid_pid.h"

#define VECTORS_PID_FLAGS                                                      \
    (FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN | FIXPID_PID_FIRST |                \
     FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

static inline uint8_t vectors_pid_options(int32_t options, int32_t weight)
{
    const unsigned weightless =
        (weight == 0) ? FIXPID_PID_PROPORTIONAL_ON_MEASUREMENT : 0u;

    return (uint8_t)((unsigned)options | weightless);
}

#endif
