// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for an ARM: with the saturating instructions
// SSAT and, where the core has the DSP extension, QADD, both of which set the
// sticky flag Q when they saturate; and for Thumb of the first generation, with
// the overflow flag.
#ifndef FIXPID_SIGNED_ARM_H
#define FIXPID_SIGNED_ARM_H
#include <stdint.h>

#include "fixpid_bits.h"

#if !defined(__ARM_FEATURE_SAT) // a Cortex-M0, M0+ or M23
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum;

    __asm__(".syntax unified\n\t"
            "adds %0, %2, %1\n\t"
            "bvc 1f\n\t"
            "sbcs %0, %0\n\t"
            "movs %1, #128\n\t"
            "lsls %1, %1, #24\n\t"
            "eors %0, %1\n"
            "1:"
            : "=&l"(sum), "+l"(b)
            : "l"(a)
            : "cc");
    return sum;
}
#else
#include <arm_acle.h>

#define FIXPID_HAS_SSAT
// GCC's __ssat is a macro, in which an unsigned int becomes an int32_t.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
FIXPID_INLINE int32_t sub16_sat(int32_t a, int32_t b)
{
    return __ssat(a - b, 16);
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
#endif

FIXPID_INLINE int32_t mul16(uint16_t gain, int32_t x)
{
    return (int32_t)gain * x;
}

#endif
