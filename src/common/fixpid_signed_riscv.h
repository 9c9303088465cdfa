// SPDX-License-Identifier: MIT The functions of fixpid_signed.h for a RISC-V: a
// jump is cheaper there than the arithmetic with the sign in the plain C, and
// without a multiplier a product in turns is cheaper than the library's.
#ifndef FIXPID_SIGNED_RISCV_H
#define FIXPID_SIGNED_RISCV_H
#include <stdint.h>

#include "fixpid_bits.h"
#include "fixpid_shift_add.h"

FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum = fixpid_add32(a, b);

    if (b < 0) {
        if (FIXPID_SELDOM(sum > a)) {
            sum = INT32_MIN;
        }
    } else if (FIXPID_SELDOM(sum < a)) {
        sum = INT32_MAX;
    } else {
        // it fits
    }
    FIXPID_OPAQUE(sum);
    return sum;
}

#if defined(__riscv_mul)
FIXPID_INLINE int32_t mul16(uint16_t gain, int32_t x)
{
    return (int32_t)gain * x;
}
#else
FIXPID_INLINE int32_t mul16(uint16_t gain, int32_t x)
{
    return fixpid_product_in_turns(gain, x, 15);
}
#endif

#endif
