// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for a RISC-V: a jump is cheaper there than
// the arithmetic that the C makes of the sign, and without a multiplier a
// product in turns is cheaper than the library's.
#ifndef FIXPID_SIGNED_RISCV_H
#define FIXPID_SIGNED_RISCV_H
#include <stdint.h>

#include "fixpid_bits.h"
#include "fixpid_shift_add.h"

FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    const int32_t difference = (int32_t)a - b;

    if (difference != (int16_t)difference) {
        return (difference < 0) ? INT16_MIN : INT16_MAX;
    }
    return (int16_t)difference;
}

FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum;

    if (__builtin_add_overflow(a, b, &sum)) {
        return (a < 0) ? INT32_MIN : INT32_MAX;
    }
    return sum;
}

#if defined(__riscv_mul)
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return (int32_t)gain * x;
}
#else
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return fixpid_product_in_turns(gain, x, 15);
}
#endif

#endif
