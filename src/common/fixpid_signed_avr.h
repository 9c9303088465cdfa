// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for an AVR: the overflow flag and the 8 x 8
// products, which C cannot name.
//
// Only the product needs upper registers, r16 to r23, of which a step has few.
#ifndef FIXPID_SIGNED_AVR_H
#define FIXPID_SIGNED_AVR_H
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
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return (int32_t)gain * x;
}
#endif

#endif
