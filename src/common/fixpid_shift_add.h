// SPDX-License-Identifier: MIT
// Multiplication by shift and add, for chips without a multiplier: one step of
// it, which adds x if a bit is set, and a whole product.
#ifndef FIXPID_SHIFT_ADD_H
#define FIXPID_SHIFT_ADD_H
#include <stdint.h>

#include "fixpid_bits.h"

#if !defined(__SDCC) // which has macros in fixpid_bits_sdcc.h

// sum += x if `bit` is not 0. pre: it fits
FIXPID_INLINE void fixpid_add_byte_if(uint8_t *sum, uint8_t x, uint8_t bit)
{
    if (bit != 0u) {
        *sum = (uint8_t)(*sum + x);
    }
}

FIXPID_INLINE void fixpid_add_word_if(uint16_t *sum, uint16_t x, uint8_t bit)
{
    if (bit != 0u) {
        *sum = (uint16_t)(*sum + x);
    }
}

// gain * x in `bits` turns. One word holds the bits of the gain that are left
// and, above them, the product so far; both move right.
//
// pre: gain < 2^bits, -2^(30 - bits) <= x < 2^(30 - bits). Before it moves, the
// word is within 2 * 2^(30 - bits) * 2^bits = 2^31. Of any other x the result
// is wrong, but not undefined.
FIXPID_INLINE int32_t fixpid_product_in_turns(uint16_t gain, int32_t x,
                                              uint8_t bits)
{
    // Deviation 10.8: a pattern of two's complement
    const int32_t addend = (int32_t)((uint32_t)x * (UINT32_C(1) << bits));
    int32_t word = (int32_t)gain;

    for (uint_fast8_t turn = bits; turn != 0u; turn--) {
        if ((word & 1) != 0) {
            word = fixpid_add32(word, addend);
        }
        word = shift_right_floor(word, 1);
    }
    return word;
}

#endif

#endif
