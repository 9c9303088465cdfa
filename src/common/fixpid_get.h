// SPDX-License-Identifier: MIT
// A number from bytes, the lowest first. It is not in fixpid_bytes.h, because
// SDCC keeps a static function in each source, even if nobody calls it there.
#ifndef FIXPID_GET_H
#define FIXPID_GET_H
#include <stdint.h>

// The address space of the bytes: any, unless the source that includes this has
// all of them in one and says which.
#ifndef BYTES_DATA
#define BYTES_DATA
#endif

static uint16_t get(BYTES_DATA const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | ((uint16_t)bytes[1] << 8));
}

#endif
