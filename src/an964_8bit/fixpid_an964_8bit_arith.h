// SPDX-License-Identifier: MIT
// The products of AN964's 8-bit form, of two magnitudes below 2^7, each with
// the division that follows it. `round_up` is 0 or 0xFF. With 0xFF the quotient
// is rounded up, because the floor of a negative quotient is its magnitude
// rounded up.
#ifndef FIXPID_AN964_8BIT_ARITH_H
#define FIXPID_AN964_8BIT_ARITH_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

#if FIXPID_MULTIPLIER_BITS >= 16

// gain * magnitude / 4, rounded down or up, at most `limit`. pre: both < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div4(uint8_t gain, uint8_t magnitude,
                                       uint8_t round_up, uint8_t limit)
{
    const uint_fast16_t product = (uint_fast16_t)gain * magnitude;
    const uint_fast16_t quotient =
        (uint_fast16_t)((product + (round_up & 3u)) >> 2);

    return (quotient > limit) ? limit : (uint16_t)quotient;
}

// floor(gain * magnitude / 8), at most 127. pre: both < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude)
{
    const uint_fast16_t product = (uint_fast16_t)gain * magnitude;
    const uint_fast16_t quotient = product >> 3;

    return (quotient > 127u) ? 127u : (uint16_t)quotient;
}

// floor(gain * magnitude / 32). pre: both < 2^7; post: at most 504
FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude)
{
    const uint_fast16_t product = (uint_fast16_t)gain * magnitude;

    return (uint16_t)(product >> 5);
}

// The other forms.
#elif defined(__SDCC_pic14) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic14.h"
#elif defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic18.h"
#elif defined(__AVR_HAVE_MUL__) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_avr.h"
#elif FIXPID_MULTIPLIER_BITS == 8
#include "fixpid_an964_8bit_bytes.h"
#else
#include "fixpid_an964_8bit_narrow.h"
#endif

#endif
