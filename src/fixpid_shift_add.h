// SPDX-License-Identifier: MIT
// One step of a multiplication by shift and add: it adds x if a bit is set.
#ifndef FIXPID_SHIFT_ADD_H
#define FIXPID_SHIFT_ADD_H
#include <stdint.h>

#include "fixpid_bits.h"

#if defined(__SDCC)
#include "sdcc/fixpid_shift_add_sdcc.h"
#else

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

#endif

#endif
