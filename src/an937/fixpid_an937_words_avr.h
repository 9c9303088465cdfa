// SPDX-License-Identifier: MIT
// The products of fixpid_an937_arith.h in C for an AVR with a multiplier: its
// compiler takes 18 cycles less for an error in 16 bits than in 32, where a
// Cortex-M would need more stack and an AVR without a multiplier 300 cycles
// more.
#ifndef FIXPID_AN937_WORDS_AVR_H
#define FIXPID_AN937_WORDS_AVR_H
#include <stdint.h>

#include "../common/fixpid_bits.h"
#include "fixpid_an937.h"

// sum + gain * number. pre: the result is within +-2^26
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_add32(sum, fixpid_number_term(gain, number));
}

// gain * error, of which a step has just set the lower 16 bits
FIXPID_INLINE int32_t fixpid_error_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *error)
{
    return (int32_t)gain * (int16_t)error->value;
}

// floor(x / 16). pre: x < 2^24
FIXPID_INLINE uint32_t fixpid_sixteenth(uint32_t x)
{
    return x >> 4;
}

#endif
