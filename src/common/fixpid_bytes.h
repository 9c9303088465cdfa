// SPDX-License-Identifier: MIT
// Numbers as bytes, the lowest first.
#ifndef FIXPID_BYTES_H
#define FIXPID_BYTES_H
#include <stdint.h>

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
