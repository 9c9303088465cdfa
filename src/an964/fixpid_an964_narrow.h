// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h by shift and add, for chips without a
// multiplier that is wide enough. The sum moves right once per bit of the one
// factor, which divides it; where all divisions are done, the other moves left
// instead. They are unrolled, because a loop takes a third more.
#ifndef FIXPID_AN964_NARROW_H
#define FIXPID_AN964_NARROW_H
#include <stdint.h>

#include "../common/fixpid_shift_add.h"
#include "fixpid_an964.h"

// Before each move the sum is below 2 * 2^10.
FIXPID_INLINE uint16_t fixpid_10x7_div16(uint16_t gain, uint8_t magnitude)
{
    uint16_t sum = 0;

    fixpid_add_word_if(&sum, gain, magnitude & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 16u);
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 32u);
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 64u);
    return sum;
}

// Adds the eighth bit of the magnitude, which is at most
// FIXPID_AN964_TERM_LIMIT.
#if FIXPID_AN964_TERM_LIMIT > 127
FIXPID_INLINE uint16_t fixpid_eighth_bit(uint16_t sum, uint16_t gain,
                                         uint8_t magnitude)
{
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 128u);
    return sum;
}
#else
FIXPID_INLINE uint16_t fixpid_eighth_bit(uint16_t sum, uint16_t gain,
                                         uint8_t magnitude)
{
    (void)gain;
    (void)magnitude;
    return sum;
}
#endif

FIXPID_INLINE uint16_t fixpid_10x8_div32(uint16_t gain, uint8_t magnitude,
                                         uint8_t round_up, uint8_t limit)
{
    uint16_t sum = (uint8_t)(round_up & 31u);

    fixpid_add_word_if(&sum, gain, magnitude & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 16u);
    sum >>= 1;
    fixpid_add_word_if(&sum, gain, magnitude & 32u);
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 64u);
    sum = fixpid_eighth_bit(sum, gain, magnitude);
    return (sum > limit) ? limit : sum;
}

// Before each move the sum is below 2 * 2^14.
FIXPID_INLINE uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude)
{
    const uint8_t low = (uint8_t)(gain & 0xFFu);
    const uint8_t high = (uint8_t)(gain >> 8);
    uint16_t sum = 0;

    fixpid_add_word_if(&sum, magnitude, low & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 2u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 4u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 8u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 16u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 32u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 64u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, low & 128u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, high & 1u);
    sum >>= 1;
    fixpid_add_word_if(&sum, magnitude, high & 2u);
    sum >>= 1;
    return sum;
}

#endif
