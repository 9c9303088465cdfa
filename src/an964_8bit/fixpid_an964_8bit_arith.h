// SPDX-License-Identifier: MIT
// The products of AN964's 8-bit form, of two magnitudes below 2^7, each with
// the division that follows it.
#ifndef FIXPID_AN964_8BIT_ARITH_H
#define FIXPID_AN964_8BIT_ARITH_H
#include <stdint.h>

#include "../common/fixpid_bits.h"

// `round_up` is 0 or 0xFF. With 0xFF the quotient is rounded up, because the
// floor of a negative quotient is its magnitude rounded up.

#if defined(__SDCC_pic14) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic14.h"
#elif defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic18.h"
#elif defined(__AVR_HAVE_MUL__) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_avr.h"
#elif FIXPID_MULTIPLIER_BITS < 8
#include "fixpid_an964_8bit_narrow.h"
#else

// x * k, in the machine's width
#if FIXPID_MULTIPLIER_BITS >= 16
FIXPID_INLINE uint_fast16_t fixpid_7x7(uint8_t x, uint8_t k)
{
    return (uint_fast16_t)x * k;
}
#else
FIXPID_INLINE uint_fast16_t fixpid_7x7(uint8_t x, uint8_t k)
{
    return fixpid_8x8(x, k);
}
#endif

// x * k / 4, rounded down or up, at most `limit`. pre: x, k < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div4(uint8_t x, uint8_t k, uint8_t round_up,
                                       uint8_t limit)
{
    const uint_fast16_t quotient = (fixpid_7x7(x, k) + (round_up & 3u)) >> 2;

    return (quotient > limit) ? limit : (uint16_t)quotient;
}

// floor(x * k / 8), at most 127. pre: x, k < 2^7
FIXPID_INLINE uint16_t fixpid_7x7_div8(uint8_t x, uint8_t k)
{
    const uint_fast16_t quotient = fixpid_7x7(x, k) >> 3;

    return (quotient > 127u) ? 127u : (uint16_t)quotient;
}

// floor(x * k / 32). pre: x, k < 2^7; post: at most 504
FIXPID_INLINE uint16_t fixpid_7x7_div32(uint8_t x, uint8_t k)
{
    return (uint16_t)(fixpid_7x7(x, k) >> 5);
}

#endif

#endif
