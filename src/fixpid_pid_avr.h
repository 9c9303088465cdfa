// SPDX-License-Identifier: MIT
// The leaves of fixpid_pid in AVR assembly, for FIXPID_PRODUCT=4: the overflow
// flag and the 8 x 8 product, which C cannot name. In C they are
// FIXPID_DIFFERENCE_NARROW, FIXPID_SUM_FLAG and FIXPID_SIGNED_MULTIPLY, with
// the same operands and results.
//
// Only the product needs upper registers, r16 to r23, of which a step has few.
#ifndef FIXPID_PID_AVR_H
#define FIXPID_PID_AVR_H
#include <stdint.h>

// Without overflow 4 cycles. With one, N and C are the wrong sign: the result
// is all bits C but for the highest, which is not N.
#define FIXPID_DIFFERENCE_AVR(result, a, b)                                    \
    do {                                                                       \
        int16_t difference_ = (a);                                             \
        __asm__("sub %A0, %A1\n\t"                                             \
                "sbc %B0, %B1\n\t"                                             \
                "brvc 1f\n\t"                                                  \
                "sbc %A0, %A0\n\t"                                             \
                "com %B0\n\t"                                                  \
                "bst %B0, 7\n\t"                                               \
                "mov %B0, %A0\n\t"                                             \
                "bld %B0, 7\n"                                                 \
                "1:"                                                           \
                : "+r"(difference_)                                            \
                : "r"((int16_t)(b)));                                          \
        (result) = difference_;                                                \
    } while (0)

// With an overflow, C is the right sign: the result is all bits not C but for
// the highest.
#define FIXPID_SUM_AVR(result, a, b)                                           \
    do {                                                                       \
        int32_t sum_ = (a);                                                    \
        __asm__("add %A0, %A1\n\t"                                             \
                "adc %B0, %B1\n\t"                                             \
                "adc %C0, %C1\n\t"                                             \
                "adc %D0, %D1\n\t"                                             \
                "brvc 1f\n\t"                                                  \
                "sbc %A0, %A0\n\t"                                             \
                "bst %A0, 7\n\t"                                               \
                "com %A0\n\t"                                                  \
                "mov %B0, %A0\n\t"                                             \
                "movw %C0, %A0\n\t"                                            \
                "bld %D0, 7\n"                                                 \
                "1:"                                                           \
                : "+r"(sum_)                                                   \
                : "r"((int32_t)(b)));                                          \
        (result) = sum_;                                                       \
    } while (0)

// Four products, those with the upper byte of x signed, 19 cycles. gcc keeps r1
// at 0 and does not mind r0.
#define FIXPID_SIGNED_AVR(result, gain, x)                                     \
    do {                                                                       \
        int32_t product_;                                                      \
        uint8_t zero_;                                                         \
        __asm__("clr %1\n\t"                                                   \
                "mul %A2, %A3\n\t"                                             \
                "movw %A0, r0\n\t"                                             \
                "mulsu %B3, %B2\n\t"                                           \
                "movw %C0, r0\n\t"                                             \
                "mulsu %B3, %A2\n\t"                                           \
                "sbc %D0, %1\n\t"                                              \
                "add %B0, r0\n\t"                                              \
                "adc %C0, r1\n\t"                                              \
                "adc %D0, %1\n\t"                                              \
                "mul %B2, %A3\n\t"                                             \
                "add %B0, r0\n\t"                                              \
                "adc %C0, r1\n\t"                                              \
                "adc %D0, %1\n\t"                                              \
                "clr r1"                                                       \
                : "=&r"(product_), "=&r"(zero_)                                \
                : "a"((uint16_t)(gain)), "a"((int16_t)(x)));                   \
        (result) = product_;                                                   \
    } while (0)

#endif
