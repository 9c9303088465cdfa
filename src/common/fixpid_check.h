// SPDX-License-Identifier: MIT
// The check behind a record's bytes. It is not in fixpid_bytes.h, because SDCC
// keeps a static function in each source, even if nobody calls it there.
#ifndef FIXPID_CHECK_H
#define FIXPID_CHECK_H
#include <stdint.h>

#define CHECK_BEGIN 0xFFFFu // otherwise leading bytes of 0 would change nothing
#define CHECK_POLYNOMIAL 0x1021u

// CRC-16 of the first bytes, the highest bit first. Its polynomial has a
// Hamming distance of 4 up to 32751 bits; a record has 62 * 8 = 496 at most.
static uint16_t check_of(FIXPID_BYTES_DATA const uint8_t *bytes, uint8_t count)
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

#endif
