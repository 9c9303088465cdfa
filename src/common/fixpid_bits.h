// SPDX-License-Identifier: MIT Signed 16-bit values as two's complement
// patterns in a uint16_t: the sign is one bit to test, comparisons need no
// sign, and nothing can overflow. Also the shifts, sums and products that
// several modules need.
#ifndef FIXPID_BITS_H
#define FIXPID_BITS_H
#include <stdint.h>

#include "fixpid.h"

// The width of the chip's multiplier, in bits of an operand, as far as its
// compiler tells. Each controller has its arithmetic in two forms: wide, with
// words of the result's size, and narrow, from bytes. The width chooses between
// them, except where the other one was measured to be faster.
#if defined(__SDCC_pic14) || defined(_PIC14) || defined(_PIC14E) ||            \
    defined(_PIC14EX) || defined(__SDCC_pdk13) || defined(__SDCC_pdk14) ||     \
    defined(__SDCC_pdk15) || defined(__SDCC_z80) || defined(__SDCC_z180) ||    \
    defined(__SDCC_sm83) || defined(__SDCC_tlcs90) || defined(__MSP430__) ||   \
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

// C leaves the shift of a negative value to the compiler. Each known one rounds
// down, as the library needs it.
#if (-1 >> 1) != -1
#error "fixpid needs a compiler whose shift to the right rounds down"
#endif

// True if `condition` is. It is marked as seldom true, so that the other way
// has no jump. (For a rarer one gcc would save code, for a less rare one copy
// it.)
#if defined(__GNUC__) && (__GNUC__ >= 9)
#define FIXPID_SELDOM(condition)                                               \
    (__builtin_expect_with_probability((condition), 0, 0.95) != 0)
#elif defined(__GNUC__)
#define FIXPID_SELDOM(condition) (__builtin_expect((condition), 0) != 0)
#else
#define FIXPID_SELDOM(condition) (condition)
#endif

// Hides from gcc what made `word`: it is in one register then, not in two
// copies of different widths, and what made it seldom is behind a jump. XC8 may
// call itself GNU, as its front end does, but has no assembly with operands.
#if defined(__GNUC__) && !defined(__XC8) && !defined(FIXPID_NO_ASSEMBLY)
#define FIXPID_OPAQUE(word) __asm__("" : "+r"(word))
#else
#define FIXPID_OPAQUE(word) ((void)0)
#endif

// A function that few steps call. Where registers are few, gcc would otherwise
// save and move more of them in all other steps.
#if (defined(__AVR__) && !defined(__OPTIMIZE_SIZE__)) ||                       \
    (defined(__thumb__) && !defined(__thumb2__))
#define FIXPID_APART static __attribute__((noinline))
#else
#define FIXPID_APART static
#endif

#if defined(__SDCC)
#include "fixpid_bits_sdcc.h"
#else

// Returns the magnitude of a negative pattern: 1..32768.
FIXPID_INLINE uint16_t fixpid_negated(uint16_t bits)
{
    return (uint16_t)((uint16_t)~bits + 1u);
}

// -1 - x: the mirror image that every int16_t has. The difference of two mirror
// images is the difference turned round.
FIXPID_INLINE int16_t complement(int16_t x)
{
    return (int16_t)(-1 - x);
}

// floor(x / 2^n). pre: n <= 31
FIXPID_INLINE int32_t shift_right_floor(int32_t x, uint8_t n)
{
    return x >> n; // Deviation 10.1: as above
}

// x * 2^n. pre: it fits
FIXPID_INLINE int32_t shift_left(int32_t x, uint8_t n)
{
    return x * (int32_t)(UINT32_C(1) << n);
}

// `value` within low..high. pre: low <= high
FIXPID_INLINE int32_t clamp32(int32_t value, int32_t low, int32_t high)
{
    if (value > high) {
        return high;
    }
    return (value < low) ? low : value;
}

// Wrapping sum and difference. pre: they fit. Only a corrupted controller can
// overflow them; then the result is wrong, but defined.
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

// a * b. post: at most 65025
FIXPID_INLINE uint16_t fixpid_8x8(uint8_t a, uint8_t b)
{
    return (uint16_t)((uint32_t)a * b);
}

#endif

#endif
