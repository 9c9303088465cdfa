// SPDX-License-Identifier: MIT
// The shared arithmetic of fixpid, and the only place with bit tricks.
//
// Everything is a macro: under SDCC's PIC ports a call costs more than the
// arithmetic, and an inline function is emitted a second time as dead code.
#ifndef FIXPID_ARITH_H
#define FIXPID_ARITH_H
#include <limits.h>
#include <stdint.h>

// Ways to multiply, with equal results for every operand that `pre:` allows. A
// chip with a wide multiplier uses it; a PIC18 sums 8 x 8 products; a PIC16
// adds and shifts right, which makes the division free. Each chip has its own
// way if FIXPID_PRODUCT is not defined.
//
// FIXPID_PRODUCT=4, for all sources of a firmware and with
// fixpid_an937_pic18.c among them, is a PIC18's with the sums of AN937 in
// assembly, for SDCC; elsewhere that file does the same in C. Then a function
// of one controller must not interrupt that of another.
#define FIXPID_PRODUCT_MULTIPLY 1
#define FIXPID_PRODUCT_BYTES 2
#define FIXPID_PRODUCT_SHIFT 3
#define FIXPID_PRODUCT_KERNEL 4 // in assembly, where the family has a kernel

#ifndef FIXPID_PRODUCT
#if defined(__SDCC_pic16) || defined(_PIC18)
#define FIXPID_PRODUCT FIXPID_PRODUCT_BYTES
#elif defined(__SDCC_pic14) || defined(_PIC14) || defined(_PIC14E)
#define FIXPID_PRODUCT FIXPID_PRODUCT_SHIFT
#else
#define FIXPID_PRODUCT FIXPID_PRODUCT_MULTIPLY
#endif
#endif

// The magnitude of a negative 16-bit two's complement pattern, -32768 included.
// Each compiler does one of the two in place; others may trap on the first.
// pre: bits != 0; post: 1..32768 for a negative value.
#if defined(__SDCC_pic16)
#define FIXPID_NEGATED(bits) ((uint16_t)(0u - (bits)))
#else
#define FIXPID_NEGATED(bits) ((uint16_t)((uint16_t) ~(uint16_t)(bits) + 1u))
#endif

// An int16_t from its magnitude and sign, and the magnitude of one.
// pre: magnitude <= 32767, value >= -32767.
#define FIXPID_WITH_SIGN(negative, magnitude)                                  \
    ((int16_t)((negative) ? (-(int16_t)(magnitude)) : ((int16_t)(magnitude))))
#define FIXPID_MAGNITUDE(negative, value)                                      \
    ((uint16_t)((negative) ? (-(value)) : (value)))

// a * b of two uint8_t variables, at most 65025. SDCC's pic16 port finds its
// multiply instruction only without a cast, and does not trap on overflow.
#if defined(__SDCC_pic16)
#define FIXPID_BYTE_PRODUCT(a, b) ((a) * (b))
#else
#define FIXPID_BYTE_PRODUCT(a, b) ((uint16_t)((uint32_t)(a) * (b)))
#endif

// result = (x * k + bias) / 2^n, rounded down. A bias of 2^n - 1 rounds up: the
// floor of a negative quotient is its magnitude rounded up.
//
// result and x are uint16_t variables, k is a uint8_t or uint16_t variable, and
// x and k are used up. n and more are unsigned constants: k has n + more bits.
// pre:  k < 2^(n + more), n + more <= 10, x * 2^more < 2^14, bias < 2^n
// post: result <= (x * k + bias) / 2^n < 2^14 + 1
#define FIXPID_SCALED_MULTIPLY(result, x, k, bias, n, more)                    \
    do {                                                                       \
        (result) = (uint16_t)((((uint32_t)(x) * (k)) + (bias)) >> (n));        \
    } while (0)

// Four 8 x 8 products; the two in the middle are at most 16065 + 765.
#define FIXPID_SCALED_BYTES(result, x, k, bias, n, more)                       \
    do {                                                                       \
        const uint8_t x_low_ = (uint8_t)((x)&0xFFu);                           \
        const uint8_t x_high_ = (uint8_t)((x) >> 8);                           \
        const uint8_t k_low_ = (uint8_t)((k)&0xFFu);                           \
        const uint8_t k_high_ = (uint8_t)((uint16_t)(k) >> 8);                 \
        const uint16_t low_ = FIXPID_BYTE_PRODUCT(x_low_, k_low_);             \
        const uint16_t high_ = FIXPID_BYTE_PRODUCT(x_high_, k_high_);          \
        uint16_t middle_ = FIXPID_BYTE_PRODUCT(x_high_, k_low_);               \
        uint32_t product_ = ((uint32_t)high_ << 16) | low_;                    \
        middle_ = (uint16_t)(middle_ + FIXPID_BYTE_PRODUCT(x_low_, k_high_));  \
        product_ += (uint32_t)middle_ << 8;                                    \
        (result) = (uint16_t)((product_ + (bias)) >> (n));                     \
    } while (0)

// The classic multiplication of an 8-bit machine: the sum moves right once per
// bit of k. Before each shift it is below 2^10 + 2 * 2^14 < 2^16.
#define FIXPID_SCALED_SHIFT(result, x, k, bias, n, more)                       \
    do {                                                                       \
        uint8_t turn_ = (uint8_t)((n) + (more));                               \
        (x) = (uint16_t)((x) << (more));                                       \
        (result) = (uint16_t)((uint16_t)(bias) << (more));                     \
        do {                                                                   \
            if (((k)&1u) != 0u) {                                              \
                (result) = (uint16_t)((result) + (x));                         \
            }                                                                  \
            (result) = (uint16_t)((result) >> 1);                              \
            (k) >>= 1;                                                         \
            turn_--;                                                           \
        } while (turn_ != 0u);                                                 \
    } while (0)

// The numbers of AN937 are signed, of 17 bits, and in one of two forms: a value
// where a machine word holds it; in parts, a magnitude and a sign of 0 or 1,
// where words are bytes. In parts a sign may stand by a magnitude of 0.

// number = 0
#define FIXPID_VALUE_CLEAR(number)                                             \
    do {                                                                       \
        (number).value = 0;                                                    \
    } while (0)
#define FIXPID_PARTS_CLEAR(number)                                             \
    do {                                                                       \
        (number).parts.magnitude = 0;                                          \
        (number).parts.negative = 0;                                           \
    } while (0)

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
#else
#define FIXPID_PRODUCT_VARIABLE uint32_t product_;
#define FIXPID_PUT_TOGETHER(high, low, room)                                   \
    do {                                                                       \
        product_ = ((uint32_t)(high) << 8) | ((low)&0xFFu);                    \
    } while (0)
#define FIXPID_TOGETHER(room) ((int32_t)product_)
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

#if FIXPID_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_MULTIPLY
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_BYTES
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_BYTES
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_SHIFT
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_SHIFT
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_BYTES
#else
#error "FIXPID_PRODUCT: 1 (multiply), 2 (bytes), 3 (shift) or 4 (kernel)"
#endif

// The leaves of AN937.
#if FIXPID_PRODUCT == FIXPID_PRODUCT_MULTIPLY
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

#if FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL
#include "fixpid_an937_pic18.h"
#define FIXPID_SUM_OF_PRODUCTS FIXPID_KERNEL_PRODUCTS
#define FIXPID_SUM_SIXTEENTH FIXPID_KERNEL_SIXTEENTH
#define FIXPID_SUM_RESULT FIXPID_KERNEL_RESULT
#else
#if FIXPID_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_SUM_OF_PRODUCTS FIXPID_VALUE_PRODUCTS
#else
#define FIXPID_SUM_OF_PRODUCTS FIXPID_PARTS_PRODUCTS
#endif
#define FIXPID_SUM_SIXTEENTH FIXPID_LIMITED_SIXTEENTH
#define FIXPID_SUM_RESULT FIXPID_LIMITED_RESULT
#endif

// ---- Signed values of 16 and 32 bits, for fixpid_pid ----

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
