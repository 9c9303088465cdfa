// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h in 16 bits, for chips that multiply
// bytes.
#ifndef FIXPID_AN964_8BIT_BYTES_H
#define FIXPID_AN964_8BIT_BYTES_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

FIXPID_INLINE uint16_t fixpid_7x7_div4(uint8_t gain, uint8_t magnitude,
                                       uint8_t round_up, uint8_t limit)
{
    const uint16_t product = fixpid_8x8(gain, magnitude);
    const uint16_t quotient = (uint16_t)(product + (round_up & 3u)) >> 2;

    return (quotient > limit) ? limit : quotient;
}

FIXPID_INLINE uint16_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude)
{
    const uint16_t product = fixpid_8x8(gain, magnitude);
    const uint16_t quotient = product >> 3;

    return (quotient > 127u) ? 127u : quotient;
}

FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude)
{
    const uint16_t product = fixpid_8x8(gain, magnitude);

    return product >> 5;
}

#endif
