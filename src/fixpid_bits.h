// SPDX-License-Identifier: MIT
// Signed 16-bit values as two's complement patterns in a uint16_t: the sign is
// one bit to test, comparisons need no sign, and nothing can overflow. And the
// shift of a negative value.
#ifndef FIXPID_BITS_H
#define FIXPID_BITS_H
#include <stdint.h>

#include "fixpid.h"

// The width of the chip's multiplier, in bits of an operand, as far as its
// compiler tells. Each controller has its arithmetic in two forms: wide, with
// words of the result's size, and narrow, from bytes. The width chooses between
// them, except where the other one was measured to be faster.
#if defined(__SDCC_pic14) || defined(_PIC14) || defined(_PIC14E) ||            \
    defined(__SDCC_pdk13) || defined(__SDCC_pdk14) || defined(__SDCC_pdk15) || \
    defined(__SDCC_z80) || defined(__SDCC_z180) || defined(__SDCC_sm83) ||     \
    defined(__SDCC_tlcs90) || defined(__MSP430__) ||                           \
    (defined(__AVR__) && !defined(__AVR_HAVE_MUL__)) ||                        \
    (defined(__riscv) && !defined(__riscv_mul))
#define FIXPID_MULTIPLIER_BITS 0
#elif defined(__SDCC_pic16) || defined(_PIC18) || defined(__SDCC_stm8) ||      \
    defined(__SDCC_mcs51) || defined(__SDCC_hc08) || defined(__SDCC_s08) ||    \
    defined(__AVR__)
#define FIXPID_MULTIPLIER_BITS 8
#else
#define FIXPID_MULTIPLIER_BITS 16 // or more
#endif

#define FIXPID_SIGN_BIT 0x8000u

#if defined(__SDCC_pic16)
#include "pic18/fixpid_bits_pic18.h"
#else

// Returns the magnitude of a negative pattern: 1..32768. There are two
// spellings, because SDCC negates the first one in place, and other compilers'
// sanitizers report it as a wrap.
#if defined(__SDCC)
FIXPID_INLINE uint16_t fixpid_negated(uint16_t bits)
{
    return (uint16_t)(0u - bits);
}
#else
FIXPID_INLINE uint16_t fixpid_negated(uint16_t bits)
{
    return (uint16_t)((uint16_t)~bits + 1u);
}
#endif

// floor(x / 2^n). pre: n <= 30. C leaves the shift of a negative value open;
// these compilers document it.
#if defined(__GNUC__) || defined(__SDCC) || defined(__XC8)
FIXPID_INLINE int32_t shift_right_floor(int32_t x, uint8_t n)
{
    return x >> n; // Deviation 10.1: as above
}
#else
FIXPID_INLINE int32_t shift_right_floor(int32_t x, uint8_t n)
{
    const int32_t power = (int32_t)(UINT32_C(1) << n);

    return (x < 0) ? (-1 - ((-1 - x) / power)) : (x / power);
}
#endif

#endif

// a + b and a - b of numbers whose sum fits, and modulo 2^32 of others, which
// only flipped bits of a controller can make: plain C leaves those undefined.
// SDCC gives the plain sum the same, and its pic16 port keeps a copy of each
// `static inline` function.
#if defined(__SDCC)
#define fixpid_add32(a, b) ((a) + (b))
#define fixpid_sub32(a, b) ((a) - (b))
#else
FIXPID_INLINE int32_t fixpid_add32(int32_t a, int32_t b)
{
    // Deviation 10.8: a pattern of two's complement
    return (int32_t)((uint32_t)a + (uint32_t)b);
}

FIXPID_INLINE int32_t fixpid_sub32(int32_t a, int32_t b)
{
    // Deviation 10.8: as above
    return (int32_t)((uint32_t)a - (uint32_t)b);
}
#endif

// a * b. post: at most 65025. SDCC multiplies bytes only where there is no
// cast, and then keeps all 16 bits.
#if defined(__SDCC)
FIXPID_INLINE uint16_t fixpid_8x8(uint8_t a, uint8_t b)
{
    return a * b;
}
#else
FIXPID_INLINE uint16_t fixpid_8x8(uint8_t a, uint8_t b)
{
    return (uint16_t)((uint32_t)a * b);
}
#endif

#endif
