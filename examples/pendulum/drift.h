// SPDX-License-Identifier: MIT
// This is the drift offset of AN964's demonstrations, with the angles that they
// share.
//
// A drive that keeps its sign drives the base away: the offset shifts the
// upright angle until the base comes back.
#ifndef DRIFT_H
#define DRIFT_H
#include <stdint.h>

// This is how far the drift offset may go, in eighths of a 10-bit count. It is
// 0..127, and 0 switches the offset off. The note's value is 55.
#ifndef PENDULUM_DRIFT_LIMIT
#define PENDULUM_DRIFT_LIMIT 55
#endif
#if PENDULUM_DRIFT_LIMIT < 0 || PENDULUM_DRIFT_LIMIT > 127
#error "PENDULUM_DRIFT_LIMIT: 0..127"
#endif

#define UPRIGHT_COUNTS 512
#define ANGLE_LIMIT_COUNTS 341 // 20 degrees
#define NO_DRIFT 16

static int8_t drift_offset;

// Returns the offset / 8, rounded toward zero, plus NO_DRIFT: a number without
// a sign, which is divided by a shift, as a PIC16 has no division.
static uint8_t drift_counts(void)
{
    uint8_t eighths = (uint8_t)((uint8_t)drift_offset + 128u);

    if ((eighths & 128u) == 0u) {
        eighths += 7u; // at most 127 + 7
    }
    return (uint8_t)(eighths >> 3);
}

static void follow_drift(int16_t output)
{
    if (output < 0) {
        if (drift_offset != -PENDULUM_DRIFT_LIMIT) {
            drift_offset--;
        }
    } else if ((output != 0) && (drift_offset != PENDULUM_DRIFT_LIMIT)) {
        drift_offset++;
    } else {
        // neither rises nor falls
    }
}

#endif
