// SPDX-License-Identifier: MIT
// sub16_sat and add32_sat of fixpid_pid_arith.h for an ARM with saturating
// instructions: SSAT, and QADD where the core has the DSP extension. Both set
// the sticky flag Q when they saturate.
#ifndef FIXPID_PID_ARM_H
#define FIXPID_PID_ARM_H
#include <arm_acle.h>
#include <stdint.h>

// GCC's __ssat is a macro, in which an unsigned int becomes an int32_t.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
#define FIXPID_HAS_SUB16_SAT
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    return (int16_t)__ssat((int32_t)a - b, 16);
}
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#if defined(__ARM_FEATURE_DSP)
#define FIXPID_HAS_ADD32_SAT
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    return __qadd(a, b);
}
#endif

#endif
