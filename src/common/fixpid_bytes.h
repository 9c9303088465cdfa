// SPDX-License-Identifier: MIT
// Numbers as bytes, the lowest first.
#ifndef FIXPID_BYTES_H
#define FIXPID_BYTES_H
#include <stdint.h>

#include "fixpid_get.h"
#include "fixpid_put.h"

static void put32(uint8_t bytes[], uint32_t value)
{
    put(bytes, (uint16_t)(value & 0xFFFFu));
    put(&bytes[2], (uint16_t)(value >> 16));
}

static uint32_t get32(const uint8_t bytes[])
{
    return get(bytes) | ((uint32_t)get(&bytes[2]) << 16);
}

#endif
