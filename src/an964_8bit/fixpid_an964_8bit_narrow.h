// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h by shift and add, for chips without
// a multiplier. A byte moves right once per bit of the magnitude, which divides
// it; where all divisions are done, the gain moves left instead. It is a 16-bit
// variable from the start, because widening it later is expensive with SDCC.
#ifndef FIXPID_AN964_8BIT_NARROW_H
#define FIXPID_AN964_8BIT_NARROW_H
#include <stdint.h>

#include "../common/fixpid_shift_add.h"
#include "fixpid_an964_8bit.h"

// Adds the sixth and the seventh bit of the magnitude, which is at most
// FIXPID_AN964_8BIT_TERM_LIMIT.
#if FIXPID_AN964_8BIT_TERM_LIMIT > 31
FIXPID_INLINE uint16_t fixpid_last_bits(uint16_t sum, uint16_t gain,
                                        uint8_t magnitude)
{
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 32u);
    gain = (uint16_t)(gain + gain);
    fixpid_add_word_if(&sum, gain, magnitude & 64u);
    return sum;
}
#else
FIXPID_INLINE uint16_t fixpid_last_bits(uint16_t sum, uint16_t gain,
                                        uint8_t magnitude)
{
    (void)gain;
    (void)magnitude;
    return sum;
}
#endif

// Before each move a byte is below 2 * 2^7.
FIXPID_INLINE uint8_t fixpid_7x7_div4(uint8_t gain, uint8_t magnitude,
                                      uint8_t round_up, uint8_t limit)
{
    uint8_t low = (uint8_t)(round_up & 3u);
    uint16_t word = gain;
    uint16_t sum;

    fixpid_add_byte_if(&low, gain, magnitude & 1u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 4u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 8u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 16u);
    sum = fixpid_last_bits(sum, word, magnitude);
    if (sum > (uint16_t)limit) {
        sum = limit;
    }
    return (uint8_t)sum;
}

FIXPID_INLINE uint8_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude)
{
    uint16_t word = gain;
    uint8_t low = (uint8_t)word >> 1; // the first bit
    uint16_t sum;

    if ((magnitude & 1u) == 0u) {
        low = 0;
    }
    fixpid_add_byte_if(&low, (uint8_t)word, magnitude & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, (uint8_t)word, magnitude & 4u);
    low >>= 1;
    fixpid_add_byte_if(&low, (uint8_t)word, magnitude & 8u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 16u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 32u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 64u);
    if ((sum & 0xFF80u) != 0u) {
        sum = 127;
    }
    return (uint8_t)sum;
}

FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude)
{
    uint16_t word = gain;
    uint8_t low = gain >> 1; // the first bit
    uint16_t sum;

    if ((magnitude & 1u) == 0u) {
        low = 0;
    }
    fixpid_add_byte_if(&low, gain, magnitude & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 4u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 8u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 16u);
    low >>= 1;
    fixpid_add_byte_if(&low, gain, magnitude & 32u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, magnitude & 64u);
    return sum;
}

#endif
