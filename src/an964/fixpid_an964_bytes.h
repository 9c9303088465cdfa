// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h from 8 x 8 bits, for chips that multiply
// bytes. All sums keep within 16 bits.
#ifndef FIXPID_AN964_BYTES_H
#define FIXPID_AN964_BYTES_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

// A product's upper part is a multiple of 256, which both divisions divide
// without a rest. It is at most 127 * 3.
FIXPID_INLINE uint16_t fixpid_10x7_div16(uint16_t gain, uint8_t magnitude)
{
    const uint16_t low = fixpid_8x8((uint8_t)(gain & 0xFFu), magnitude);
    const uint16_t high = fixpid_8x8((uint8_t)(gain >> 8), magnitude);

    return (uint16_t)((low >> 4) + (uint16_t)(high << 4));
}

// The lower part is at most 65025 + 31, the upper one 255 * 3.
FIXPID_INLINE uint16_t fixpid_10x8_div32(uint16_t gain, uint8_t magnitude,
                                         uint8_t round_up, uint8_t limit)
{
    const uint16_t low =
        (uint16_t)(fixpid_8x8((uint8_t)(gain & 0xFFu), magnitude) +
                   (round_up & 31u));
    const uint16_t high = fixpid_8x8((uint8_t)(gain >> 8), magnitude);
    const uint16_t quotient = (uint16_t)((low >> 5) + (uint16_t)(high << 3));

    return (quotient > limit) ? limit : quotient;
}

// The product without its lowest byte is that of the upper bytes and more:
// 63 * 3 * 256 + 255 * 63 + 3 * 255 + 254 = 65468 at most.
FIXPID_INLINE uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude)
{
    const uint8_t magnitude_low = (uint8_t)(magnitude & 0xFFu);
    const uint8_t magnitude_high = (uint8_t)(magnitude >> 8);
    const uint8_t gain_low = (uint8_t)(gain & 0xFFu);
    const uint8_t gain_high = (uint8_t)(gain >> 8);
    const uint8_t highest = (uint8_t)fixpid_8x8(magnitude_high, gain_high);
    const uint16_t middle = (uint16_t)(fixpid_8x8(magnitude_high, gain_low) +
                                       fixpid_8x8(magnitude_low, gain_high));
    const uint16_t low = fixpid_8x8(magnitude_low, gain_low) >> 8;

    return (uint16_t)((uint16_t)((uint16_t)highest << 8) + middle + low) >> 2;
}

#endif
