// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for an AVR: the overflow flag and the 8 x 8
// products, which C cannot name.
//
// Only the product needs upper registers, r16 to r23, of which a step has few.
#ifndef FIXPID_SIGNED_AVR_H
#define FIXPID_SIGNED_AVR_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_bits.h"
#include "fixpid_signed_int16.h"

// It takes 4 cycles without an overflow. With one, N and C are the wrong sign:
// each bit of the result is C but for the highest, which is not N.
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    int16_t difference = a;

    __asm__("sub %A0, %A1\n\t"
            "sbc %B0, %B1\n\t"
            "brvc 1f\n\t"
            "sbc %A0, %A0\n\t"
            "com %B0\n\t"
            "bst %B0, 7\n\t"
            "mov %B0, %A0\n\t"
            "bld %B0, 7\n"
            "1:"
            : "+r"(difference)
            : "r"(b));
    return difference;
}

// With an overflow, C is the right sign: each bit of the result is not C, but
// for the highest, which is C.
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum = a;

    __asm__("add %A0, %A1\n\t"
            "adc %B0, %B1\n\t"
            "adc %C0, %C1\n\t"
            "adc %D0, %D1\n\t"
            "brvc 1f\n\t"
            "sbc %A0, %A0\n\t"
            "bst %A0, 7\n\t"
            "com %A0\n\t"
            "mov %B0, %A0\n\t"
            "movw %C0, %A0\n\t"
            "bld %D0, 7\n"
            "1:"
            : "+r"(sum)
            : "r"(b));
    return sum;
}

FIXPID_INLINE int32_t add32_apart(int32_t a, int32_t b)
{
    return add32_sat(a, b);
}

// `counts` of 1 in Q16.16.
FIXPID_INLINE int32_t whole_counts(int16_t counts)
{
    int32_t whole;

    __asm__("movw %C0, %A1\n\t"
            "clr %A0\n\t"
            "clr %B0"
            : "=&r"(whole)
            : "r"(counts));
    return whole;
}

// The output before its limits: 24 bits hold each that the sum can have.
__extension__ typedef __int24 counts_word;

// floor((sum + floor(integral / 2^8) + 128) / 2^8). The carry of the lowest
// byte rounds.
FIXPID_INLINE counts_word rounded_counts(int32_t sum, int32_t integral)
{
    int32_t counts = sum;

    __asm__("mov __tmp_reg__, %A0\n\t"
            "add __tmp_reg__, %B1\n\t"
            "mov %A0, %B0\n\t"
            "adc %A0, %C1\n\t"
            "mov %B0, %C0\n\t"
            "adc %B0, %D1\n\t"
            "mov %C0, %D0\n\t"
            "adc %C0, __zero_reg__\n\t"
            "sbrc %D1, 7\n\t"
            "dec %C0\n\t"
            "lsl __tmp_reg__\n\t"
            "adc %A0, __zero_reg__\n\t"
            "adc %B0, __zero_reg__\n\t"
            "adc %C0, __zero_reg__"
            : "+r"(counts)
            : "r"(integral));
    return (counts_word)counts;
}

#if defined(__AVR_HAVE_MUL__)
// Four products, those with the upper byte of x signed, 19 cycles. gcc keeps r1
// at 0 and does not mind r0.
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    int32_t product;
    uint8_t zero;

    __asm__("clr %1\n\t"
            "mul %A2, %A3\n\t"
            "movw %A0, r0\n\t"
            "mulsu %B3, %B2\n\t"
            "movw %C0, r0\n\t"
            "mulsu %B3, %A2\n\t"
            "sbc %D0, %1\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "mul %B2, %A3\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "clr r1"
            : "=&r"(product), "=&r"(zero)
            : "a"(gain), "a"(x));
    return product;
}
#else
// By shift and add, two bits in each turn: a byte of the gain leaves its
// register to the right while a byte of the product comes in from the left. x
// counts as unsigned there; of a negative one the product is 2^16 gains too
// much.
// Deviation 40 lines: each is one instruction
static int32_t mul16(uint16_t gain, int16_t x)
    __attribute__((noinline, unused));
static int32_t mul16(uint16_t gain, int16_t x)
{
    int32_t product;
    uint8_t turn;

    __asm__("movw %A0, %A2\n\t"
            "clr %C0\n\t"
            "clr %D0\n\t"
            "ldi %1, 4\n\t"
            "lsr %A0\n"
            "1:\n\t"
            "brcc 2f\n\t"
            "add %C0, %A3\n\t"
            "adc %D0, %B3\n"
            "2:\n\t"
            "ror %D0\n\t"
            "ror %C0\n\t"
            "ror %A0\n\t"
            "brcc 3f\n\t"
            "add %C0, %A3\n\t"
            "adc %D0, %B3\n"
            "3:\n\t"
            "ror %D0\n\t"
            "ror %C0\n\t"
            "ror %A0\n\t"
            "dec %1\n\t"
            "brne 1b\n\t"
            "ldi %1, 4\n\t"
            "lsr %B0\n"
            "4:\n\t"
            "brcc 5f\n\t"
            "add %C0, %A3\n\t"
            "adc %D0, %B3\n"
            "5:\n\t"
            "ror %D0\n\t"
            "ror %C0\n\t"
            "ror %B0\n\t"
            "brcc 6f\n\t"
            "add %C0, %A3\n\t"
            "adc %D0, %B3\n"
            "6:\n\t"
            "ror %D0\n\t"
            "ror %C0\n\t"
            "ror %B0\n\t"
            "dec %1\n\t"
            "brne 4b\n\t"
            "sbrs %B3, 7\n\t"
            "rjmp 7f\n\t"
            "sub %C0, %A2\n\t"
            "sbc %D0, %B2\n"
            "7:"
            : "=&r"(product), "=&d"(turn)
            : "r"(gain), "r"(x));
    return product;
}
#endif

#if defined(__AVR_HAVE_MUL__)
// a + gain * x, saturated; or, `fine`, of a word and a byte, which is its next
// eight bits: their sum with gain * x in 40 bits.
#define FIXPID_HAS_ADD_PRODUCT
FIXPID_INLINE int32_t add_product(int32_t a, uint8_t *fraction, uint16_t gain,
                                  int16_t x, bool fine)
{
    int32_t change = mul16(gain, x);

    if (fine) {
        change += (int32_t)*fraction;
        *fraction = (uint8_t)change;
        change = shift_right_floor(change, 8);
    }
    return add32_sat(a, change);
}
#endif

#endif
