// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_pid: signed values of 16 and 32 bits.
#ifndef FIXPID_PID_ARITH_H
#define FIXPID_PID_ARITH_H
#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "fixpid.h"
#include "fixpid_bits.h"
#include "fixpid_shift_add.h"

#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "pic18/fixpid_pid_pic18.h"
#define add32_with_derivative(a, derivative) fixpid_add32(a, derivative)
#else

// `value` within low..high. pre: low <= high
FIXPID_INLINE int32_t clamp32(int32_t value, int32_t low, int32_t high)
{
    if (value > high) {
        return high;
    }
    return (value < low) ? low : value;
}

// floor(x / 2^n) with n the low three bits of `options`. Where int has 16 bits,
// it shifts in steps, because compilers make a loop of a shift by a variable
// there. The floor of a floor is the floor of both divisions.
// Deviation 20.9: INT_MAX is a macro of <limits.h>.
#if INT_MAX > 32767
FIXPID_INLINE int32_t shift_right_by(int32_t x, uint8_t options)
{
    return shift_right_floor(x, options & 7u);
}
#else
FIXPID_INLINE int32_t shift_right_by(int32_t x, uint8_t options)
{
    int32_t quotient = x;

    if ((options & 4u) != 0u) {
        quotient = shift_right_floor(quotient, 4);
    }
    if ((options & 2u) != 0u) {
        quotient = shift_right_floor(quotient, 2);
    }
    if ((options & 1u) != 0u) {
        quotient = shift_right_floor(quotient, 1);
    }
    return quotient;
}
#endif

// x * 2^n. pre: it fits. SDCC would call its multiplication.
#if defined(__SDCC)
FIXPID_INLINE int32_t shift_left(int32_t x, uint8_t n)
{
    return (int32_t)((uint32_t)x << n);
}
#else
FIXPID_INLINE int32_t shift_left(int32_t x, uint8_t n)
{
    return x * (int32_t)(UINT32_C(1) << n);
}
#endif

// Whether an integral, Q16.16 and eight bits more, of which `counts` is the
// upper half, is just `limit` counts.
#if defined(__SDCC) && !defined(__SDCC_pic16)
// A macro: of an inline function SDCC mistakes the integral's lowest byte, on
// an 8051 with --stack-auto.
#define is_just(limit, counts, integral, fraction)                             \
    (((counts) == (limit)) ? (((uint16_t)(integral) | (fraction)) == 0u)       \
                           : false)
// Deviation 20.9: INT_MAX is a macro of <limits.h>.
#elif INT_MAX > 32767
FIXPID_INLINE bool is_just(int16_t limit, int16_t counts, int32_t integral,
                           uint8_t fraction)
{
    (void)counts;
    return ((integral ^ shift_left(limit, 16)) | fraction) == 0;
}
#else
FIXPID_INLINE bool is_just(int16_t limit, int16_t counts, int32_t integral,
                           uint8_t fraction)
{
    if (counts != limit) {
        return false;
    }
    return ((uint16_t)integral | fraction) == 0u;
}
#endif

// -1 - x: the mirror image that every int16_t has. The difference of two mirror
// images is the difference turned round.
FIXPID_INLINE int16_t complement(int16_t x)
{
    return (int16_t)(-1 - x);
}

#if defined(__AVR_HAVE_MOVW__) && !defined(FIXPID_NO_ASSEMBLY)
#include "avr/fixpid_pid_avr.h" // Deviation 20.1: it builds on the above
#else
// a + derivative. pre: it fits, unless bits were flipped
#define add32_with_derivative(a, derivative) fixpid_add32(a, derivative)
#endif

// (Older compilers for ARM say that they have the instructions and do not.)
#if defined(__ARM_FEATURE_SAT) && !defined(FIXPID_NO_ASSEMBLY) &&              \
    (!defined(__GNUC__) || defined(__clang__) || (__GNUC__ >= 10))
#include "arm/fixpid_pid_arm.h" // Deviation 20.1: as above
#endif

// a - b, saturated. One comparison finds whether the difference fits. Where int
// has 16 bits, it is one of signs: the difference has a wrong one if a's is
// neither b's nor the difference's.
#if defined(FIXPID_HAS_SUB16_SAT)
// in the chip's own header
#elif defined(__riscv_mul) // a jump is cheaper than the arithmetic of the next
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    const int32_t difference = (int32_t)a - b;

    if (difference != (int16_t)difference) {
        return (difference < 0) ? INT16_MIN : INT16_MAX;
    }
    return (int16_t)difference;
}
// Deviation 20.9: as above.
#elif INT_MAX > 32767
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    const int32_t difference = (int32_t)a - b;

    if (difference != (int16_t)difference) {
        return (int16_t)(INT16_MAX ^ shift_right_floor(difference, 30));
    }
    return (int16_t)difference;
}
#else
FIXPID_INLINE int16_t sub16_sat(int16_t a, int16_t b)
{
    const uint16_t difference = (uint16_t)((uint16_t)a - (uint16_t)b);
    const uint8_t sign = (uint8_t)((uint16_t)a >> 8);

    if (((sign ^ (uint8_t)((uint16_t)b >> 8)) &
         (sign ^ (uint8_t)(difference >> 8)) & 0x80u) != 0u) {
        return ((sign & 0x80u) != 0u) ? INT16_MIN : INT16_MAX;
    }
    return (int16_t)difference;
}
#endif

// Whether the compiler has __builtin_add_overflow, which is the CPU's flag: GCC
// from version 5 on, clang.
#if defined(__GNUC__) && (__GNUC__ >= 5)
#define FIXPID_HAS_ADD_OVERFLOW
#elif defined(__has_builtin)
#if __has_builtin(__builtin_add_overflow)
#define FIXPID_HAS_ADD_OVERFLOW
#endif
#endif

// a + b, saturated
#if defined(FIXPID_HAS_ADD32_SAT)
// in the chip's own header
#elif defined(FIXPID_HAS_ADD_OVERFLOW)
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    int32_t sum;

    if (__builtin_add_overflow(a, b, &sum)) {
        return (a < 0) ? INT32_MIN : INT32_MAX;
    }
    return sum;
}
#else // a wrong sign is neither a's nor b's
FIXPID_INLINE int32_t add32_sat(int32_t a, int32_t b)
{
    const uint32_t sum = (uint32_t)a + (uint32_t)b;
    const uint8_t sign = (uint8_t)(sum >> 24);

    if (((sign ^ (uint8_t)((uint32_t)a >> 24)) &
         (sign ^ (uint8_t)((uint32_t)b >> 24)) & 0x80u) != 0u) {
        return ((sign & 0x80u) != 0u) ? INT32_MAX : INT32_MIN;
    }
    return (int32_t)sum;
}
#endif

// gain * x. pre: gain <= 32767; post: within 32767 * 32768 = 2^30 - 2^15. The
// narrow form is made of four 8 x 8 products of the pattern of x; that of a
// negative x is 2^16 too much.
// (An 8051 is faster with its library's product.) SDCC would compile it into
// each of its callers, which takes a seventh more of a Z80's step, and of its
// code.
#if defined(FIXPID_HAS_MUL16)
// in the chip's own header
#elif defined(_PIC18) || defined(_PIC14) || defined(_PIC14E) ||                \
    defined(__MSP430__) || (defined(__SDCC) && !defined(__SDCC_mcs51))
#if defined(__SDCC)
#define FIXPID_MUL16 static
#else
#define FIXPID_MUL16 FIXPID_INLINE
#endif
FIXPID_MUL16 int32_t mul16(uint16_t gain, int16_t x)
{
    const uint8_t gain_low = (uint8_t)(gain & 0xFFu);
    const uint8_t gain_high = (uint8_t)(gain >> 8);
    const uint8_t x_low = (uint8_t)((uint16_t)x & 0xFFu);
    const uint8_t x_high = (uint8_t)((uint16_t)x >> 8);
    const uint16_t low = fixpid_8x8(gain_low, x_low);
    // Each has what the byte below carries: at most 65025 + 255.
    const uint16_t left = (uint16_t)(fixpid_8x8(gain_high, x_low) + (low >> 8));
    const uint16_t right =
        (uint16_t)(fixpid_8x8(gain_low, x_high) + (left & 0xFFu));
    // at most 127 * 255 + 255 + 255
    uint16_t high =
        (uint16_t)(fixpid_8x8(gain_high, x_high) + (left >> 8) + (right >> 8));

    if (x < 0) {
        high = (uint16_t)(high - gain);
    }
    // Deviation 10.8: a pattern of two's complement
    return (int32_t)(((uint32_t)high << 16) |
                     (uint16_t)((uint16_t)(right << 8) | (low & 0xFFu)));
}
#elif defined(__riscv) && (FIXPID_MULTIPLIER_BITS == 0)
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return fixpid_product_in_turns(gain, x, 15);
}
#else
FIXPID_INLINE int32_t mul16(uint16_t gain, int16_t x)
{
    return (int32_t)gain * x;
}
#endif

#endif

#endif
