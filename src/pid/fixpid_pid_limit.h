// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid that move its integral between two steps
// share. It is not in fixpid_pid_private.h, because SDCC keeps a static
// function in each source, even if nobody calls it there.
#include "fixpid_pid_private.h"

#ifndef FIXPID_PID_LIMIT_H
#define FIXPID_PID_LIMIT_H

// Moves the integral inside its limits. Each source that includes this has its
// own copy: see fixpid_pid_accept.h.
static void limit_integral(FIXPID_DATA struct fixpid_pid *self)
{
    const int16_t counts = (int16_t)shift_right_floor(SELF.integral, 16);

    if (counts >= SELF.integral_max) {
        SELF.integral = shift_left(SELF.integral_max, 16);
        SELF.integral_fraction = 0;
    }
    if (counts < SELF.integral_min) {
        SELF.integral = shift_left(SELF.integral_min, 16);
        SELF.integral_fraction = 0;
    }
}

#endif
