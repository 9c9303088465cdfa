// SPDX-License-Identifier: MIT
// Signed values of 16 and 32 bits: saturated sums, a product, and a shift by a
// variable.
#ifndef FIXPID_SIGNED_H
#define FIXPID_SIGNED_H
#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_bits.h"

// Defined if the compiler has __builtin_add_overflow, which is the CPU's flag:
// GCC from version 5 on, clang.
#if defined(__clang__) || (defined(__GNUC__) && (__GNUC__ >= 5))
#define FIXPID_HAS_ADD_OVERFLOW
#endif

// (Older compilers for ARM say that they have the instructions and do not.)
#if defined(__AVR_HAVE_MOVW__) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_signed_avr.h"
// Deviation 20.9: INT_MAX is a macro of <limits.h>.
#elif (INT_MAX <= 32767) || !defined(FIXPID_HAS_ADD_OVERFLOW) ||               \
    ((FIXPID_MULTIPLIER_BITS < 16) && !defined(__riscv))
#include "fixpid_signed_narrow.h"
#elif (defined(__ARM_FEATURE_SAT) ||                                           \
       (defined(__thumb__) && !defined(__thumb2__))) &&                        \
    !defined(FIXPID_NO_ASSEMBLY) &&                                            \
    (!defined(__GNUC__) || defined(__clang__) || (__GNUC__ >= 10))
#include "fixpid_signed_arm.h"
#elif defined(__riscv)
#include "fixpid_signed_riscv.h"
#else

// a + b, saturated
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum;

    if (__builtin_add_overflow(a, b, &sum)) {
        return (a < 0) ? INT32_MIN : INT32_MAX;
    }
    return sum;
}

// gain * x. pre: gain <= 32767; post: within 32767 * 32768 = 2^30 - 2^15
FIXPID_INLINE int32_t mul16(uint16_t gain, int32_t x)
{
    return (int32_t)gain * x;
}

#endif

#if !defined(FIXPID_SIGNED_AVR_H) && !defined(__SDCC) // they have their own

typedef int32_t counts_word;

// `counts` of 1 in Q16.16.
FIXPID_INLINE int32_t whole_counts(int16_t counts)
{
    // Deviation 10.8: a pattern of two's complement
    return (int32_t)((uint32_t)(uint16_t)counts << 16);
}

// The output before its limits, of P + D + feed-forward and the integral in
// Q16.16, rounded. The sum is within 2^31 - 2^15 + 128, unless bits were
// flipped.
FIXPID_INLINE counts_word rounded_counts(int32_t sum, int32_t integral)
{
    return shift_right_floor(
        fixpid_add32(sum, shift_right_floor(integral, 8) + 128), 8);
}

#endif

#ifndef FIXPID_SIGNED_INT16_H // an int of 16 bits has its own

// A signal of 16 bits in a register.
typedef int32_t signal_word;

#if !defined(FIXPID_HAS_SSAT)
// a - b, saturated
FIXPID_INLINE int32_t sub16_sat(int32_t a, int32_t b)
{
    const int32_t difference = a - b;
    int32_t fitting = (int16_t)difference;

    if (difference != fitting) {
        fitting = INT16_MAX ^ shift_right_floor(difference, 30);
    }
    FIXPID_OPAQUE(fitting);
    return fitting;
}
#endif

// a + b, which fits unless bits were flipped: fixpid_add32 for a sum that gcc
// for an AVR is not to merge with the sum before it, which takes it more
// cycles.
FIXPID_INLINE int32_t add32_apart(int32_t a, int32_t b)
{
    return fixpid_add32(a, b);
}

// floor(x / 2^n), with n the lowest three bits of `places`; the others may be
// anything, such as the options of which the lowest three are a filter.
FIXPID_INLINE int32_t shift_right_by(int32_t x, uint8_t places)
{
    return shift_right_floor(x, places & 7u);
}

// True if an integral of 40 bits, which are those of `integral` and then
// `fraction`, equals `limit` counts exactly. `counts` is its integer part.
FIXPID_INLINE bool is_just(int16_t limit, int16_t counts, int32_t integral,
                           uint8_t fraction)
{
    (void)counts;
    if (integral != whole_counts(limit)) {
        return false;
    }
    return fraction == 0u;
}

// True if that integral is `limit` counts or more.
FIXPID_INLINE bool reaches(int16_t limit, int16_t counts, int32_t integral)
{
    (void)counts;
    return integral >= whole_counts(limit);
}

#endif

#endif
