// SPDX-License-Identifier: MIT
// The numbers of fixpid_an937_arith.h in sign-magnitude, and their products
// from 8 x 8 bits, for chips whose words are bytes. A sign is 0 or 1, and 1 may
// stand by a magnitude of 0. Only the lowest bit of its byte is read, so that a
// flipped bit in the rest of the byte cannot turn every addition into a
// subtraction.
#ifndef FIXPID_AN937_NARROW_H
#define FIXPID_AN937_NARROW_H
#include <stdint.h>

#include "../common/fixpid_bits.h"
#include "fixpid_an937.h"

FIXPID_INLINE void fixpid_number_set(
    FIXPID_DATA union fixpid_an937_number *number, int16_t value)
{
    uint16_t magnitude = (uint16_t)value;

    number->parts.negative = 0;
    if ((magnitude & FIXPID_SIGN_BIT) != 0u) {
        number->parts.negative = 1;
        magnitude = fixpid_negated(magnitude);
    }
    number->parts.magnitude = magnitude;
}

FIXPID_INLINE int32_t
fixpid_number_value(FIXPID_DATA const union fixpid_an937_number *number)
{
    const int32_t magnitude = (int32_t)number->parts.magnitude;

    return ((number->parts.negative & 1u) != 0u) ? -magnitude : magnitude;
}

FIXPID_INLINE void fixpid_number_difference(
    FIXPID_DATA union fixpid_an937_number *number, uint16_t left,
    uint16_t right)
{
    number->parts.negative = 0;
    number->parts.magnitude = (uint16_t)(left - right);
    if (left < right) {
        number->parts.negative = 1;
        number->parts.magnitude = (uint16_t)(right - left);
    }
}

// With unlike signs the smaller magnitude is subtracted from the larger, whose
// sign stays.
FIXPID_INLINE void fixpid_number_add(
    FIXPID_DATA union fixpid_an937_number *number,
    FIXPID_DATA const union fixpid_an937_number *addend, uint16_t limit,
    uint8_t *flags)
{
    const uint16_t summand = addend->parts.magnitude;
    uint16_t sum = number->parts.magnitude;

    if (((number->parts.negative ^ addend->parts.negative) & 1u) == 0u) {
        sum = (uint16_t)(sum + summand);
        if (sum < summand) { // a carry
            sum = UINT16_MAX;
            *flags = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;
        }
    } else if (sum >= summand) {
        sum = (uint16_t)(sum - summand);
    } else {
        sum = (uint16_t)(summand - sum);
        number->parts.negative ^= 1u;
    }
    if (sum > limit) {
        sum = limit;
        *flags = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;
    }
    number->parts.magnitude = sum;
}

// gain * the number's magnitude, of two 8 x 8 products. The upper one and what
// the lower one carries into it are at most 65025 + 254.
FIXPID_INLINE uint32_t fixpid_number_product(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *number)
{
    const uint8_t low_byte = (uint8_t)(number->parts.magnitude & 0xFFu);
    const uint8_t high_byte = (uint8_t)(number->parts.magnitude >> 8);
    const uint16_t low = fixpid_8x8(gain, low_byte);
    const uint16_t high = (uint16_t)(fixpid_8x8(gain, high_byte) + (low >> 8));

    return ((uint32_t)high << 8) | (low & 0xFFu);
}

FIXPID_INLINE int32_t fixpid_number_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *number)
{
    const int32_t product = (int32_t)fixpid_number_product(gain, number);

    return ((number->parts.negative & 1u) != 0u) ? -product : product;
}

// With the sign that the product has, it is added or subtracted; an 8051 and a
// Z80 lack the registers for a choice between two sums.
#if defined(__SDCC_mcs51) || defined(__SDCC_z80)
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_add32(sum, fixpid_number_term(gain, number));
}
#else
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    const int32_t product = (int32_t)fixpid_number_product(gain, number);

    if ((number->parts.negative & 1u) != 0u) {
        return fixpid_sub32(sum, product);
    }
    return fixpid_add32(sum, product);
}
#endif

FIXPID_INLINE uint32_t fixpid_sixteenth(uint32_t x)
{
    return x >> 4;
}

#endif
