// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h in assembly for a PIC16 under SDCC.
//
// Arguments and temporaries lie in the 16 bytes that all banks share, so there
// is no bank to select; the first byte is in W.
#ifndef FIXPID_AN964_8BIT_PIC14_H
#define FIXPID_AN964_8BIT_PIC14_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

uint8_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude);
uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude);

// gain * magnitude / 4, rounded down or up; at most 127. pre: both < 2^7
uint8_t fixpid_7x7_div4_byte(uint8_t round_up, uint8_t gain, uint8_t magnitude);

FIXPID_INLINE uint8_t fixpid_7x7_div4(uint8_t gain, uint8_t magnitude,
                                      uint8_t round_up, uint8_t limit)
{
    uint8_t quotient = fixpid_7x7_div4_byte(round_up, gain, magnitude);

    if (quotient >= limit) {
        quotient = limit;
    }
    return quotient;
}

#endif
