// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for an ARM with saturating instructions:
// SSAT, and QADD where the core has the DSP extension. Both set the sticky flag
// Q when they saturate.
#ifndef FIXPID_SIGNED_ARM_H
#define FIXPID_SIGNED_ARM_H
#include <arm_acle.h>
#include <stdint.h>

#include "fixpid_bits.h"

// GCC's __ssat is a macro, in which an unsigned int becomes an int32_t.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    return (int16_t)__ssat((int32_t)a - b, 16);
}
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#if defined(__ARM_FEATURE_DSP)
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    return __qadd(a, b);
}
#else
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum;

    if (__builtin_add_overflow(a, b, &sum)) {
        return (a < 0) ? INT32_MIN : INT32_MAX;
    }
    return sum;
}
#endif

FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return (int32_t)gain * x;
}

#endif
