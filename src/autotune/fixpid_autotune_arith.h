// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_autotune's result: numbers of 16 significant bits
// and a wide range.
//
// A number is 0, or mantissa * 2^exponent with a mantissa of 32768..65535. No
// number is negative, and everything truncates. The exponents of what an
// experiment comes to stay within +-120; others would lose their upper bits.
#ifndef FIXPID_AUTOTUNE_ARITH_H
#define FIXPID_AUTOTUNE_ARITH_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid.h"

// Where a table is not to be copied into RAM, and how it is read there.
#if defined(__AVR__)
#include <avr/pgmspace.h>
#define FIXPID_AUTOTUNE_FLASH PROGMEM

FIXPID_INLINE uint8_t flash_byte(const uint8_t *byte)
{
    return pgm_read_byte(byte);
}

FIXPID_INLINE uint16_t flash_word(const uint16_t *word)
{
    return pgm_read_word(word);
}
#else
#define FIXPID_AUTOTUNE_FLASH

FIXPID_INLINE uint8_t flash_byte(const uint8_t *byte)
{
    return *byte;
}

FIXPID_INLINE uint16_t flash_word(const uint16_t *word)
{
    return *word;
}
#endif

// The exponent of 0, which is below every other: 0 is the smaller one of two
// numbers.
#define NOTHING (-128)

struct number16 {
    uint16_t mantissa;
    int8_t exponent;
};

// value * 2^exponent; a value of more than 16 bits loses the lower ones.
static void make(FIXPID_DATA struct number16 *result, uint32_t value,
                 int16_t exponent)
{
    uint32_t mantissa = value;
    int16_t places = exponent;

    if (value == 0u) {
        places = NOTHING;
    } else {
        while (mantissa > 0xFFFFu) {
            mantissa >>= 1;
            places++;
        }
        while (mantissa < 0x8000u) {
            mantissa <<= 1;
            places--;
        }
    }
    result->mantissa = (uint16_t)mantissa;
    result->exponent = (int8_t)places;
}

// a = a * b
static void multiply(FIXPID_DATA struct number16 *a,
                     FIXPID_DATA const struct number16 *b)
{
    make(a, (uint32_t)a->mantissa * b->mantissa,
         (int16_t)(a->exponent + b->exponent));
}

// a = a / b; 0 if b is 0, which flipped bits may make of what never is.
static void divide(FIXPID_DATA struct number16 *a,
                   FIXPID_DATA const struct number16 *b)
{
    if (b->mantissa == 0u) {
        make(a, 0, 0);
    } else {
        make(a, ((uint32_t)a->mantissa << 16) / b->mantissa,
             (int16_t)(a->exponent - b->exponent - 16));
    }
}

// a with 15 bits more, at an exponent that is not below its own: below 2^31.
static uint32_t aligned(FIXPID_DATA const struct number16 *a, int8_t exponent)
{
    const int16_t places = (int16_t)(exponent - a->exponent);

    if (places > 31) {
        return 0;
    }
    return ((uint32_t)a->mantissa << 15) >> (uint8_t)places;
}

// a = a + b
static void add(FIXPID_DATA struct number16 *a,
                FIXPID_DATA const struct number16 *b)
{
    int8_t exponent = a->exponent;

    if (exponent < b->exponent) {
        exponent = b->exponent;
    }
    make(a, aligned(a, exponent) + aligned(b, exponent),
         (int16_t)((int16_t)exponent - 15));
}

// a > b
static bool greater(FIXPID_DATA const struct number16 *a,
                    FIXPID_DATA const struct number16 *b)
{
    if (a->exponent != b->exponent) {
        return a->exponent > b->exponent;
    }
    return a->mantissa > b->mantissa;
}

// a = a - b, or 0 if b is the larger one
static void subtract(FIXPID_DATA struct number16 *a,
                     FIXPID_DATA const struct number16 *b)
{
    const int8_t exponent = a->exponent;
    uint32_t difference = 0;

    if (greater(a, b)) {
        difference = aligned(a, exponent) - aligned(b, exponent);
    }
    make(a, difference, (int16_t)((int16_t)exponent - 15));
}

// number * 2^fraction to the nearest integer, half up; UINT32_MAX if it has
// more than 31 bits.
static uint32_t integer(FIXPID_DATA const struct number16 *number,
                        int8_t fraction)
{
    const uint32_t mantissa = number->mantissa;
    const int16_t places = (int16_t)(number->exponent + fraction);
    const int16_t beyond = (int16_t)(-1 - places); // of the binary point

    if (places > 15) {
        return UINT32_MAX;
    }
    if (places >= 0) {
        return mantissa << (uint8_t)places;
    }
    if (places < -17) {
        return 0;
    }
    return ((mantissa >> (uint8_t)beyond) + 1u) >> 1;
}

#endif
