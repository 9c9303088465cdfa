// SPDX-License-Identifier: MIT
// The leaves of fixpid_pid in assembly for a PIC18 under SDCC, for
// FIXPID_PRODUCT=4. In C they are FIXPID_DIFFERENCE_NARROW,
// FIXPID_SUM_PORTABLE and FIXPID_SIGNED_BYTES, with the same operands and
// results.
//
// SDCC passes arguments on a software stack and saves each register that it
// uses, so the operands have a place of their own. A function of one controller
// must not interrupt that of another.
#ifndef FIXPID_PID_PIC18_H
#define FIXPID_PID_PIC18_H
#include <stdint.h>

#include "fixpid_pid.h"

#if defined(__SDCC_pic16)

struct fixpid_operands {
    int16_t left; // and result
    int16_t right;
    int32_t wide; // left, and result
    int32_t wide_right;
};
extern __data struct fixpid_operands FIXPID_PID_OPERANDS_PLACE fixpid_operands;

void fixpid_kernel_difference(void);     // left -= right
void fixpid_kernel_signed_sum(void);     // wide += wide_right
void fixpid_kernel_signed_product(void); // wide = left * right

#define FIXPID_DIFFERENCE_PIC18(result, a, b)                                  \
    do {                                                                       \
        fixpid_operands.left = (a);                                            \
        fixpid_operands.right = (b);                                           \
        fixpid_kernel_difference();                                            \
        (result) = fixpid_operands.left;                                       \
    } while (0)
#define FIXPID_SUM_PIC18(result, a, b)                                         \
    do {                                                                       \
        fixpid_operands.wide = (a);                                            \
        fixpid_operands.wide_right = (b);                                      \
        fixpid_kernel_signed_sum();                                            \
        (result) = fixpid_operands.wide;                                       \
    } while (0)
#define FIXPID_SIGNED_PIC18(result, gain, x)                                   \
    do {                                                                       \
        fixpid_operands.left = (int16_t)(gain);                                \
        fixpid_operands.right = (x);                                           \
        fixpid_kernel_signed_product();                                        \
        (result) = fixpid_operands.wide;                                       \
    } while (0)

#endif

#endif
