// SPDX-License-Identifier: MIT
// Two functions of fixpid_signed.h for an int of 16 bits, which its narrow form
// and an AVR's share.
#ifndef FIXPID_SIGNED_INT16_H
#define FIXPID_SIGNED_INT16_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_bits.h"

// It shifts in steps, because compilers make a loop of a shift by a variable.
// The floor of a floor is the floor of both divisions.
FIXPID_INLINE int32_t shift_right_by(int32_t x, uint8_t places)
{
    int32_t quotient = x;

    if ((places & 4u) != 0u) {
        quotient = shift_right_floor(quotient, 4);
    }
    if ((places & 2u) != 0u) {
        quotient = shift_right_floor(quotient, 2);
    }
    if ((places & 1u) != 0u) {
        quotient = shift_right_floor(quotient, 1);
    }
    return quotient;
}

#if !defined(__SDCC) // which has macros in fixpid_bits_sdcc.h
// A signal of 16 bits in a register.
typedef int16_t signal_word;

FIXPID_INLINE bool reaches(int16_t limit, int16_t counts, int32_t integral)
{
    (void)integral;
    return counts >= limit;
}

FIXPID_INLINE bool is_just(int16_t limit, int16_t counts, int32_t integral,
                           uint8_t fraction)
{
    if (counts != limit) {
        return false;
    }
    return ((uint16_t)integral | fraction) == 0u;
}
#endif

#endif
