// SPDX-License-Identifier: MIT
#include "crc16.h"

#include <stdbool.h>

uint16_t crc16(const uint8_t bytes[], unsigned count, uint16_t first)
{
    uint32_t rest = first;

    for (unsigned bit = 0; bit < 8u * count; bit++) {
        const unsigned in = (unsigned)(bytes[bit / 8u] >> (7u - bit % 8u)) & 1u;
        const bool differ = ((rest >> 15) & 1u) != in;

        rest = (rest << 1) & 0xFFFFu;
        if (differ) {
            rest ^= 0x1021u;
        }
    }
    return (uint16_t)rest;
}
