// SPDX-License-Identifier: MIT
// Numbers to bytes, the lowest first.
#ifndef FIXPID_PUT_H
#define FIXPID_PUT_H
#include <stdint.h>

#ifndef BYTES_DATA // as in fixpid_get.h
#define BYTES_DATA
#endif

static void put(BYTES_DATA uint8_t bytes[], uint16_t value)
{
    bytes[0] = (uint8_t)(value & 0xFFu);
    bytes[1] = (uint8_t)(value >> 8);
}

static void put32(BYTES_DATA uint8_t bytes[], uint32_t value)
{
    put(bytes, (uint16_t)(value & 0xFFFFu));
    put(&bytes[2], (uint16_t)(value >> 16));
}

#endif
