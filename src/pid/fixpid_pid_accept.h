// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid that take a range of the integral share.
#include "fixpid_pid_private.h"

#ifndef FIXPID_PID_ACCEPT_H
#define FIXPID_PID_ACCEPT_H

// Checks and takes a range of the integral, for init and for
// fixpid_pid_set_integral_limits. Returns false for an illegal range, and has
// then changed nothing. This header and fixpid_pid_limit.h are two, because
// SDCC keeps a copy of a static function in each source, even if nothing there
// calls it: each source includes only what it calls.
static bool accept_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                   int16_t low, int16_t high)
{
    if ((low | high) == 0) { // no range of its own
        low = -INT16_MAX;
        high = INT16_MAX;
    }
    if (low == INT16_MIN) {
        return false;
    }
    if (low > high) {
        return false;
    }
    SELF.integral_min = low;
    SELF.integral_max = high;
    return true;
}

#endif
