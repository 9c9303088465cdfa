// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h in assembly for a PIC16 under SDCC.
//
// Arguments and temporaries lie in the 16 bytes that all banks share, so there
// is no bank to select; the first byte is in W.
#ifndef FIXPID_AN964_PIC14_H
#define FIXPID_AN964_PIC14_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude);

// The magnitude comes first where the sum wants it in W. Macros turn the
// operands around: with inline functions, of which SDCC copies the operands, a
// step of a PIC16F684 takes 6 cycles and 6 words more.
uint16_t fixpid_7x10_div16(uint8_t magnitude, uint16_t gain);
#define fixpid_10x7_div16(gain, magnitude)                                     \
    fixpid_7x10_div16((magnitude), (gain))

// gain * magnitude / 32, rounded down or up; at most 255. pre: gain < 2^10
uint8_t fixpid_8x10_div32_byte(uint8_t magnitude, uint16_t gain,
                               uint8_t round_up);

FIXPID_INLINE uint8_t fixpid_8x10_div32(uint8_t magnitude, uint16_t gain,
                                        uint8_t round_up, uint8_t limit)
{
    uint8_t quotient = fixpid_8x10_div32_byte(magnitude, gain, round_up);

    if (quotient >= limit) {
        quotient = limit;
    }
    return quotient;
}
#define fixpid_10x8_div32(gain, magnitude, round_up, limit)                    \
    fixpid_8x10_div32((magnitude), (gain), (round_up), (limit))

#endif
