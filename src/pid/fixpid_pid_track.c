// SPDX-License-Identifier: MIT
// Tracking, in a file of its own because SDCC links whole object files.
#include "fixpid_pid.h"

// Without the feature this file is empty.
#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_TRACK) != 0
#include "fixpid_pid_limit.h"
#include "fixpid_pid_private.h"

#define SHIFT_MAX 15u

void fixpid_pid_track(FIXPID_DATA struct fixpid_pid *self, int16_t applied,
                      uint8_t shift)
{
    const uint8_t places = (shift > SHIFT_MAX) ? (uint8_t)SHIFT_MAX : shift;
    int32_t change;

    FIXPID_ASSERT(VALID_SELF);
    if (REFUSED) {
        return;
    }
    if ((SELF.status & FIXPID_PID_FIRST) != 0u) {
        return;
    }
    change = sub16_sat(applied, SELF.output);
    SELF.output = applied;
    if ((SELF.status & HELD) != 0u) {
        return;
    }
    // It is a multiple of 2^16 and within 2^31, so that no place is lost.
    // shift_right_by takes the lowest three bits of what it is given, which may
    // be a controller's options or, as here, a number of places: the eights are
    // left.
    change = shift_right_by(shift_left(change, 16), places);
    if ((places & 8u) != 0u) {
        change = shift_right_floor(change, 8);
    }
    // The integral's limits are within 32767 counts, so a sum that saturates
    // lies beyond them.
    SELF.integral = add32_sat(SELF.integral, change);
    limit_integral(self);
}

#endif
