// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_an937.
#ifndef FIXPID_AN937_ARITH_H
#define FIXPID_AN937_ARITH_H
#include <stdint.h>

#include "fixpid_arith.h"

// The numbers of AN937 are signed, of 17 bits, and in one of two forms: a value
// where a machine word holds it; in parts, a magnitude and a sign of 0 or 1,
// where words are bytes. In parts a sign may stand by a magnitude of 0.

// number = 0
#define FIXPID_VALUE_CLEAR(number)                                             \
    do {                                                                       \
        (number).value = 0;                                                    \
    } while (0)
#define FIXPID_PARTS_CLEAR FIXPID_VALUE_CLEAR

// number = from, an int16_t
#define FIXPID_VALUE_SET(number, from)                                         \
    do {                                                                       \
        (number).value = (from);                                               \
    } while (0)
#define FIXPID_PARTS_SET(number, from)                                         \
    do {                                                                       \
        uint16_t magnitude_ = (uint16_t)(from);                                \
        (number).parts.negative = 0;                                           \
        if (((uint8_t)(magnitude_ >> 8) & 0x80u) != 0u) {                      \
            (number).parts.negative = 1;                                       \
            magnitude_ = FIXPID_NEGATED(magnitude_);                           \
        }                                                                      \
        (number).parts.magnitude = magnitude_;                                 \
    } while (0)

// The number as an int32_t.
#define FIXPID_VALUE_GET(number) ((number).value)
#define FIXPID_PARTS_GET(number)                                               \
    (((number).parts.negative != 0u) ? (-(int32_t)(number).parts.magnitude)    \
                                     : ((int32_t)(number).parts.magnitude))

// number = clamp(number + addend, -limit, limit); flags = limited if the sum
// lay beyond. limit is a uint16_t. The number may lie beyond it, too: the sum
// is within +-131070.
#define FIXPID_VALUE_ADD(number, addend, limit, flags, limited)                \
    do {                                                                       \
        int32_t total_ = (number).value + (addend).value;                      \
        if (total_ > (int32_t)(limit)) {                                       \
            total_ = (int32_t)(limit);                                         \
            (flags) = (limited);                                               \
        }                                                                      \
        if (total_ < -(int32_t)(limit)) {                                      \
            total_ = -(int32_t)(limit);                                        \
            (flags) = (limited);                                               \
        }                                                                      \
        (number).value = total_;                                               \
    } while (0)

// Unlike signs subtract the smaller magnitude from the larger, whose sign
// stays.
#define FIXPID_PARTS_ADD(number, addend, limit, flags, limited)                \
    do {                                                                       \
        uint16_t total_ = (number).parts.magnitude;                            \
        if ((number).parts.negative == (addend).parts.negative) {              \
            total_ = (uint16_t)(total_ + (addend).parts.magnitude);            \
            if (total_ < (addend).parts.magnitude) {                           \
                total_ = UINT16_MAX;                                           \
                (flags) = (limited);                                           \
            }                                                                  \
        } else if (total_ >= (addend).parts.magnitude) {                       \
            total_ = (uint16_t)(total_ - (addend).parts.magnitude);            \
        } else {                                                               \
            total_ = (uint16_t)((addend).parts.magnitude - total_);            \
            (number).parts.negative ^= 1u;                                     \
        }                                                                      \
        if (total_ > (limit)) {                                                \
            total_ = (limit);                                                  \
            (flags) = (limited);                                               \
        }                                                                      \
        (number).parts.magnitude = total_;                                     \
    } while (0)

// An error as a level, which compares without a sign: error + 32768.
#define FIXPID_LEVEL(error) ((uint16_t)((uint16_t)(error) ^ 0x8000u))

// number = left - right of two uint16_t variables
#define FIXPID_VALUE_DIFFERENCE(number, left, right)                           \
    do {                                                                       \
        (number).value = (int32_t)(left) - (int32_t)(right);                   \
    } while (0)
#define FIXPID_PARTS_DIFFERENCE(number, left, right)                           \
    do {                                                                       \
        uint16_t difference_ = (uint16_t)((left) - (right));                   \
        (number).parts.negative = 0;                                           \
        if ((left) < (right)) {                                                \
            (number).parts.negative = 1;                                       \
            difference_ = FIXPID_NEGATED(difference_);                         \
        }                                                                      \
        (number).parts.magnitude = difference_;                                \
    } while (0)

// sum = gain * number and sum += gain * number, for an int32_t and a uint8_t:
// |gain * number| <= 255 * 65535 < 2^24. `room` exists in SDCC's object mode on
// a PIC18 only: shifts and casts would copy a product twice.
#define FIXPID_VALUE_PRODUCT(sum, gain, number, room)                          \
    do {                                                                       \
        (sum) = (int32_t)(gain) * (number).value;                              \
    } while (0)
#define FIXPID_VALUE_ADD_PRODUCT(sum, gain, number, room)                      \
    do {                                                                       \
        (sum) += (int32_t)(gain) * (number).value;                             \
    } while (0)

// 256 * high + the low byte of low = gain * magnitude, from two 8 x 8 products:
// the upper one and the carry are at most 65025 + 254. Both are computed before
// anything is stored, or SDCC copies their operands.
#define FIXPID_GAIN_BYTES(high, low, gain, magnitude)                          \
    do {                                                                       \
        const uint8_t low_byte_ = (uint8_t)((magnitude)&0xFFu);                \
        (low) = FIXPID_BYTE_PRODUCT(gain, low_byte_);                          \
        const uint8_t high_byte_ = (uint8_t)((magnitude) >> 8);                \
        (high) = FIXPID_BYTE_PRODUCT(gain, high_byte_);                        \
        (high) = (uint16_t)((high) + (uint8_t)((low) >> 8));                   \
    } while (0)

#if defined(FIXPID_AN937_ROOM)
#define FIXPID_PRODUCT_VARIABLE
#define FIXPID_PUT_TOGETHER(high, low, room)                                   \
    do {                                                                       \
        (room).bytes.middle = (high);                                          \
        (room).bytes.lowest = (uint8_t)(low);                                  \
    } while (0)
#define FIXPID_TOGETHER(room) ((room).all)
#define FIXPID_CLEAR_ROOM(room) ((room).all = 0)
#else
#define FIXPID_PRODUCT_VARIABLE uint32_t product_;
#define FIXPID_PUT_TOGETHER(high, low, room)                                   \
    do {                                                                       \
        product_ = ((uint32_t)(high) << 8) | ((low)&0xFFu);                    \
    } while (0)
#define FIXPID_TOGETHER(room) ((int32_t)product_)
#define FIXPID_CLEAR_ROOM(room)
#endif

#define FIXPID_PARTS_PRODUCT(sum, gain, number, room)                          \
    do {                                                                       \
        uint16_t low_;                                                         \
        uint16_t high_;                                                        \
        FIXPID_PRODUCT_VARIABLE                                                \
        FIXPID_GAIN_BYTES(high_, low_, gain, (number).parts.magnitude);        \
        FIXPID_PUT_TOGETHER(high_, low_, room);                                \
        (sum) = FIXPID_TOGETHER(room);                                         \
        if ((number).parts.negative != 0u) {                                   \
            (sum) = -(sum);                                                    \
        }                                                                      \
    } while (0)
#define FIXPID_PARTS_ADD_PRODUCT(sum, gain, number, room)                      \
    do {                                                                       \
        uint16_t low_;                                                         \
        uint16_t high_;                                                        \
        FIXPID_PRODUCT_VARIABLE                                                \
        FIXPID_GAIN_BYTES(high_, low_, gain, (number).parts.magnitude);        \
        FIXPID_PUT_TOGETHER(high_, low_, room);                                \
        if ((number).parts.negative != 0u) {                                   \
            (sum) -= FIXPID_TOGETHER(room);                                    \
        } else {                                                               \
            (sum) += FIXPID_TOGETHER(room);                                    \
        }                                                                      \
    } while (0)

// sum = gain_0 * number_0 + gain_1 * number_1 + gain_2 * number_2
#define FIXPID_VALUE_PRODUCTS(sum, gain_0, number_0, gain_1, number_1, gain_2, \
                              number_2, room)                                  \
    do {                                                                       \
        FIXPID_VALUE_PRODUCT(sum, gain_0, number_0, room);                     \
        FIXPID_VALUE_ADD_PRODUCT(sum, gain_1, number_1, room);                 \
        FIXPID_VALUE_ADD_PRODUCT(sum, gain_2, number_2, room);                 \
    } while (0)
#define FIXPID_PARTS_PRODUCTS(sum, gain_0, number_0, gain_1, number_1, gain_2, \
                              number_2, room)                                  \
    do {                                                                       \
        FIXPID_PARTS_PRODUCT(sum, gain_0, number_0, room);                     \
        FIXPID_PARTS_ADD_PRODUCT(sum, gain_1, number_1, room);                 \
        FIXPID_PARTS_ADD_PRODUCT(sum, gain_2, number_2, room);                 \
    } while (0)

// What LIMITED_SIXTEENTH tells in `flags`, a uint8_t: the sum was limited; it
// was below 0 before the division.
#define FIXPID_SUM_SATURATED 0x01u
#define FIXPID_SUM_NEGATIVE 0x80u

// sum = clamp(sum, -(2^24 - 1), 2^24 - 1) / 16, rounded toward zero. The
// uppermost byte of a magnitude tells whether it is too large.
// pre: |sum| < 2^31
#define FIXPID_LIMITED_SIXTEENTH(sum, flags)                                   \
    do {                                                                       \
        if ((sum) < 0) {                                                       \
            (flags) |= FIXPID_SUM_NEGATIVE;                                    \
            (sum) = -(sum);                                                    \
        }                                                                      \
        if ((uint8_t)((uint32_t)(sum) >> 24) != 0u) {                          \
            (flags) |= FIXPID_SUM_SATURATED;                                   \
            (sum) = INT32_C(0xFFFFFF);                                         \
        }                                                                      \
        (sum) = (int32_t)((uint32_t)(sum) >> 4);                               \
        if (((flags)&FIXPID_SUM_NEGATIVE) != 0u) {                             \
            (sum) = -(sum);                                                    \
        }                                                                      \
    } while (0)
#define FIXPID_LIMITED_RESULT(sum) (sum)

// The leaves. The kernel is a PIC18's: an AVR, which has another one, does
// without.
#if (FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL) && defined(__AVR__)
#define FIXPID_AN937_PRODUCT FIXPID_PRODUCT_MULTIPLY
#else
#define FIXPID_AN937_PRODUCT FIXPID_PRODUCT
#endif

#if FIXPID_AN937_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_NUMBER_CLEAR FIXPID_VALUE_CLEAR
#define FIXPID_NUMBER_SET FIXPID_VALUE_SET
#define FIXPID_NUMBER_GET FIXPID_VALUE_GET
#define FIXPID_NUMBER_ADD FIXPID_VALUE_ADD
#define FIXPID_NUMBER_DIFFERENCE FIXPID_VALUE_DIFFERENCE
#define FIXPID_NUMBER_TERM FIXPID_VALUE_PRODUCT
#else
#define FIXPID_NUMBER_CLEAR FIXPID_PARTS_CLEAR
#define FIXPID_NUMBER_SET FIXPID_PARTS_SET
#define FIXPID_NUMBER_GET FIXPID_PARTS_GET
#define FIXPID_NUMBER_ADD FIXPID_PARTS_ADD
#define FIXPID_NUMBER_DIFFERENCE FIXPID_PARTS_DIFFERENCE
#define FIXPID_NUMBER_TERM FIXPID_PARTS_PRODUCT
#endif

#if FIXPID_AN937_PRODUCT == FIXPID_PRODUCT_KERNEL
#include "fixpid_an937_pic18.h"
#define FIXPID_SUM_OF_PRODUCTS FIXPID_KERNEL_PRODUCTS
#define FIXPID_SUM_SIXTEENTH FIXPID_KERNEL_SIXTEENTH
#define FIXPID_SUM_RESULT FIXPID_KERNEL_RESULT
#else
#if FIXPID_AN937_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_SUM_OF_PRODUCTS FIXPID_VALUE_PRODUCTS
#else
#define FIXPID_SUM_OF_PRODUCTS FIXPID_PARTS_PRODUCTS
#endif
#define FIXPID_SUM_SIXTEENTH FIXPID_LIMITED_SIXTEENTH
#define FIXPID_SUM_RESULT FIXPID_LIMITED_RESULT
#endif

#endif
