// SPDX-License-Identifier: MIT
// The leaves of fixpid_pid in AVR assembly, for FIXPID_PRODUCT=4: the overflow
// flag and the 8 x 8 product, which C cannot name. In C they are
// FIXPID_DIFFERENCE_NARROW, FIXPID_SUM_FLAG and FIXPID_SIGNED_MULTIPLY, with
// the same operands and results.
//
// No operand needs the upper registers, r16 to r31, of which a step has few.
#ifndef FIXPID_PID_AVR_H
#define FIXPID_PID_AVR_H
#include <stdint.h>

// Without overflow 3 cycles. With one, N is the wrong sign: the result is all
// bits N but for the highest, which is not N.
#define FIXPID_DIFFERENCE_AVR(result, a, b)                                    \
    do {                                                                       \
        int16_t difference_ = (a);                                             \
        __asm__("sub %A0, %A1\n\t"                                             \
                "sbc %B0, %B1\n\t"                                             \
                "brvc 1f\n\t"                                                  \
                "com %B0\n\t"                                                  \
                "bst %B0, 7\n\t"                                               \
                "lsl %B0\n\t"                                                  \
                "sbc %A0, %A0\n\t"                                             \
                "com %A0\n\t"                                                  \
                "mov %B0, %A0\n\t"                                             \
                "bld %B0, 7\n"                                                 \
                "1:"                                                           \
                : "+r"(difference_)                                            \
                : "r"((int16_t)(b)));                                          \
        (result) = difference_;                                                \
    } while (0)

#define FIXPID_SUM_AVR(result, a, b)                                           \
    do {                                                                       \
        int32_t sum_ = (a);                                                    \
        __asm__("add %A0, %A1\n\t"                                             \
                "adc %B0, %B1\n\t"                                             \
                "adc %C0, %C1\n\t"                                             \
                "adc %D0, %D1\n\t"                                             \
                "brvc 1f\n\t"                                                  \
                "com %D0\n\t"                                                  \
                "bst %D0, 7\n\t"                                               \
                "lsl %D0\n\t"                                                  \
                "sbc %A0, %A0\n\t"                                             \
                "com %A0\n\t"                                                  \
                "mov %B0, %A0\n\t"                                             \
                "movw %C0, %A0\n\t"                                            \
                "bld %D0, 7\n"                                                 \
                "1:"                                                           \
                : "+r"(sum_)                                                   \
                : "r"((int32_t)(b)));                                          \
        (result) = sum_;                                                       \
    } while (0)

// The four products of FIXPID_SIGNED_BYTES, 22 cycles. gcc keeps r1 at 0 and
// does not mind r0.
#define FIXPID_SIGNED_AVR(result, gain, x)                                     \
    do {                                                                       \
        int32_t product_;                                                      \
        __asm__("mul %A1, %A2\n\t"                                             \
                "movw %A0, r0\n\t"                                             \
                "mul %B1, %B2\n\t"                                             \
                "movw %C0, r0\n\t"                                             \
                "mul %B1, %A2\n\t"                                             \
                "add %B0, r0\n\t"                                              \
                "adc %C0, r1\n\t"                                              \
                "clr r0\n\t"                                                   \
                "adc %D0, r0\n\t"                                              \
                "mul %A1, %B2\n\t"                                             \
                "add %B0, r0\n\t"                                              \
                "adc %C0, r1\n\t"                                              \
                "clr r1\n\t"                                                   \
                "adc %D0, r1\n\t"                                              \
                "sbrc %B2, 7\n\t"                                              \
                "sub %C0, %A1\n\t"                                             \
                "sbrc %B2, 7\n\t"                                              \
                "sbc %D0, %B1"                                                 \
                : "=&r"(product_)                                              \
                : "r"((uint16_t)(gain)), "r"((int16_t)(x)));                   \
        (result) = product_;                                                   \
    } while (0)

#endif
