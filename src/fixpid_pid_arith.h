// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_pid: signed values of 16 and 32 bits.
#ifndef FIXPID_PID_ARITH_H
#define FIXPID_PID_ARITH_H
#include <limits.h>
#include <stdint.h>

#include "fixpid_arith.h"

// 2^n as an int32_t. pre: n <= 30
#define FIXPID_POWER(n) ((int32_t)(UINT32_C(1) << (n)))

// floor(x / 2^n) of an int32_t variable. pre: n <= 30
#define FIXPID_FLOOR_SHIFT(x, n) ((x) >> (n))
#define FIXPID_FLOOR_PORTABLE(x, n)                                            \
    (((x) < 0) ? (-1 - ((-1 - (x)) / FIXPID_POWER(n)))                         \
               : ((x) / FIXPID_POWER(n)))

// C leaves the shift of a negative value open; these compilers document it.
#if defined(__GNUC__) || defined(__SDCC) || defined(__XC8)
#define FIXPID_FLOOR FIXPID_FLOOR_SHIFT
#else
#define FIXPID_FLOOR FIXPID_FLOOR_PORTABLE
#endif

// result = floor(x / 2^n) of int32_t variables, where the low three bits of
// `bits` are n. In steps it needs no loop, where a compiler makes one of a
// shift by a variable. The floor of a floor is that of both.
#define FIXPID_FLOOR_BY_SHIFT(result, x, bits)                                 \
    do {                                                                       \
        (result) = FIXPID_FLOOR((x), ((bits)&7u));                             \
    } while (0)
#define FIXPID_FLOOR_BY_STEPS(result, x, bits)                                 \
    do {                                                                       \
        int32_t floor_ = (x);                                                  \
        if (((bits)&4u) != 0u) {                                               \
            floor_ = FIXPID_FLOOR(floor_, 4);                                  \
        }                                                                      \
        if (((bits)&2u) != 0u) {                                               \
            floor_ = FIXPID_FLOOR(floor_, 2);                                  \
        }                                                                      \
        if (((bits)&1u) != 0u) {                                               \
            floor_ = FIXPID_FLOOR(floor_, 1);                                  \
        }                                                                      \
        (result) = floor_;                                                     \
    } while (0)

// x * 2^n as an int32_t. pre: it fits. SDCC would call its multiplication.
#if defined(__SDCC)
#define FIXPID_RAISED(x, n) ((int32_t)((uint32_t)(x) << (n)))
#else
#define FIXPID_RAISED(x, n) ((int32_t)(x)*FIXPID_POWER(n))
#endif

// Keeps a variable within low..high. pre: low <= high
#define FIXPID_CLAMP(variable, low, high)                                      \
    do {                                                                       \
        if ((variable) > (high)) {                                             \
            (variable) = (high);                                               \
        }                                                                      \
        if ((variable) < (low)) {                                              \
            (variable) = (low);                                                \
        }                                                                      \
    } while (0)

// -1 - x: the mirror image that every int16_t has. The difference of two mirror
// images is the difference turned round: MIRRORED(a) - MIRRORED(b) == b - a.
#define FIXPID_MIRRORED(x) ((int16_t)(-1 - (x)))

// result = a - b kept within int16_t. result, a and b are int16_t variables.
#define FIXPID_DIFFERENCE_WIDE(result, a, b)                                   \
    do {                                                                       \
        int32_t difference_ = (int32_t)(a) - (b);                              \
        FIXPID_CLAMP(difference_, INT16_MIN, INT16_MAX);                       \
        (result) = (int16_t)difference_;                                       \
    } while (0)

// For an int of 16 bits: asks for the room before it subtracts.
#define FIXPID_DIFFERENCE_NARROW(result, a, b)                                 \
    do {                                                                       \
        const int16_t a_ = (a);                                                \
        const int16_t b_ = (b);                                                \
        if (b_ < 0) {                                                          \
            (result) =                                                         \
                (a_ > (INT16_MAX + b_)) ? INT16_MAX : (int16_t)(a_ - b_);      \
        } else {                                                               \
            (result) =                                                         \
                (a_ < (INT16_MIN + b_)) ? INT16_MIN : (int16_t)(a_ - b_);      \
        }                                                                      \
    } while (0)

// result = a + b kept within int32_t. result, a and b are int32_t variables.
#define FIXPID_SUM_PORTABLE(result, a, b)                                      \
    do {                                                                       \
        const int32_t a_ = (a);                                                \
        const int32_t b_ = (b);                                                \
        if (b_ < 0) {                                                          \
            (result) = (a_ < (INT32_MIN - b_)) ? INT32_MIN : (a_ + b_);        \
        } else {                                                               \
            (result) = (a_ > (INT32_MAX - b_)) ? INT32_MAX : (a_ + b_);        \
        }                                                                      \
    } while (0)

// With the processor's overflow flag.
#define FIXPID_SUM_FLAG(result, a, b)                                          \
    do {                                                                       \
        int32_t sum_;                                                          \
        if (__builtin_add_overflow((a), (b), &sum_)) {                         \
            sum_ = ((a) < 0) ? INT32_MIN : INT32_MAX;                          \
        }                                                                      \
        (result) = sum_;                                                       \
    } while (0)

// result = gain * x for a uint16_t gain up to 32767, an int16_t x and an
// int32_t result: within 32767 * 32768 = 2^30 - 2^15.
#define FIXPID_SIGNED_MULTIPLY(result, gain, x)                                \
    do {                                                                       \
        (result) = (int32_t)(gain) * (x);                                      \
    } while (0)

// Four 8 x 8 products of the pattern of x, below 2^31; that of a negative x is
// 2^16 too much.
#define FIXPID_SIGNED_BYTES(result, gain, x)                                   \
    do {                                                                       \
        const uint16_t gain_ = (gain);                                         \
        const uint16_t x_ = (uint16_t)(x);                                     \
        const uint8_t gain_low_ = (uint8_t)(gain_ & 0xFFu);                    \
        const uint8_t gain_high_ = (uint8_t)(gain_ >> 8);                      \
        const uint8_t x_low_ = (uint8_t)(x_ & 0xFFu);                          \
        const uint8_t x_high_ = (uint8_t)(x_ >> 8);                            \
        const uint16_t low_ = FIXPID_BYTE_PRODUCT(gain_low_, x_low_);          \
        const uint16_t high_ = FIXPID_BYTE_PRODUCT(gain_high_, x_high_);       \
        const uint16_t left_ = FIXPID_BYTE_PRODUCT(gain_high_, x_low_);        \
        const uint16_t right_ = FIXPID_BYTE_PRODUCT(gain_low_, x_high_);       \
        uint32_t product_ = ((uint32_t)high_ << 16) | low_;                    \
        product_ += (uint32_t)left_ << 8;                                      \
        product_ += (uint32_t)right_ << 8;                                     \
        (result) = (int32_t)product_;                                          \
        if ((x_ & 0x8000u) != 0u) {                                            \
            (result) -= (int32_t)((uint32_t)gain_ << 16);                      \
        }                                                                      \
    } while (0)

// The leaves that fixpid_pid uses: in assembly for the families that have a
// kernel, if FIXPID_PRODUCT asks for it, else in C.
#if FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL && defined(__AVR_HAVE_MUL__)
#include "fixpid_pid_avr.h"
#define FIXPID_SATURATED_DIFFERENCE FIXPID_DIFFERENCE_AVR
#define FIXPID_SATURATED_SUM FIXPID_SUM_AVR
#define FIXPID_SIGNED_PRODUCT FIXPID_SIGNED_AVR
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL && defined(__SDCC_pic16)
#include "fixpid_pid_pic18.h"
#define FIXPID_SATURATED_DIFFERENCE FIXPID_DIFFERENCE_PIC18
#define FIXPID_SATURATED_SUM FIXPID_SUM_PIC18
#define FIXPID_SIGNED_PRODUCT FIXPID_SIGNED_PIC18
#endif

// Deviation 20.9: INT_MAX is a macro of <limits.h>.
#if INT_MAX > 32767
#define FIXPID_FLOOR_BY FIXPID_FLOOR_BY_SHIFT
#else
#define FIXPID_FLOOR_BY FIXPID_FLOOR_BY_STEPS
#endif

#if defined(FIXPID_SATURATED_DIFFERENCE)
// Deviation 20.9: INT_MAX is a macro of <limits.h>.
#elif INT_MAX > 32767
#define FIXPID_SATURATED_DIFFERENCE FIXPID_DIFFERENCE_WIDE
#else
#define FIXPID_SATURATED_DIFFERENCE FIXPID_DIFFERENCE_NARROW
#endif

#if defined(FIXPID_SATURATED_SUM)
#elif defined(__GNUC__)
#define FIXPID_SATURATED_SUM FIXPID_SUM_FLAG
#else
#define FIXPID_SATURATED_SUM FIXPID_SUM_PORTABLE
#endif

#if defined(FIXPID_SIGNED_PRODUCT)
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_BYTES
#define FIXPID_SIGNED_PRODUCT FIXPID_SIGNED_BYTES
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_SHIFT
#define FIXPID_SIGNED_PRODUCT FIXPID_SIGNED_BYTES
#else
#define FIXPID_SIGNED_PRODUCT FIXPID_SIGNED_MULTIPLY
#endif

#endif
