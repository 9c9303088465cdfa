// SPDX-License-Identifier: MIT
// The examples' guard, and which of its alarms switch off.
#ifndef ALARM_H
#define ALARM_H
#include "fixpid_guard.h"

// FIXPID_GUARD_OSCILLATING is none of them: a sensor that is noisy for a while
// looks like a loop that swings, and the loops survive that. It stays to be
// read in the guard's flags.
#define ALARMS                                                                 \
    (FIXPID_GUARD_ALARMS & (uint8_t) ~(uint8_t)FIXPID_GUARD_OSCILLATING)

// Deviation 8.4: the application's one guard, found by its name.
FIXPID_DATA struct fixpid_guard guard;

#endif
