// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h in plain C for an int of 16 bits, and for a
// compiler that nobody knows: from bytes.
#ifndef FIXPID_SIGNED_NARROW_H
#define FIXPID_SIGNED_NARROW_H
#include <stdint.h>

#include "fixpid_bits.h"
#include "fixpid_signed_int16.h"

// The difference has a wrong sign if a's is neither b's nor the difference's.
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    const uint16_t difference = (uint16_t)((uint16_t)a - (uint16_t)b);
    const uint8_t sign = (uint8_t)((uint16_t)a >> 8);

    if (((sign ^ (uint8_t)((uint16_t)b >> 8)) &
         (sign ^ (uint8_t)(difference >> 8)) & 0x80u) != 0u) {
        return ((sign & 0x80u) != 0u) ? INT16_MIN : INT16_MAX;
    }
    return (int16_t)difference;
}

// The sum has a wrong sign if it is neither a's nor b's.
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    const uint32_t sum = (uint32_t)a + (uint32_t)b;
    const uint8_t sign = (uint8_t)(sum >> 24);

    if (((sign ^ (uint8_t)((uint32_t)a >> 24)) &
         (sign ^ (uint8_t)((uint32_t)b >> 24)) & 0x80u) != 0u) {
        return ((sign & 0x80u) != 0u) ? INT32_MAX : INT32_MIN;
    }
    return (int32_t)sum;
}

FIXPID_INLINE int32_t add32_apart(int32_t a, int32_t b)
{
    return fixpid_add32(a, b);
}

// An 8051 and an AVR are faster with their libraries' product. On the others it
// is made of four 8 x 8 products of the pattern of x; that of a negative x is
// 2^16 too much. SDCC would compile an inline function into each of its
// callers, which takes a seventh more of a Z80's step, and of its code.
#if defined(__SDCC_mcs51) || defined(__AVR__) || (FIXPID_MULTIPLIER_BITS >= 16)
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return (int32_t)gain * x;
}
#else
#if defined(__SDCC)
#define FIXPID_MUL16 static
#else
#define FIXPID_MUL16 FIXPID_INLINE
#endif
FIXPID_MUL16 int32_t mul16(uint16_t gain, int16_t x)
{
    const uint8_t gain_low = (uint8_t)(gain & 0xFFu);
    const uint8_t gain_high = (uint8_t)(gain >> 8);
    const uint8_t x_low = (uint8_t)((uint16_t)x & 0xFFu);
    const uint8_t x_high = (uint8_t)((uint16_t)x >> 8);
    const uint16_t low = fixpid_8x8(gain_low, x_low);
    // Each has what the byte below carries: at most 65025 + 255.
    const uint16_t left = (uint16_t)(fixpid_8x8(gain_high, x_low) + (low >> 8));
    const uint16_t right =
        (uint16_t)(fixpid_8x8(gain_low, x_high) + (left & 0xFFu));
    // at most 127 * 255 + 255 + 255
    uint16_t high =
        (uint16_t)(fixpid_8x8(gain_high, x_high) + (left >> 8) + (right >> 8));

    if (x < 0) {
        high = (uint16_t)(high - gain);
    }
    // Deviation 10.8: a pattern of two's complement
    return (int32_t)(((uint32_t)high << 16) |
                     (uint16_t)((uint16_t)(right << 8) | (low & 0xFFu)));
}
#endif

#endif
