// SPDX-License-Identifier: MIT
// Records as bytes: numbers are little-endian, and a check is behind them.
#ifndef FIXPID_BYTES_H
#define FIXPID_BYTES_H
#include <stdint.h>

#define CHECK_BEGIN 0xFFFFu // else bytes of 0 at the front would change nothing
#define CHECK_POLYNOMIAL 0x1021u

// CRC-16 of the first bytes, the highest bit first. Its polynomial has a
// Hamming distance of 4 up to 32751 bits; a record has 62 * 8 = 496 at most.
static uint16_t check_of(const uint8_t bytes[], uint8_t count)
{
    uint16_t check = CHECK_BEGIN;
    uint8_t at;
    uint8_t bit;

    for (at = 0; at < count; at++) {
        check ^= (uint16_t)((uint16_t)bytes[at] << 8);
        for (bit = 8; bit != 0u; bit--) {
            const uint16_t out = check & 0x8000u;

            check = (uint16_t)((check & 0x7FFFu) << 1);
            if (out != 0u) {
                check ^= CHECK_POLYNOMIAL;
            }
        }
    }
    return check;
}

static void put(uint8_t bytes[], uint16_t value)
{
    bytes[0] = (uint8_t)(value & 0xFFu);
    bytes[1] = (uint8_t)(value >> 8);
}

static void put32(uint8_t bytes[], uint32_t value)
{
    put(bytes, (uint16_t)(value & 0xFFFFu));
    put(&bytes[2], (uint16_t)(value >> 16));
}

static uint16_t get(const uint8_t bytes[])
{
    return (uint16_t)(bytes[0] | ((uint16_t)bytes[1] << 8));
}

static uint32_t get32(const uint8_t bytes[])
{
    return get(bytes) | ((uint32_t)get(&bytes[2]) << 16);
}

#endif
