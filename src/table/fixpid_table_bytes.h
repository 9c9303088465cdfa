// SPDX-License-Identifier: MIT
// A product for chips that multiply bytes.
#ifndef FIXPID_TABLE_BYTES_H
#define FIXPID_TABLE_BYTES_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

// a * b, from four products of bytes. `left` is at most 255 * 255 + 254, and
// `right` and what makes `high` at most 255 * 255 + 255 + 255 = 65535.
TABLE_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    const uint8_t a_low = (uint8_t)(a & 0xFFu);
    const uint8_t a_high = (uint8_t)(a >> 8);
    const uint8_t b_low = (uint8_t)(b & 0xFFu);
    const uint8_t b_high = (uint8_t)(b >> 8);
    const uint16_t low = fixpid_8x8(a_low, b_low);
    const uint16_t left = (uint16_t)(fixpid_8x8(a_high, b_low) + (low >> 8));
    const uint16_t right =
        (uint16_t)(fixpid_8x8(a_low, b_high) + (left & 0xFFu));
    const uint16_t high =
        (uint16_t)(fixpid_8x8(a_high, b_high) + (left >> 8) + (right >> 8));

    return ((uint32_t)high << 16) |
           (uint16_t)(((right & 0xFFu) << 8) | (low & 0xFFu));
}

#endif
