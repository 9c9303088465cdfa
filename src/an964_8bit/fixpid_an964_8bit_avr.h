// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h for an AVR with a multiplier, whose
// compiler multiplies words and, to save flash, shifts in loops.
//
// gcc keeps r1 at 0 and does not mind r0. `andi` wants the upper registers,
// `fmul` some of them.
#ifndef FIXPID_AN964_8BIT_AVR_H
#define FIXPID_AN964_8BIT_AVR_H
#include <stdint.h>

// gain * magnitude / 4, rounded down or up, at most `limit`. 11 cycles without
// the limit. pre: both < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div4(uint8_t gain, uint8_t magnitude,
                                       uint8_t round_up, uint8_t limit)
{
    uint16_t quotient;

    __asm__("andi %1, 3\n\t"
            "mul %2, %3\n\t"
            "add r0, %1\n\t"
            "movw %A0, r0\n\t"
            "clr r1\n\t"
            "adc %B0, r1\n\t"
            "lsr %B0\n\t"
            "ror %A0\n\t"
            "lsr %B0\n\t"
            "ror %A0"
            : "=&r"(quotient), "+&d"(round_up)
            : "r"(gain), "r"(magnitude));
    return (quotient > limit) ? limit : quotient;
}

// floor(gain * magnitude / 8), at most 127. 10 cycles without the limit. pre:
// both < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude)
{
    uint16_t quotient;

    __asm__("mul %1, %2\n\t"
            "movw %A0, r0\n\t"
            "clr r1\n\t"
            "lsr %B0\n\t"
            "ror %A0\n\t"
            "lsr %B0\n\t"
            "ror %A0\n\t"
            "lsr %B0\n\t"
            "ror %A0"
            : "=r"(quotient)
            : "r"(gain), "r"(magnitude));
    return (quotient > 127u) ? 127u : quotient;
}

// floor(gain * magnitude / 32), 8 cycles: 2 gain * 2 magnitude * 2 / 256, where
// the last factor is that of the product of two fractions. Its 17th bit is the
// carry. pre: both < 2^7; post: at most 504
FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude)
{
    uint16_t quotient;

    __asm__("lsl %1\n\t"
            "lsl %2\n\t"
            "fmul %1, %2\n\t"
            "mov %A0, r1\n\t"
            "clr r1\n\t"
            "clr %B0\n\t"
            "rol %B0"
            : "=r"(quotient), "+a"(gain), "+a"(magnitude));
    return quotient;
}

#endif
