// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table.
#ifndef FIXPID_TABLE_ARITH_H
#define FIXPID_TABLE_ARITH_H
#include <stdint.h>

#include "../common/fixpid_bits.h"
#include "../common/fixpid_difference.h"

// SDCC would keep a copy of each inline function in a PIC18's flash, beside the
// one in a lookup: 3296 bytes instead of 2334.
#if defined(__SDCC_pic16)
#define TABLE_INLINE static
#else
#define TABLE_INLINE FIXPID_INLINE
#endif

#if FIXPID_MULTIPLIER_BITS < 16
#include "fixpid_table_narrow.h"
#else

// floor(rise * part / run + 1/2). pre: part <= run, 1 <= run; post: 0..rise.
// The sum is at most 65535 * 65535 + 32767 < 2^32.
TABLE_INLINE uint16_t rise_at(uint16_t rise, uint16_t part, uint16_t run)
{
    return (uint16_t)((((uint32_t)rise * part) + (uint16_t)(run >> 1)) / run);
}

#endif

// The height at `part` of the `run` from y0 to y1, rounded half up. A line that
// falls is one that rises from its other end.
// pre: part < run; post: between y0 and y1
TABLE_INLINE int16_t height_at(int16_t y0, int16_t y1, uint16_t part,
                               uint16_t run)
{
    int16_t low = y0;
    int16_t high = y1;
    uint16_t at = part;

    if (y1 < y0) {
        low = y1;
        high = y0;
        at = (uint16_t)(run - part);
    }
    return (int16_t)(uint16_t)((uint16_t)low +
                               rise_at(fixpid_difference(high, low), at, run));
}

#endif
