// SPDX-License-Identifier: MIT
// The products of fixpid_an937_arith.h for an AVR: 8 x 8 products or, without a
// multiplier, shift and add; and nibbles that change places.
//
// gcc keeps r1 at 0 and does not mind r0. `andi` wants the upper registers.
#ifndef FIXPID_AN937_AVR_H
#define FIXPID_AN937_AVR_H
#include <stdint.h>

#include "fixpid_an937.h"

// In both forms the number counts as its lower 16 bits. `sign` is its third
// byte, 0 or, of a negative one, 0xFF: the lower 16 bits are then 2^16 too
// much.
#if defined(__AVR_HAVE_MUL__)
// The product is added, from its second byte on in `upper`. 15 cycles.
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    uint8_t sign = number->parts.negative;
    uint16_t upper;

    __asm__("mul %3, %B4\n\t"
            "movw %A2, r0\n\t"
            "mul %3, %A4\n\t"
            "add %A0, r0\n\t"
            "adc %A2, r1\n\t"
            "clr r1\n\t"
            "adc %B2, r1\n\t"
            "add %B0, %A2\n\t"
            "adc %C0, %B2\n\t"
            "adc %D0, r1\n\t"
            "and %1, %3\n\t"
            "sub %C0, %1\n\t"
            "sbc %D0, r1"
            : "+&r"(sum), "+&r"(sign), "=&r"(upper)
            : "r"(gain), "r"(number->parts.magnitude));
    return sum;
}

#else
// Two bits in each turn: the gain leaves the product's lowest byte to the right
// while the product comes in from the left.
// Deviation 40 lines: each is one instruction
static int32_t fixpid_sum_with_term(
    int32_t sum, uint8_t gain,
    FIXPID_DATA const union fixpid_an937_number *number)
    __attribute__((noinline, unused));
static int32_t fixpid_sum_with_term(
    int32_t sum, uint8_t gain,
    FIXPID_DATA const union fixpid_an937_number *number)
{
    uint8_t sign = number->parts.negative;
    uint32_t product;
    uint8_t turn;

    __asm__("mov %A1, %4\n\t"
            "clr %B1\n\t"
            "clr %C1\n\t"
            "ldi %2, 4\n\t"
            "lsr %A1\n"
            "1:\n\t"
            "brcc 2f\n\t"
            "add %B1, %A5\n\t"
            "adc %C1, %B5\n"
            "2:\n\t"
            "ror %C1\n\t"
            "ror %B1\n\t"
            "ror %A1\n\t"
            "brcc 3f\n\t"
            "add %B1, %A5\n\t"
            "adc %C1, %B5\n"
            "3:\n\t"
            "ror %C1\n\t"
            "ror %B1\n\t"
            "ror %A1\n\t"
            "dec %2\n\t"
            "brne 1b\n\t"
            "add %A0, %A1\n\t"
            "adc %B0, %B1\n\t"
            "adc %C0, %C1\n\t"
            "adc %D0, __zero_reg__\n\t"
            "and %3, %4\n\t"
            "sub %C0, %3\n\t"
            "sbc %D0, __zero_reg__"
            : "+&r"(sum), "=&r"(product), "=&d"(turn), "+&r"(sign)
            : "r"(gain), "r"(number->parts.magnitude));
    return sum;
}
#endif

FIXPID_INLINE int32_t fixpid_number_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_sum_with_term(0, gain, number);
}

// 10 cycles: each nibble moves one place, that of the byte above comes in.
FIXPID_INLINE uint32_t fixpid_sixteenth(uint32_t x)
{
    __asm__("swap %A0\n\t"
            "swap %B0\n\t"
            "swap %C0\n\t"
            "eor %A0, %B0\n\t"
            "andi %A0, 0x0F\n\t"
            "eor %A0, %B0\n\t"
            "eor %B0, %C0\n\t"
            "andi %B0, 0x0F\n\t"
            "eor %B0, %C0\n\t"
            "andi %C0, 0x0F"
            : "+d"(x));
    return x;
}

#endif
