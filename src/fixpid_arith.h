// SPDX-License-Identifier: MIT
// The shared arithmetic of fixpid, and the only place with bit tricks.
//
// Everything is a macro: under SDCC's PIC ports a call costs more than the
// arithmetic, and an inline function is emitted a second time as dead code.
#ifndef FIXPID_ARITH_H
#define FIXPID_ARITH_H
#include <stdint.h>

// Three ways to multiply, with equal results for every operand that `pre:`
// allows. A chip with a wide multiplier uses it; a PIC18 sums 8 x 8 products; a
// PIC16 adds and shifts right, which makes the division free.
#define FIXPID_PRODUCT_MULTIPLY 1
#define FIXPID_PRODUCT_BYTES 2
#define FIXPID_PRODUCT_SHIFT 3

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
// pre: bits != 0; post: 1..32768 for a negative value.
#define FIXPID_NEGATED(bits) ((uint16_t)((uint16_t) ~(uint16_t)(bits) + 1u))

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

// result = gain * magnitude for a uint8_t and a uint16_t variable and a
// uint32_t result: at most 255 * 65535 < 2^24.
#define FIXPID_GAIN_MULTIPLY(result, gain, magnitude)                          \
    do {                                                                       \
        (result) = (uint32_t)(gain) * (magnitude);                             \
    } while (0)

// Two 8 x 8 products: the upper one and the carry are at most 65025 + 254.
#define FIXPID_GAIN_BYTES(result, gain, magnitude)                             \
    do {                                                                       \
        const uint8_t low_byte_ = (uint8_t)((magnitude)&0xFFu);                \
        const uint8_t high_byte_ = (uint8_t)((magnitude) >> 8);                \
        const uint16_t low_ = FIXPID_BYTE_PRODUCT(gain, low_byte_);            \
        uint16_t high_ = FIXPID_BYTE_PRODUCT(gain, high_byte_);                \
        high_ = (uint16_t)(high_ + (low_ >> 8));                               \
        (result) = ((uint32_t)high_ << 8) | (low_ & 0xFFu);                    \
    } while (0)

#if FIXPID_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_MULTIPLY
#define FIXPID_GAIN_PRODUCT FIXPID_GAIN_MULTIPLY
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_BYTES
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_BYTES
#define FIXPID_GAIN_PRODUCT FIXPID_GAIN_BYTES
#elif FIXPID_PRODUCT == FIXPID_PRODUCT_SHIFT
#define FIXPID_SCALED_PRODUCT FIXPID_SCALED_SHIFT
#define FIXPID_GAIN_PRODUCT FIXPID_GAIN_BYTES
#else
#error "FIXPID_PRODUCT: 1 (multiply), 2 (bytes) or 3 (shift)"
#endif

#endif
