// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table for chips with a multiplier of 8 bits or none.
#ifndef FIXPID_TABLE_NARROW_H
#define FIXPID_TABLE_NARROW_H
#include <stdbool.h>
#include <stdint.h>

#include "../common/fixpid_bits.h"

#if FIXPID_MULTIPLIER_BITS == 0

// a * b, by shift and add from the top: what is added is a * 2^16, and each
// turn halves the sum. The sum stays below 2^31 + a * 2^15 < 2^32.
FIXPID_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    const uint32_t added = (uint32_t)a << 15;
    uint32_t sum = b;
    uint8_t n;

    for (n = 16; n != 0u; n--) {
        const bool odd = ((uint8_t)sum & 1u) != 0u;

        sum >>= 1;
        if (odd) {
            sum += added;
        }
    }
    return sum;
}

#elif defined(__AVR__) // its compiler has the four products

FIXPID_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

#else

// a * b, from four products of bytes. Each sum is at most 255 * 255 + 255.
FIXPID_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    const uint8_t a_low = (uint8_t)a;
    const uint8_t a_high = (uint8_t)(a >> 8);
    const uint8_t b_low = (uint8_t)b;
    const uint8_t b_high = (uint8_t)(b >> 8);
    const uint16_t lowest = fixpid_8x8(a_low, b_low);
    const uint16_t left =
        (uint16_t)(fixpid_8x8(a_high, b_low) + (uint8_t)(lowest >> 8));
    const uint16_t right =
        (uint16_t)(fixpid_8x8(a_low, b_high) + (uint8_t)left);
    const uint16_t high =
        (uint16_t)(fixpid_8x8(a_high, b_high) + (uint8_t)(left >> 8) +
                   (uint8_t)(right >> 8));
    const uint16_t low = (uint16_t)((uint16_t)(right << 8) | (uint8_t)lowest);

    return ((uint32_t)high << 16) | low;
}

#endif

// The share of a rise that a part of the run has, rounded by `half`:
// floor((rise * part + half) / run). pre: part < run, half < run; post:
// 0..rise. It divides by hand, a bit at a time, because the compilers divide 32
// bits by 32, which takes longer than all the rest of a lookup. The sum is
// below 65536 * run: its upper half is below the run, and the quotient has 16
// bits. Where the remainder has 17 bits, the one that leaves it counts.
FIXPID_INLINE uint16_t share(uint16_t rise, uint16_t part, uint16_t run,
                             uint16_t half)
{
    const uint32_t sum = product(rise, part) + half;
    uint16_t rest = (uint16_t)(sum >> 16);
    uint16_t quotient = (uint16_t)sum; // its bits come in where the sum's leave
    uint8_t n;

    for (n = 16; n != 0u; n--) {
        bool fits = (rest & FIXPID_SIGN_BIT) != 0u;

        rest = (uint16_t)(rest << 1);
        if ((quotient & FIXPID_SIGN_BIT) != 0u) {
            rest |= 1u;
        }
        quotient = (uint16_t)(quotient << 1);
        if (rest >= run) {
            fits = true;
        }
        if (fits) {
            rest = (uint16_t)(rest - run);
            quotient |= 1u;
        }
    }
    return quotient;
}

#endif
