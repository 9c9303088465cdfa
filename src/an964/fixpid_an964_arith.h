// SPDX-License-Identifier: MIT
// The products of AN964's 10-bit form, each with the division that follows it.
// Names say the bits of the operands: 10x7 is a gain below 2^10 and a magnitude
// below 2^7. `round_up` is 0 or 0xFF. With 0xFF the quotient is rounded up,
// because the floor of a negative quotient is its magnitude rounded up.
#ifndef FIXPID_AN964_ARITH_H
#define FIXPID_AN964_ARITH_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

#if FIXPID_MULTIPLIER_BITS >= 16

// floor(gain * magnitude / 16). pre: gain < 2^10, magnitude < 2^7;
// post: at most 8120
FIXPID_INLINE uint16_t fixpid_10x7_div16(uint16_t gain, uint8_t magnitude)
{
    return (uint16_t)(((uint32_t)gain * magnitude) >> 4);
}

// gain * magnitude / 32, rounded down or up, at most `limit`. pre: gain < 2^10
FIXPID_INLINE uint16_t fixpid_10x8_div32(uint16_t gain, uint8_t magnitude,
                                         uint8_t round_up, uint8_t limit)
{
    const uint16_t quotient =
        (uint16_t)((((uint32_t)gain * magnitude) + (round_up & 31u)) >> 5);

    return (quotient > limit) ? limit : quotient;
}

// floor(gain * magnitude / 1024). pre: gain < 2^10, magnitude < 2^14;
// post: below 2^14
FIXPID_INLINE uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude)
{
    return (uint16_t)(((uint32_t)gain * magnitude) >> 10);
}

// The other forms.
#elif defined(__SDCC_pic14) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_pic14.h"
#elif defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_pic18.h"
#elif defined(__AVR_HAVE_MUL__) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_avr.h"
#elif FIXPID_MULTIPLIER_BITS == 8
#include "fixpid_an964_bytes.h"
#else
#include "fixpid_an964_narrow.h"
#endif

#endif
