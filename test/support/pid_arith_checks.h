// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_pid against 64 bits, in the form that its includer's
// macros chose. Each function returns how many results were wrong.
#ifndef PID_ARITH_CHECKS_H
#define PID_ARITH_CHECKS_H
#include <stdbool.h>
#include <stdint.h>

#include "common/fixpid_signed.h"
#include "numbers.h"
#include "reference.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every value of 16 bits
#endif
#define RANDOM_CASES ((UINT32_C(100000) / TEST_STRIDE) + 1000u)

static const int32_t nasty32[] = {
    0,
    1,
    -1,
    127,
    -128,
    255,
    256,
    -256,
    -257,
    32767,
    -32768,
    65535,
    65536,
    -65536,
    -65537,
    0x7FFFFF,
    -0x7FFFFF,
    -0x800000,
    0x40000000,
    -0x40000000,
    0x7FFF0000,
    -0x7FFF0000,
    INT32_MAX - 1,
    INT32_MAX,
    INT32_MIN + 1,
    INT32_MIN,
};
#define NASTY32_COUNT (sizeof nasty32 / sizeof nasty32[0])

static inline uint32_t sub16_sat_wrong(int16_t a, int16_t b)
{
    const int64_t expected =
        reference_clamp((int64_t)a - b, INT16_MIN, INT16_MAX);

    return (sub16_sat(a, b) != expected) ? 1u : 0u;
}

// Every value with the nasty ones, on both sides.
static inline uint32_t sub16_sat_all_wrong(void)
{
    uint32_t wrong = 0;

    for (int32_t value = INT16_MIN; value <= INT16_MAX; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            wrong += sub16_sat_wrong((int16_t)value, nasty[i]);
            wrong += sub16_sat_wrong(nasty[i], (int16_t)value);
        }
    }
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            wrong += sub16_sat_wrong(nasty[i], nasty[j]);
        }
    }
    return wrong;
}

static inline uint32_t add32_sat_wrong(int32_t a, int32_t b)
{
    const int64_t expected =
        reference_clamp((int64_t)a + b, INT32_MIN, INT32_MAX);

    return (add32_sat(a, b) != expected) ? 1u : 0u;
}

static inline uint32_t add32_sat_all_wrong(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            wrong += add32_sat_wrong(nasty32[i], nasty32[j]);
        }
    }
    numbers_seed(2);
    for (uint32_t n = 0; n < RANDOM_CASES; n++) {
        const int32_t a = (int32_t)numbers_next();

        wrong += add32_sat_wrong(a, (int32_t)numbers_next());
    }
    return wrong;
}

static inline uint32_t mul16_wrong(uint16_t gain, int16_t x)
{
    return (mul16(gain, x) != (int64_t)gain * x) ? 1u : 0u;
}

// Every gain with the nasty values, and the nasty gains with every value.
static inline uint32_t mul16_all_wrong(void)
{
    uint32_t wrong = 0;

    for (uint32_t value = 0; value <= 32767u; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            const uint16_t gain = (uint16_t)((uint16_t)nasty[i] & 32767u);
            const int16_t x = (int16_t)value;

            wrong += mul16_wrong((uint16_t)value, nasty[i]);
            wrong += mul16_wrong(gain, x);
            wrong += mul16_wrong(gain, (int16_t)(-1 - x));
        }
    }
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        wrong += mul16_wrong(32767u, nasty[i]);
        wrong += mul16_wrong((uint16_t)((uint16_t)nasty[i] & 32767u), nasty[i]);
    }
    return wrong;
}

// Of one value by every number of bits, and by every `options`.
static inline uint32_t floors_wrong(int32_t x)
{
    uint32_t wrong = 0;

    for (uint8_t n = 0; n <= 30u; n++) {
        wrong += (shift_right_floor(x, n) !=
                  reference_floor_divide(x, INT64_C(1) << n))
                     ? 1u
                     : 0u;
    }
    for (uint8_t options = 0; options < 64u; options++) {
        wrong += (shift_right_by(x, options) !=
                  reference_floor_divide(x, 1 << (options & 7)))
                     ? 1u
                     : 0u;
    }
    return wrong;
}

static inline uint32_t floors_all_wrong(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        wrong += floors_wrong(nasty32[i]);
    }
    numbers_seed(1);
    for (uint32_t n = 0; n < RANDOM_CASES / 100u; n++) {
        wrong += floors_wrong((int32_t)numbers_next());
    }
    return wrong;
}

// By all bits for which it fits: nasty values, and every one of 16 bits as the
// step moves them.
static inline uint32_t shift_left_all_wrong(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        for (uint8_t n = 0; n <= 30u; n++) {
            const int64_t expected = nasty32[i] * (INT64_C(1) << n);

            if (expected == (int32_t)expected) {
                wrong += (shift_left(nasty32[i], n) != expected) ? 1u : 0u;
            }
        }
    }
    for (int32_t x = INT16_MIN; x <= INT16_MAX; x += TEST_STRIDE) {
        wrong += (shift_left(x, 8) != x * INT32_C(256)) ? 1u : 0u;
        wrong += (shift_left(x, 16) != x * INT32_C(65536)) ? 1u : 0u;
    }
    return wrong;
}

static inline uint32_t clamp32_all_wrong(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            const int32_t low = nasty32[i];
            const int32_t high = nasty32[j];

            for (unsigned k = 0; (low <= high) && (k < NASTY32_COUNT); k++) {
                wrong += (clamp32(nasty32[k], low, high) !=
                          reference_clamp(nasty32[k], low, high))
                             ? 1u
                             : 0u;
            }
        }
    }
    return wrong;
}

static inline uint32_t complement_all_wrong(void)
{
    uint32_t wrong = 0;

    for (int32_t x = INT16_MIN; x <= INT16_MAX; x++) {
        wrong += (complement((int16_t)x) != -1 - x) ? 1u : 0u;
    }
    return wrong;
}

// An integral `apart` from a limit, of which `counts` is the integer part, with
// each bit of a fraction.
static inline uint32_t is_just_wrong(int16_t limit, int16_t counts,
                                     int32_t integral, int32_t apart)
{
    uint32_t wrong = 0;

    for (unsigned fraction = 0; fraction < 256u; fraction++) {
        const bool expected = apart == 0 && fraction == 0;
        wrong +=
            (is_just(limit, counts, integral, (uint8_t)fraction) != expected)
                ? 1u
                : 0u;
    }
    return wrong;
}

static inline uint32_t reaches_wrong(int16_t limit, int16_t counts,
                                     int32_t integral, int32_t apart)
{
    return (reaches(limit, counts, integral) != (apart >= 0)) ? 1u : 0u;
}

// A limit with each neighbour of its integral.
static inline uint32_t neighbours_wrong(uint32_t (*wrong_of)(
    int16_t limit, int16_t counts, int32_t integral, int32_t apart))
{
    static const int16_t limits[] = {0, 1, -1, 255, -256, 32767, -32767};
    uint32_t wrong = 0;

    for (unsigned i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            const int64_t integral = (int64_t)limits[i] * 65536 + nasty32[j];
            if (integral != reference_clamp(integral, INT32_MIN, INT32_MAX)) {
                continue;
            }
            const int16_t counts =
                (int16_t)((integral - (integral & 0xFFFF)) / 65536);
            wrong += wrong_of(limits[i], counts, (int32_t)integral, nasty32[j]);
        }
    }
    return wrong;
}

static inline uint32_t is_just_all_wrong(void)
{
    return neighbours_wrong(is_just_wrong);
}

static inline uint32_t reaches_all_wrong(void)
{
    return neighbours_wrong(reaches_wrong);
}

static inline uint32_t whole_counts_all_wrong(void)
{
    uint32_t wrong = 0;

    for (int32_t x = INT16_MIN; x <= INT16_MAX; x++) {
        wrong += (whole_counts((int16_t)x) != x * 65536) ? 1u : 0u;
    }
    return wrong;
}

static inline uint32_t rounded_counts_wrong(int32_t sum, int32_t integral)
{
    const int64_t in_256ths =
        sum + (((int64_t)integral - (integral & 0xFF)) / 256) + 128;

    return (rounded_counts(sum, integral) !=
            (in_256ths - (in_256ths & 0xFF)) / 256)
               ? 1u
               : 0u;
}

// Sums of a step, with every kind of integral.
static inline uint32_t rounded_counts_all_wrong(void)
{
    const int32_t most = INT32_MAX - 0x1000000;
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        const int32_t sum = (int32_t)reference_clamp(nasty32[i], -most, most);

        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            wrong += rounded_counts_wrong(sum, nasty32[j]);
        }
    }
    for (uint32_t i = 0; i < RANDOM_CASES; i++) {
        const int32_t sum = (int32_t)numbers_next() >> numbers_below(32);
        const int32_t integral = (int32_t)numbers_next() >> numbers_below(32);

        wrong += rounded_counts_wrong(
            (int32_t)reference_clamp(sum, -most, most), integral);
    }
    return wrong;
}

#endif
