// SPDX-License-Identifier: MIT
// The arithmetic that controllers share: words and signs, and the products of
// AN964. Bit tricks are here, in the fixpid_..._arith.h of a controller and in
// its kernels, and nowhere else.
//
// Everything is a macro: under SDCC's PIC ports a call costs more than the
// arithmetic, and an inline function is emitted a second time as dead code.
#ifndef FIXPID_ARITH_H
#define FIXPID_ARITH_H
#include <stdint.h>

// Ways to multiply, with equal results for every operand that `pre:` allows. A
// chip with a wide multiplier uses it; a PIC18 sums 8 x 8 products; a PIC16
// adds and shifts right, which makes the division free. Each chip has its own
// way if FIXPID_PRODUCT is not defined, in the same way for all sources.
//
// FIXPID_PRODUCT=4 takes a controller's kernel for the family, where it has
// one, for SDCC's ports and avr-gcc; its source is then compiled, too:
// fixpid_an937_pic18.c, fixpid_an964_pic14.c, fixpid_an964_8bit_pic14.c,
// fixpid_pid_pic18.c. On any other machine these do the same in C, which is how
// they are tested. With a kernel, a function of one controller must not
// interrupt that of another.
//
// FIXPID_PRODUCT=5 unrolls the products of fixpid_an964 for a PIC16: half as
// many words again for a quarter of the cycles less.
#define FIXPID_PRODUCT_MULTIPLY 1
#define FIXPID_PRODUCT_BYTES 2
#define FIXPID_PRODUCT_SHIFT 3
#define FIXPID_PRODUCT_KERNEL 4
#define FIXPID_PRODUCT_UNROLLED 5

#ifndef FIXPID_PRODUCT
#if defined(__SDCC_pic16) || defined(_PIC18)
#define FIXPID_PRODUCT FIXPID_PRODUCT_BYTES
#elif defined(__SDCC_pic14) || defined(_PIC14) || defined(_PIC14E)
#define FIXPID_PRODUCT FIXPID_PRODUCT_SHIFT
#else
#define FIXPID_PRODUCT FIXPID_PRODUCT_MULTIPLY
#endif
#endif
#if (FIXPID_PRODUCT < 1) || (FIXPID_PRODUCT > 5)
#error "FIXPID_PRODUCT: 1 multiply, 2 bytes, 3 shift, 4 kernel or 5 unrolled"
#endif

// A function that is written apart and compiled into its one caller. SDCC keeps
// a copy of a static one that nobody calls; its pic14 port does without, and
// its Padauk ports fail on the locals of a static one.
#if defined(__SDCC_pic14) || defined(__SDCC_pdk13) || defined(__SDCC_pdk14) || \
    defined(__SDCC_pdk15)
#define FIXPID_INLINE inline
#else
#define FIXPID_INLINE static inline
#endif

// The magnitude of a negative 16-bit two's complement pattern, -32768 included.
// Each compiler does one of the two in place; others may trap on the first.
// pre: bits != 0; post: 1..32768 for a negative value.
#if defined(__SDCC)
#define FIXPID_NEGATED(bits) ((uint16_t)(0u - (bits)))
#else
#define FIXPID_NEGATED(bits) ((uint16_t)((uint16_t) ~(uint16_t)(bits) + 1u))
#endif

// Signed values as two's complement in a uint16_t: a test of one bit for the
// sign, and nothing can overflow. SDCC compares a uint16_t with a constant of
// the same type best.
#define FIXPID_WORD(value) ((uint16_t)(value))
#define FIXPID_NEGATIVE(bits) (((bits)&0x8000u) != 0u)
#define FIXPID_NEGATE(bits) ((bits) = FIXPID_NEGATED(bits))

// A uint8_t that is 0, or odd: SDCC tests one bit best.
#define FIXPID_SAYS_SO(flag) (((flag)&1u) != 0u)

// The number of such a pattern. C leaves the conversion to the compiler; all
// compilers of these chips and of the tests keep the bits, and SDCC makes two
// copies for a cast.
#if defined(__SDCC_pic14)
#define FIXPID_SIGNED(bits) (bits)
#else
#define FIXPID_SIGNED(bits) ((int16_t)(bits))
#endif
#define FIXPID_SIGNED_BYTE(bits) ((int8_t)(bits))

// a * b of two uint8_t variables, at most 65025. SDCC's pic16 port finds its
// multiply instruction only without a cast, and does not trap on overflow.
#if defined(__SDCC_pic16)
#define FIXPID_BYTE_PRODUCT(a, b) ((a) * (b))
#else
#define FIXPID_BYTE_PRODUCT(a, b) ((uint16_t)((uint32_t)(a) * (b)))
#endif

// The scaled products of AN964: result = x * k / 2^n, rounded down, or rounded
// up where `up` says so: the floor of a negative quotient is its magnitude
// rounded up. result is a uint16_t variable and k an unsigned one, x is read
// once, and `up` is 0u or a uint8_t that is 0 or 0xFF. n and more are plain
// digits, parts of names.
//
//   7X7    x is below 2^7, k below 2^7; k has n + 1 + more bits
//   10X8   x is below 2^10, k below 2^8; k has n + more bits
//   14X10  x is a uint16_t variable below 2^14, k is below 2^10 and read once;
//          n is 10, and there is neither `up` nor `more`
//
// post: result <= x * k / 2^n + 1 < 2^14
#define FIXPID_UP(up, n, more)                                                 \
    ((up) & (0xFFu >> (8u - (uint8_t)(n) - (uint8_t)(more))))

#define FIXPID_7X7_MULTIPLY(result, x, k, up, n, more)                         \
    do {                                                                       \
        (result) =                                                             \
            (uint16_t)((((uint32_t)(x) * (k)) + FIXPID_UP(up, n, 0)) >> (n));  \
    } while (0)
#define FIXPID_10X8_MULTIPLY FIXPID_7X7_MULTIPLY
#define FIXPID_14X10_MULTIPLY(result, x, k)                                    \
    do {                                                                       \
        (result) = (uint16_t)(((uint32_t)(x) * (k)) >> 10);                    \
    } while (0)

#define FIXPID_7X7_BYTES(result, x, k, up, n, more)                            \
    do {                                                                       \
        const uint8_t x_ = (x);                                                \
        const uint8_t k_ = (uint8_t)(k);                                       \
        (result) = FIXPID_BYTE_PRODUCT(x_, k_);                                \
        (result) = (uint16_t)((result) + FIXPID_UP(up, n, 0));                 \
        (result) = (uint16_t)((result) >> (n));                                \
    } while (0)

// Two 8 x 8 products: the upper one is at most 3 * 255, and 8 bits higher.
#define FIXPID_10X8_BYTES(result, x, k, up, n, more)                           \
    do {                                                                       \
        const uint8_t k_ = (uint8_t)(k);                                       \
        const uint16_t x_ = (x);                                               \
        const uint8_t x_low_ = (uint8_t)(x_ & 0xFFu);                          \
        const uint8_t x_high_ = (uint8_t)(x_ >> 8);                            \
        const uint16_t low_ = FIXPID_BYTE_PRODUCT(x_low_, k_);                 \
        const uint16_t high_ = FIXPID_BYTE_PRODUCT(x_high_, k_);               \
        const uint32_t product_ = ((uint32_t)high_ << 8) + low_;               \
        (result) = (uint16_t)((product_ + FIXPID_UP(up, n, 0)) >> (n));        \
    } while (0)

// Four 8 x 8 products; the two in the middle are at most 16065 + 765.
#define FIXPID_14X10_BYTES(result, x, k)                                       \
    do {                                                                       \
        const uint16_t k_ = (k);                                               \
        const uint8_t x_low_ = (uint8_t)((x)&0xFFu);                           \
        const uint8_t x_high_ = (uint8_t)((x) >> 8);                           \
        const uint8_t k_low_ = (uint8_t)(k_ & 0xFFu);                          \
        const uint8_t k_high_ = (uint8_t)(k_ >> 8);                            \
        const uint16_t low_ = FIXPID_BYTE_PRODUCT(x_low_, k_low_);             \
        const uint16_t high_ = FIXPID_BYTE_PRODUCT(x_high_, k_high_);          \
        uint16_t middle_ = FIXPID_BYTE_PRODUCT(x_high_, k_low_);               \
        uint32_t product_ = ((uint32_t)high_ << 16) | low_;                    \
        middle_ = (uint16_t)(middle_ + FIXPID_BYTE_PRODUCT(x_low_, k_high_));  \
        product_ += (uint32_t)middle_ << 8;                                    \
        (result) = (uint16_t)(product_ >> 10);                                 \
    } while (0)

// The classic multiplication of an 8-bit machine: the sum moves right once per
// bit of k, which divides. Before each shift it is below 2^8 + 2 * 2^13 for
// 10X8, 2 * 2^14 for 14X10.
#define FIXPID_SHIFT_TURNS(result, x, k, turns)                                \
    do {                                                                       \
        uint8_t turn_ = (turns);                                               \
        do {                                                                   \
            FIXPID_MOVE(result, x, k, 1u);                                     \
            (k) >>= 1;                                                         \
            turn_--;                                                           \
        } while (turn_ != 0u);                                                 \
    } while (0)
#define FIXPID_10X8_SHIFT(result, x, k, up, n, more)                           \
    do {                                                                       \
        uint8_t k_ = (uint8_t)(k);                                             \
        uint16_t x_ = (x);                                                     \
        x_ = (uint16_t)(x_ << (more));                                         \
        (result) = (uint8_t)FIXPID_UP(up, n, more);                            \
        FIXPID_SHIFT_TURNS(result, x_, k_, (n) + (more));                      \
    } while (0)
#define FIXPID_14X10_SHIFT(result, x, k)                                       \
    do {                                                                       \
        uint16_t k_ = (k);                                                     \
        (result) = 0;                                                          \
        FIXPID_SHIFT_TURNS(result, x, k_, 10);                                 \
    } while (0)

// In place of turns, each bit of k by itself: the sum of the first n + 1 moves
// right, a byte below 2^7 + 2^7 for 7X7; from there on x moves left.
// Deviation 20.10: a name for each count of bits; SDCC warns of `if (2 > 3)`.
#define FIXPID_7X7_SHIFT(result, x, k, up, n, more)                            \
    do {                                                                       \
        const uint8_t byte_ = (x);                                             \
        uint16_t x_ = byte_;                                                   \
        uint8_t sum_ = (uint8_t)FIXPID_UP(up, n, 0);                           \
        FIXPID_HALVE_##n(sum_, byte_, k);                                      \
        FIXPID_ADD_BYTE(sum_, byte_, (k) & (1u << (n)));                       \
        (result) = sum_;                                                       \
        FIXPID_DOUBLE_##more(result, x_, k, 2u << (n));                        \
    } while (0)
// Deviation 20.10: as above.
#define FIXPID_10X8_UNROLLED(result, x, k, up, n, more)                        \
    do {                                                                       \
        uint16_t x_ = (x);                                                     \
        (result) = (uint8_t)FIXPID_UP(up, n, 0);                               \
        FIXPID_MOVE_##n(result, x_, k);                                        \
        FIXPID_ADD_WORD(result, x_, (k) & (1u << (n)));                        \
        FIXPID_OTHER_##more(result, x_, k, 2u << (n));                         \
    } while (0)
#define FIXPID_14X10_UNROLLED(result, x, k)                                    \
    do {                                                                       \
        const uint16_t k_ = (k);                                               \
        (result) = 0;                                                          \
        FIXPID_MOVE_5(result, x, k_);                                          \
        FIXPID_MOVE(result, x, k_, 0x20u);                                     \
        FIXPID_MOVE(result, x, k_, 0x40u);                                     \
        FIXPID_MOVE(result, x, k_, 0x80u);                                     \
        FIXPID_MOVE(result, x, k_, 0x100u);                                    \
        FIXPID_MOVE(result, x, k_, 0x200u);                                    \
    } while (0)

#define FIXPID_ADD_WORD(sum, x, bit)                                           \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            (sum) = (uint16_t)((sum) + (x));                                   \
        }                                                                      \
    } while (0)
#define FIXPID_ADD_BYTE(sum, x, bit)                                           \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            (sum) = (uint8_t)((sum) + (x));                                    \
        }                                                                      \
    } while (0)
#define FIXPID_MOVE(sum, x, k, bit)                                            \
    FIXPID_ADD_WORD(sum, x, (k) & (bit));                                      \
    (sum) = (uint16_t)((sum) >> 1)
#define FIXPID_MOVE_4(sum, x, k)                                               \
    FIXPID_MOVE(sum, x, k, 1u);                                                \
    FIXPID_MOVE(sum, x, k, 2u);                                                \
    FIXPID_MOVE(sum, x, k, 4u);                                                \
    FIXPID_MOVE(sum, x, k, 8u)
#define FIXPID_MOVE_5(sum, x, k)                                               \
    FIXPID_MOVE_4(sum, x, k);                                                  \
    FIXPID_MOVE(sum, x, k, 16u)
#define FIXPID_HALVE(sum, x, k, bit)                                           \
    FIXPID_ADD_BYTE(sum, x, (k) & (bit));                                      \
    (sum) >>= 1
#define FIXPID_HALVE_2(sum, x, k)                                              \
    FIXPID_HALVE(sum, x, k, 1u);                                               \
    FIXPID_HALVE(sum, x, k, 2u)
#define FIXPID_HALVE_3(sum, x, k)                                              \
    FIXPID_HALVE_2(sum, x, k);                                                 \
    FIXPID_HALVE(sum, x, k, 4u)
#define FIXPID_HALVE_5(sum, x, k)                                              \
    FIXPID_HALVE_3(sum, x, k);                                                 \
    FIXPID_HALVE(sum, x, k, 8u);                                               \
    FIXPID_HALVE(sum, x, k, 16u)
#define FIXPID_DOUBLE_1(sum, x, k, bit)                                        \
    (x) = (uint16_t)((x) + (x));                                               \
    FIXPID_ADD_WORD(sum, x, (k) & (bit))
#define FIXPID_DOUBLE_2(sum, x, k, bit)                                        \
    FIXPID_DOUBLE_1(sum, x, k, bit);                                           \
    FIXPID_DOUBLE_1(sum, x, k, 2u * (bit))
#define FIXPID_DOUBLE_3(sum, x, k, bit)                                        \
    FIXPID_DOUBLE_2(sum, x, k, bit);                                           \
    FIXPID_DOUBLE_1(sum, x, k, 4u * (bit))
#define FIXPID_DOUBLE_4(sum, x, k, bit)                                        \
    FIXPID_DOUBLE_3(sum, x, k, bit);                                           \
    FIXPID_DOUBLE_1(sum, x, k, 8u * (bit))
// Of 2 and 3 bits, those after the first.
#define FIXPID_OTHER_2 FIXPID_DOUBLE_1
#define FIXPID_OTHER_3 FIXPID_DOUBLE_2

// In assembly on a PIC16 and in C elsewhere: fixpid_an964_pic14.h. A limited
// product is a byte there.
#define FIXPID_7X7_LIMITED_KERNEL(result, x, k, up, n, more, limit)            \
    FIXPID_BYTE_AT_MOST(result, fixpid_kernel_7x7_2(up, x, (uint8_t)(k)), limit)
#define FIXPID_10X8_LIMITED_KERNEL(result, x, k, up, n, more, limit)           \
    FIXPID_BYTE_AT_MOST(result, fixpid_kernel_10x8_5((uint8_t)(k), x, up),     \
                        limit)
#define FIXPID_BYTE_AT_MOST(result, product, limit)                            \
    do {                                                                       \
        uint8_t byte_ = (product);                                             \
        if (byte_ >= (uint8_t)(limit)) {                                       \
            byte_ = (uint8_t)(limit);                                          \
        }                                                                      \
        (result) = byte_;                                                      \
    } while (0)

// The products that the steps name; their arguments are expanded first. What is
// limited is at most `limit`, a uint16_t below 128 for 7X7 and 256 for 10X8;
// FIXPID_BYTE_7X7 is at most 127.
//
// The kernel is a PIC16's: other families that have one do without.
#if (FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL) && defined(__SDCC_pic16)
#define FIXPID_AN964_PRODUCT FIXPID_PRODUCT_BYTES
#elif (FIXPID_PRODUCT == FIXPID_PRODUCT_KERNEL) && defined(__AVR__)
#define FIXPID_AN964_PRODUCT FIXPID_PRODUCT_MULTIPLY
#else
#define FIXPID_AN964_PRODUCT FIXPID_PRODUCT
#endif

#if FIXPID_AN964_PRODUCT == FIXPID_PRODUCT_MULTIPLY
#define FIXPID_SCALED_7X7 FIXPID_7X7_MULTIPLY
#define FIXPID_SCALED_10X8 FIXPID_10X8_MULTIPLY
#define FIXPID_PRODUCT_14X10 FIXPID_14X10_MULTIPLY
#elif FIXPID_AN964_PRODUCT == FIXPID_PRODUCT_BYTES
#define FIXPID_SCALED_7X7 FIXPID_7X7_BYTES
#define FIXPID_SCALED_10X8 FIXPID_10X8_BYTES
#define FIXPID_PRODUCT_14X10 FIXPID_14X10_BYTES
#elif FIXPID_AN964_PRODUCT == FIXPID_PRODUCT_SHIFT
#define FIXPID_SCALED_7X7 FIXPID_7X7_SHIFT
#define FIXPID_SCALED_10X8 FIXPID_10X8_SHIFT
#define FIXPID_PRODUCT_14X10 FIXPID_14X10_SHIFT
#elif FIXPID_AN964_PRODUCT == FIXPID_PRODUCT_UNROLLED
#define FIXPID_SCALED_7X7 FIXPID_7X7_SHIFT
#define FIXPID_SCALED_10X8 FIXPID_10X8_UNROLLED
#define FIXPID_PRODUCT_14X10 FIXPID_14X10_UNROLLED
#endif

#if FIXPID_AN964_PRODUCT == FIXPID_PRODUCT_KERNEL
#include "fixpid_an964_pic14.h"
#define FIXPID_PRODUCT_7X7(result, x, k, n, more)                              \
    ((result) = fixpid_kernel_7x7_5(x, (uint8_t)(k)))
#define FIXPID_BYTE_7X7(result, x, k, n, more)                                 \
    ((result) = fixpid_kernel_7x7_3(x, (uint8_t)(k)))
#define FIXPID_LIMITED_7X7 FIXPID_7X7_LIMITED_KERNEL
#define FIXPID_PRODUCT_10X8(result, x, k, n, more)                             \
    ((result) = fixpid_kernel_10x8_4((uint8_t)(k), x))
#define FIXPID_LIMITED_10X8 FIXPID_10X8_LIMITED_KERNEL
#define FIXPID_PRODUCT_14X10(result, x, k)                                     \
    ((result) = fixpid_kernel_14x10(x, k))
#else
#define FIXPID_PRODUCT_7X7(result, x, k, n, more)                              \
    FIXPID_SCALED_7X7(result, x, k, 0u, n, more)
#define FIXPID_BYTE_7X7(result, x, k, n, more)                                 \
    FIXPID_LIMITED_7X7(result, x, k, 0u, n, more, FIXPID_WORD(127))
#define FIXPID_LIMITED_7X7(result, x, k, up, n, more, limit)                   \
    do {                                                                       \
        FIXPID_SCALED_7X7(result, x, k, up, n, more);                          \
        if ((result) > (limit)) {                                              \
            (result) = (limit);                                                \
        }                                                                      \
    } while (0)
#define FIXPID_PRODUCT_10X8(result, x, k, n, more)                             \
    FIXPID_SCALED_10X8(result, x, k, 0u, n, more)
#define FIXPID_LIMITED_10X8(result, x, k, up, n, more, limit)                  \
    do {                                                                       \
        FIXPID_SCALED_10X8(result, x, k, up, n, more);                         \
        if ((result) > (limit)) {                                              \
            (result) = (limit);                                                \
        }                                                                      \
    } while (0)
#endif

#endif
