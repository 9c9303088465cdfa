// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h by shift and add, for chips without a
// multiplier that is wide enough. The sum moves right once per bit of k, which
// divides it; where all divisions are done, x moves left instead. They are
// unrolled, because a loop takes a third more.
#ifndef FIXPID_AN964_NARROW_H
#define FIXPID_AN964_NARROW_H
#include <stdint.h>

#include "../common/fixpid_shift_add.h"
#include "fixpid_an964.h"

// Before each move the sum is below 2 * 2^10.
FIXPID_INLINE uint16_t fixpid_10x7_div16(uint8_t k, uint16_t x)
{
    uint16_t sum = 0;

    fixpid_add_word_if(&sum, x, k & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 16u);
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 32u);
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 64u);
    return sum;
}

// Adds the eighth bit of k, which is at most FIXPID_AN964_TERM_LIMIT.
#if FIXPID_AN964_TERM_LIMIT > 127
FIXPID_INLINE uint16_t fixpid_eighth_bit(uint16_t sum, uint16_t x, uint8_t k)
{
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 128u);
    return sum;
}
#else
FIXPID_INLINE uint16_t fixpid_eighth_bit(uint16_t sum, uint16_t x, uint8_t k)
{
    (void)x;
    (void)k;
    return sum;
}
#endif

FIXPID_INLINE uint16_t fixpid_10x8_div32(uint8_t k, uint16_t x,
                                         uint8_t round_up, uint8_t limit)
{
    uint16_t sum = (uint8_t)(round_up & 31u);

    fixpid_add_word_if(&sum, x, k & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 16u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, k & 32u);
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 64u);
    sum = fixpid_eighth_bit(sum, x, k);
    return (sum > limit) ? limit : sum;
}

// Before each move the sum is below 2 * 2^14.
FIXPID_INLINE uint16_t fixpid_14x10_div1024(uint16_t x, uint16_t k)
{
    const uint8_t low = (uint8_t)(k & 0xFFu);
    const uint8_t high = (uint8_t)(k >> 8);
    uint16_t sum = 0;

    fixpid_add_word_if(&sum, x, low & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 16u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 32u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 64u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, low & 128u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, high & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, x, high & 2u);
    sum >>= 1;
    return sum;
}

#endif
