// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for a RISC-V: a jump is cheaper there than
// the arithmetic that the C makes of the sign, and without a multiplier a
// product in turns is cheaper than the library's.
#ifndef FIXPID_SIGNED_RISCV_H
#define FIXPID_SIGNED_RISCV_H
#include <stdbool.h>
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

FIXPID_INLINE int32_t add32_apart(int32_t a, int32_t b)
{
    return fixpid_add32(a, b);
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

FIXPID_INLINE int32_t shift_right_by(int32_t x, uint8_t places)
{
    return shift_right_floor(x, places & 7u);
}

FIXPID_INLINE bool is_just(int16_t limit, int16_t counts, int32_t integral,
                           uint8_t fraction)
{
    (void)counts;
    return ((integral ^ shift_left(limit, 16)) | fraction) == 0;
}

#endif
