// SPDX-License-Identifier: MIT
// A number to bytes, the lowest first: a file of its own as fixpid_get.h is.
#ifndef FIXPID_PUT_H
#define FIXPID_PUT_H
#include <stdint.h>

static void put(FIXPID_BYTES_DATA uint8_t *bytes, uint16_t value)
{
    bytes[0] = (uint8_t)(value & 0xFFu);
    bytes[1] = (uint8_t)(value >> 8);
}

#endif
