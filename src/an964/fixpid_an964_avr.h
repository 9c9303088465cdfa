// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h for an AVR with a multiplier, from 8 x 8
// bits. In the first two the gain moves left, so that the division ends between
// bytes: the quotient is the upper ones, and the lowest is never stored.
//
// gcc keeps r1 at 0 and does not mind r0. `andi` wants the upper registers.
#ifndef FIXPID_AN964_AVR_H
#define FIXPID_AN964_AVR_H
#include <stdint.h>

// floor(16 gain * magnitude / 256), 13 cycles.
// pre: gain < 2^10, magnitude < 2^7; post: at most 8120
FIXPID_INLINE uint16_t fixpid_10x7_div16(uint16_t gain, uint8_t magnitude)
{
    uint16_t quotient;

    __asm__("swap %A1\n\t"
            "swap %B1\n\t"
            "eor %B1, %A1\n\t"
            "andi %A1, 0xF0\n\t"
            "eor %B1, %A1\n\t"
            "mul %B1, %2\n\t"
            "movw %A0, r0\n\t"
            "mul %A1, %2\n\t"
            "add %A0, r1\n\t"
            "clr r1\n\t"
            "adc %B0, r1"
            : "=&r"(quotient), "+&d"(gain)
            : "r"(magnitude));
    return quotient;
}

// 8 gain * magnitude / 256, rounded down or up, 15 cycles without the limit.
// The lowest byte is a multiple of 8: 0xFF carries where 31 * 8 would. pre:
// gain < 2^10
FIXPID_INLINE uint16_t fixpid_10x8_div32(uint16_t gain, uint8_t magnitude,
                                         uint8_t round_up, uint8_t limit)
{
    uint16_t quotient;

    __asm__("lsl %A1\n\t"
            "rol %B1\n\t"
            "lsl %A1\n\t"
            "rol %B1\n\t"
            "lsl %A1\n\t"
            "rol %B1\n\t"
            "mul %B1, %2\n\t"
            "movw %A0, r0\n\t"
            "mul %A1, %2\n\t"
            "add r0, %3\n\t"
            "adc %A0, r1\n\t"
            "clr r1\n\t"
            "adc %B0, r1"
            : "=&r"(quotient), "+&r"(gain)
            : "r"(magnitude), "r"(round_up));
    return (quotient > limit) ? limit : quotient;
}

// floor(gain * magnitude / 256) in 16 bits, and by 4, 21 cycles.
// pre: gain < 2^10, magnitude < 2^14; post: below 2^14
FIXPID_INLINE uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude)
{
    uint16_t quotient;

    __asm__("mul %B1, %A2\n\t"
            "movw %A0, r0\n\t"
            "mul %A1, %B2\n\t"
            "add %A0, r0\n\t"
            "adc %B0, r1\n\t"
            "mul %B1, %B2\n\t"
            "add %B0, r0\n\t"
            "mul %A1, %A2\n\t"
            "add %A0, r1\n\t"
            "clr r1\n\t"
            "adc %B0, r1\n\t"
            "lsr %B0\n\t"
            "ror %A0\n\t"
            "lsr %B0\n\t"
            "ror %A0"
            : "=&r"(quotient)
            : "r"(magnitude), "r"(gain));
    return quotient;
}

#endif
