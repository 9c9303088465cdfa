// SPDX-License-Identifier: MIT
// A number from bytes, the lowest first. It is not in fixpid_bytes.h, because
// SDCC keeps a static function in each source, even if nobody calls it there.
#ifndef FIXPID_GET_H
#define FIXPID_GET_H
#include <stdint.h>

static uint16_t get(FIXPID_BYTES_DATA const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | ((uint16_t)bytes[1] << 8));
}

#endif
