// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table for chips that multiply bytes or not at all.
#ifndef FIXPID_TABLE_NARROW_H
#define FIXPID_TABLE_NARROW_H
#include <stdbool.h>
#include <stdint.h>

#include "../common/fixpid_bits.h"

#if defined(__AVR_HAVE_MUL__) // whose compiler has the four products of bytes

TABLE_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

#elif FIXPID_MULTIPLIER_BITS != 0
#include "fixpid_table_bytes.h"
#else

// a * b. The product moves right into the place of b, whose bits leave; what a
// bit adds is a * 2^16, halved as the sum is: below 2^31 + 2^31.
TABLE_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    const uint32_t added = (uint32_t)a << 15;
    uint32_t sum = b;
    uint8_t turn;

    for (turn = 16; turn != 0u; turn--) {
        const bool odd = (sum & 1u) != 0u;

        sum >>= 1;
        if (odd) {
            sum += added;
        }
    }
    return sum;
}

#endif

// floor(rise * part / run + 1/2). pre: part <= run, 1 <= run; post: 0..rise.
//
// It divides by hand, because the compilers divide by 32 bits, which takes
// longer than all the rest of a lookup. The sum is below 65536 * run: its upper
// half is below the run, and the quotient has 16 bits. They come into `low`
// where the sum's leave it. Twice the rest has 17 bits: where the highest is 1,
// the run fits.
TABLE_INLINE uint16_t rise_at(uint16_t rise, uint16_t part, uint16_t run)
{
    const uint32_t sum = product(rise, part) + (uint16_t)(run >> 1);
    uint16_t rest = (uint16_t)(sum >> 16);
    uint16_t low = (uint16_t)(sum & 0xFFFFu);
    uint8_t turn;

    for (turn = 16; turn != 0u; turn--) {
        bool fits = (rest & FIXPID_SIGN_BIT) != 0u;

        rest = (uint16_t)((rest & 0x7FFFu) << 1);
        if ((low & FIXPID_SIGN_BIT) != 0u) {
            rest |= 1u;
        }
        low = (uint16_t)((low & 0x7FFFu) << 1);
        if (rest >= run) {
            fits = true;
        }
        if (fits) {
            rest = (uint16_t)(rest - run);
            low |= 1u;
        }
    }
    return low;
}

#endif
