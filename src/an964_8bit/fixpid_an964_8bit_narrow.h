// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h by shift and add, for chips without
// a multiplier. A byte moves right once per bit of k, which divides it; where
// all divisions are done, x moves left instead. It is a 16-bit variable from
// the start, because widening it later is expensive with SDCC.
#ifndef FIXPID_AN964_8BIT_NARROW_H
#define FIXPID_AN964_8BIT_NARROW_H
#include <stdint.h>

#include "../common/fixpid_shift_add.h"
#include "fixpid_an964_8bit.h"

// Adds the sixth and the seventh bit of k, which is at most
// FIXPID_AN964_8BIT_TERM_LIMIT.
#if FIXPID_AN964_8BIT_TERM_LIMIT > 31
FIXPID_INLINE uint16_t fixpid_last_bits(uint16_t sum, uint16_t x, uint8_t k)
{
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 32u);
    x = (uint16_t)(x + x);
    fixpid_add_word_if(&sum, x, k & 64u);
    return sum;
}
#else
FIXPID_INLINE uint16_t fixpid_last_bits(uint16_t sum, uint16_t x, uint8_t k)
{
    (void)x;
    (void)k;
    return sum;
}
#endif

// Before each move a byte is below 2 * 2^7.
FIXPID_INLINE uint8_t fixpid_7x7_div4(uint8_t x, uint8_t k, uint8_t round_up,
                                      uint8_t limit)
{
    uint8_t low = (uint8_t)(round_up & 3u);
    uint16_t word = x;
    uint16_t sum;

    fixpid_add_byte_if(&low, x, k & 1u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 4u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 8u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 16u);
    sum = fixpid_last_bits(sum, word, k);
    if (sum > (uint16_t)limit) {
        sum = limit;
    }
    return (uint8_t)sum;
}

FIXPID_INLINE uint8_t fixpid_7x7_div8(uint8_t x, uint8_t k)
{
    uint16_t word = x;
    uint8_t low = (uint8_t)word >> 1; // the first bit
    uint16_t sum;

    if ((k & 1u) == 0u) {
        low = 0;
    }
    fixpid_add_byte_if(&low, (uint8_t)word, k & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, (uint8_t)word, k & 4u);
    low >>= 1;
    fixpid_add_byte_if(&low, (uint8_t)word, k & 8u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 16u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 32u);
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 64u);
    if ((sum & 0xFF80u) != 0u) {
        sum = 127;
    }
    return (uint8_t)sum;
}

FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t x, uint8_t k)
{
    uint16_t word = x;
    uint8_t low = x >> 1; // the first bit
    uint16_t sum;

    if ((k & 1u) == 0u) {
        low = 0;
    }
    fixpid_add_byte_if(&low, x, k & 2u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 4u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 8u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 16u);
    low >>= 1;
    fixpid_add_byte_if(&low, x, k & 32u);
    sum = low;
    word = (uint16_t)(word + word);
    fixpid_add_word_if(&sum, word, k & 64u);
    return sum;
}

#endif
