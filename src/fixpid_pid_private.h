// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid share: how they reach the controller, and its
// private bits.
#include "fixpid_pid.h"

#undef OBJECT
#ifdef FIXPID_PID_OBJECT
#define OBJECT FIXPID_PID_OBJECT
#endif
#include "fixpid_self.h"

#ifndef FIXPID_PID_PRIVATE_H
#define FIXPID_PID_PRIVATE_H
#include "fixpid_pid_arith.h"

// The output limits of a refused controller are equal.
#define REFUSED (SELF.output_min == SELF.output_max)

// Bits of `status` under which `integral` holds the output to return instead of
// an integral.
#define HELD (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

// The largest number of counts that 16 bits can hold, in 1/256.
#define COUNTS_MAX_Q8 INT32_C(0x7FFFFF)

// Checks and takes a range of the integral, for init and for
// fixpid_pid_set_integral_limits. Each source has its own copy and calls it
// once. Returns false for an illegal range, and has then changed nothing.
static bool accept_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                   int16_t integral_min, int16_t integral_max)
{
    int16_t low = integral_min;
    int16_t high = integral_max;

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
