// SPDX-License-Identifier: MIT
// The signed numbers of fixpid_an937, of 17 bits, and Equation 4 with their
// products. A number is in two's complement, or, where words are bytes, in
// sign-magnitude: union fixpid_an937_number has room for both, and all sources
// of one program use the same.
#ifndef FIXPID_AN937_ARITH_H
#define FIXPID_AN937_ARITH_H
#include <stdint.h>

#include "../common/fixpid_bits.h"
#include "fixpid_an937.h"

// A step stores this bit in step_flags, besides the public ones, if the sum was
// below 0 before the division.
#define FIXPID_AN937_SUM_NEGATIVE 0x80u

// An error of 0 in offset binary, error + 32768, which compares without a sign.
#define FIXPID_AN937_NO_ERROR ((uint16_t)FIXPID_SIGN_BIT)

// The form that the chip gets, which has the primitives from here to
// fixpid_sixteenth. An AVR and a RISC-V are faster in two's complement,
// whatever their multiplier; an AVR has products in assembly. Other words of a
// byte are faster in sign-magnitude, and a PIC18's header has an Equation 4 of
// its own.
#if (FIXPID_MULTIPLIER_BITS >= 16) || defined(__AVR__) || defined(__riscv)

FIXPID_INLINE void fixpid_number_set(
    FIXPID_DATA union fixpid_an937_number *number, int16_t value)
{
    number->value = value;
}

FIXPID_INLINE int32_t
fixpid_number_value(FIXPID_DATA const union fixpid_an937_number *number)
{
    return number->value;
}

// number = left - right: within +-65535
FIXPID_INLINE void fixpid_number_difference(
    FIXPID_DATA union fixpid_an937_number *number, uint16_t left,
    uint16_t right)
{
    number->value = (int32_t)left - (int32_t)right;
}

// number = clamp(number + addend, -limit, limit). Sets the flag if the sum lay
// beyond the limit. So may the number before, after a new limit: the sum is
// within +-131070.
FIXPID_INLINE void fixpid_number_add(
    FIXPID_DATA union fixpid_an937_number *number,
    FIXPID_DATA const union fixpid_an937_number *addend, uint16_t limit,
    uint8_t *flags)
{
    const int32_t most = (int32_t)limit;
    int32_t sum = fixpid_add32(number->value, addend->value);

    if (sum > most) {
        sum = most;
        *flags = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;
    }
    if (sum < -most) {
        sum = -most;
        *flags = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;
    }
    number->value = sum;
}

#if defined(__AVR__) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an937_avr.h"
#else

// gain * number. post: within 255 * 65535 < 2^24. A number of more than 17
// bits, which only flipped ones can make, would overflow as a signed one.
// Without a multiplier, a RISC-V is faster by shift and add than with its
// library.
#if defined(__riscv) && (FIXPID_MULTIPLIER_BITS < 16)
#include "../common/fixpid_shift_add.h"
FIXPID_INLINE int32_t fixpid_number_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_product_in_turns(gain, number->value, 8);
}
#else
FIXPID_INLINE int32_t fixpid_number_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *number)
{
    // Deviation 10.8: a pattern of two's complement
    return (int32_t)((uint32_t)number->value * gain);
}
#endif

// sum + gain * number. pre: the result is within +-2^26
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_add32(sum, fixpid_number_term(gain, number));
}

// floor(x / 16). pre: x < 2^24
FIXPID_INLINE uint32_t fixpid_sixteenth(uint32_t x)
{
    return x >> 4;
}

#endif

#elif defined(__SDCC_pic16)
#include "fixpid_an937_pic18.h"
#else
#include "fixpid_an937_narrow.h"
#endif

#if !defined(__SDCC_pic16)

#define FIXPID_AN937_SUM_MAX UINT32_C(0xFFFFFF) // 24 bits

// Equation 4: the sum of the three terms, limited to a 24-bit magnitude and
// divided by 16 toward zero. Sets SUM_SATURATED and SUM_NEGATIVE in `flags`.
FIXPID_INLINE int32_t
fixpid_an937_output(FIXPID_DATA const struct fixpid_an937 *self, uint8_t *flags)
{
    // |sum| <= 255 * (32768 + 65535 + 65535) < 2^26
    int32_t sum = fixpid_number_term(self->kp_q4, &self->error);
    uint32_t magnitude;

    sum = fixpid_sum_with_term(sum, self->ki_q4, &self->accumulated_error);
    sum = fixpid_sum_with_term(sum, self->kd_q4, &self->delta);
    magnitude = (uint32_t)sum;
    if (sum < 0) {
        *flags |= FIXPID_AN937_SUM_NEGATIVE;
        magnitude = ~magnitude + 1u;
    }
    if ((uint8_t)(magnitude >> 24) != 0u) {
        *flags |= FIXPID_AN937_SUM_SATURATED;
        magnitude = FIXPID_AN937_SUM_MAX;
    }
    sum = (int32_t)fixpid_sixteenth(magnitude);
    return ((*flags & FIXPID_AN937_SUM_NEGATIVE) != 0u) ? -sum : sum;
}

#endif

#endif
