// SPDX-License-Identifier: MIT
// The functions of fixpid_bits.h for SDCC, which needs other spellings. Most
// are macros: its pic16 port keeps a copy of each `static inline` function in
// flash and passes the arguments through memory.
#ifndef FIXPID_BITS_SDCC_H
#define FIXPID_BITS_SDCC_H
#include <stdint.h>

#include "fixpid.h"

// SDCC negates this one in place. (Other compilers' sanitizers report a wrap.)
#define fixpid_negated(bits) ((uint16_t)(0u - (bits)))
#define complement(x) ((int16_t) ~(x))
#define shift_right_floor(x, n) ((x) >> (n))
// With a product, as the C has it, SDCC would call its multiplication.
#define shift_left(x, n) ((int32_t)((uint32_t)(x) << (n)))
#define clamp32(value, low, high)                                              \
    (((value) > (high)) ? (high) : (((value) < (low)) ? (low) : (value)))

// Of fixpid_signed.h. (Of an inline is_just SDCC mistakes the integral's lowest
// byte, on an 8051 with --stack-auto.)
typedef int16_t signal_word;
typedef int32_t counts_word;
#define whole_counts(counts) ((int32_t)((uint32_t)(uint16_t)(counts) << 16))
#define reaches(limit, counts, integral) ((counts) >= (limit))
#define is_just(limit, counts, integral, fraction)                             \
    (((counts) == (limit)) && (((uint16_t)(integral) | (fraction)) == 0u))
#define rounded_counts(sum, integral)                                          \
    shift_right_floor(                                                         \
        fixpid_add32((sum), shift_right_floor((integral), 8) + 128), 8)

// SDCC's own sums wrap.
#define fixpid_add32(a, b) ((a) + (b))
#define fixpid_sub32(a, b) ((a) - (b))

// SDCC multiplies bytes only where there is no cast, and then keeps all 16
// bits. A function would stay in every object file of a PIC18, where most
// products are in assembly and do not call it.
#if !defined(__SDCC_pic16) || defined(FIXPID_NO_ASSEMBLY)
FIXPID_INLINE uint16_t fixpid_8x8(uint8_t a, uint8_t b)
{
    return a * b;
}
#else
#define fixpid_8x8(a, b) ((a) * (b))
#endif

// Of fixpid_shift_add.h. SDCC copies the operands of an inline function and
// makes a byte of the bit before it tests it: on a PIC16F684 a step of AN964
// takes 856 cycles with functions and 630 with these.
#define fixpid_add_byte_if(sum, x, bit)                                        \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            *(sum) = (uint8_t)(*(sum) + (x));                                  \
        }                                                                      \
    } while (0)

#define fixpid_add_word_if(sum, x, bit)                                        \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            *(sum) = (uint16_t)(*(sum) + (x));                                 \
        }                                                                      \
    } while (0)

#endif
