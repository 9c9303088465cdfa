// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h in assembly for a PIC16 under SDCC.
//
// Arguments and temporaries lie in the 16 bytes that all banks share, so there
// is no bank to select; the first byte is in W.
#ifndef FIXPID_AN964_PIC14_H
#define FIXPID_AN964_PIC14_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

uint16_t fixpid_10x7_div16(uint8_t k, uint16_t x);
uint16_t fixpid_14x10_div1024(uint16_t x, uint16_t k);

// x * k / 32, rounded down or up; at most 255. pre: x < 2^10
uint8_t fixpid_10x8_div32_byte(uint8_t k, uint16_t x, uint8_t round_up);

FIXPID_INLINE uint8_t fixpid_10x8_div32(uint8_t k, uint16_t x, uint8_t round_up,
                                        uint8_t limit)
{
    uint8_t quotient = fixpid_10x8_div32_byte(k, x, round_up);

    if (quotient >= limit) {
        quotient = limit;
    }
    return quotient;
}

#endif
