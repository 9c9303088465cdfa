// SPDX-License-Identifier: MIT
// Every form of the leaves, over its whole domain or, with 16 x 16 bits and
// more, over every value of one operand.
#include "fixpid_arith.h"
#include "numbers.h"
#include "unity.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 walks a whole domain
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

// All three forms of one product with a word and, where it fits, a byte as the
// short operand. Plain comparisons, because there are a hundred million.
#define CHECK_SCALED(x, k, bias, n, more, k_type)                              \
    do {                                                                       \
        const uint16_t expected_ =                                             \
            (uint16_t)(((uint64_t)(x) * (k) + (bias)) / (1u << (n)));          \
        uint16_t result_, x_ = (uint16_t)(x);                                  \
        k_type k_ = (k_type)(k);                                               \
        FIXPID_SCALED_MULTIPLY(result_, x_, k_, bias, n, more);                \
        wrong += result_ != expected_;                                         \
        FIXPID_SCALED_BYTES(result_, x_, k_, bias, n, more);                   \
        wrong += result_ != expected_;                                         \
        FIXPID_SCALED_SHIFT(result_, x_, k_, bias, n, more);                   \
        wrong += result_ != expected_;                                         \
    } while (0)

#define WALK_SCALED(x_max, k_max, bias, n, more, k_type)                       \
    do {                                                                       \
        uint32_t wrong = 0;                                                    \
        for (uint32_t x = 0; x <= (x_max); x += TEST_STRIDE) {                 \
            for (uint32_t k = 0; k <= (k_max); k++) {                          \
                CHECK_SCALED(x, k, bias, n, more, k_type);                     \
            }                                                                  \
        }                                                                      \
        for (uint32_t k = 0; k <= (k_max); k++) {                              \
            CHECK_SCALED(x_max, k, bias, n, more, k_type);                     \
        }                                                                      \
        TEST_ASSERT_EQUAL_UINT32(0, wrong);                                    \
    } while (0)

void test_scaled_product_of_an964_integral_whole_domain(void)
{
    WALK_SCALED(1023u, 127u, 0u, 4u, 3u, uint8_t);
}

void test_scaled_product_of_an964_derivative_seven_turns_whole_domain(void)
{
    WALK_SCALED(1023u, 127u, 0u, 5u, 2u, uint8_t);
    WALK_SCALED(1023u, 127u, 31u, 5u, 2u, uint16_t);
}

void test_scaled_product_of_an964_derivative_eight_turns_whole_domain(void)
{
    WALK_SCALED(1023u, 255u, 0u, 5u, 3u, uint8_t);
    WALK_SCALED(1023u, 255u, 31u, 5u, 3u, uint16_t);
}

void test_scaled_product_of_an964_output_whole_domain(void)
{
    WALK_SCALED(8758u, 1023u, 0u, 10u, 0u, uint16_t);
}

void test_scaled_product_at_its_precondition_whole_row(void)
{
    WALK_SCALED(16383u, 1023u, 1023u, 10u, 0u, uint16_t);
}

void test_scaled_product_of_8bit_terms_whole_domain(void)
{
    WALK_SCALED(127u, 127u, 0u, 3u, 4u, uint8_t);
    WALK_SCALED(127u, 127u, 0u, 2u, 5u, uint16_t);
    WALK_SCALED(127u, 127u, 3u, 2u, 5u, uint16_t);
    WALK_SCALED(127u, 127u, 0u, 5u, 2u, uint16_t);
}

void test_gain_product_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t gain_value = 0; gain_value <= 255u; gain_value++) {
        for (uint32_t magnitude_value = 0; magnitude_value <= 65535u;
             magnitude_value += TEST_STRIDE) {
            const uint8_t gain = (uint8_t)gain_value;
            const uint16_t magnitude = (uint16_t)magnitude_value;
            uint32_t result;

            FIXPID_GAIN_MULTIPLY(result, gain, magnitude);
            wrong += result != (uint64_t)gain_value * magnitude_value;
            FIXPID_GAIN_BYTES(result, gain, magnitude);
            wrong += result != (uint64_t)gain_value * magnitude_value;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_products_of_nasty_integers_crossed_match_64_bits(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            const uint16_t x = (uint16_t)((uint16_t)nasty[i] & 16383u);
            const uint16_t k = (uint16_t)((uint16_t)nasty[j] & 1023u);
            const uint16_t magnitude = (uint16_t)nasty[i];
            const uint8_t gain = (uint8_t)((uint16_t)nasty[j] & 255u);
            uint32_t result;

            CHECK_SCALED(x, k, 0u, 10u, 0u, uint16_t);
            CHECK_SCALED(x, k, 1023u, 10u, 0u, uint16_t);
            FIXPID_GAIN_BYTES(result, gain, magnitude);
            wrong += result != (uint64_t)gain * magnitude;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_byte_product_whole_domain(void)
{
    for (unsigned a = 0; a <= 255u; a++) {
        for (unsigned b = 0; b <= 255u; b++) {
            const uint8_t left = (uint8_t)a;
            const uint8_t right = (uint8_t)b;
            const uint16_t product = FIXPID_BYTE_PRODUCT(left, right);

            TEST_ASSERT_EQUAL_UINT16((uint32_t)a * b, product);
        }
    }
}

void test_negated_every_negative_pattern_gives_the_magnitude(void)
{
    for (int32_t value = -32768; value < 0; value++) {
        const int16_t pattern = (int16_t)value;

        TEST_ASSERT_EQUAL_UINT16(-value, FIXPID_NEGATED(pattern));
    }
    for (uint32_t magnitude = 1; magnitude <= 65535u; magnitude++) {
        TEST_ASSERT_EQUAL_UINT16(65536u - magnitude,
                                 FIXPID_NEGATED((uint16_t)magnitude));
    }
}
void test_with_sign_and_magnitude_every_value_round_trips(void)
{
    for (int32_t value = -32767; value <= 32767; value++) {
        const int16_t number = (int16_t)value;
        const uint16_t magnitude = FIXPID_MAGNITUDE(value < 0, number);

        TEST_ASSERT_EQUAL_UINT16(value < 0 ? -value : value, magnitude);
        TEST_ASSERT_EQUAL_INT16(value, FIXPID_WITH_SIGN(value < 0, magnitude));
    }
}

// ---- Signed values ----

static int64_t floor_divided(int64_t dividend, int64_t divisor)
{
    return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

static int64_t kept_within(int64_t value, int64_t low, int64_t high)
{
    return value < low ? low : value > high ? high : value;
}

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

static void check_floor(int32_t x)
{
    for (uint8_t n = 0; n <= 30; n++) {
        const int64_t expected = floor_divided(x, INT64_C(1) << n);

        TEST_ASSERT_EQUAL_INT32(expected, FIXPID_FLOOR_SHIFT(x, n));
        TEST_ASSERT_EQUAL_INT32(expected, FIXPID_FLOOR_PORTABLE(x, n));
    }
}

void test_floor_of_nasty_and_random_values_goes_down(void)
{
    numbers_seed(1);
    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        check_floor(nasty32[i]);
    }
    for (unsigned i = 0; i < 1000; i++) {
        check_floor((int32_t)numbers_next());
    }
}

void test_raised_every_16_bits_and_back(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const int16_t counts = (int16_t)value;
        const int32_t raised = value * INT32_C(65536);

        TEST_ASSERT_EQUAL_INT32(value * 256, FIXPID_RAISED(counts, 8));
        TEST_ASSERT_EQUAL_INT32(raised, FIXPID_RAISED(counts, 16));
        TEST_ASSERT_EQUAL_INT16(value, FIXPID_FLOOR(raised, 16));
    }
}

void test_clamp_keeps_a_variable_within_both_ends(void)
{
    static const int16_t expected[] = {-3, -3, -3, -2, -1, 0, 1, 2, 2, 2};

    for (int16_t value = -5; value < 5; value++) {
        int16_t kept = value;

        FIXPID_CLAMP(kept, -3, 2);
        TEST_ASSERT_EQUAL_INT16(expected[value + 5], kept);
        FIXPID_CLAMP(kept, 7, 7);
        TEST_ASSERT_EQUAL_INT16(7, kept);
    }
}

void test_mirrored_images_turn_a_difference_round(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const int16_t x = (int16_t)value;

        TEST_ASSERT_EQUAL_INT16(-1 - value, FIXPID_MIRRORED(x));
    }
}

static uint32_t differences_wrong(int16_t a, int16_t b)
{
    const int16_t expected =
        (int16_t)kept_within((int64_t)a - b, INT16_MIN, INT16_MAX);
    int16_t wide, narrow, chosen;

    FIXPID_DIFFERENCE_WIDE(wide, a, b);
    FIXPID_DIFFERENCE_NARROW(narrow, a, b);
    FIXPID_SATURATED_DIFFERENCE(chosen, a, b);
    return (wide != expected ? 1u : 0u) + (narrow != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_difference_of_every_value_and_nasty_ones_is_saturated(void)
{
    uint32_t wrong = 0;

    for (int32_t value = -32768; value <= 32767; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            wrong += differences_wrong((int16_t)value, nasty[i]);
            wrong += differences_wrong(nasty[i], (int16_t)value);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static uint32_t sums_wrong(int32_t a, int32_t b)
{
    const int32_t expected =
        (int32_t)kept_within((int64_t)a + b, INT32_MIN, INT32_MAX);
    int32_t portable, flag, chosen;

    FIXPID_SUM_PORTABLE(portable, a, b);
    FIXPID_SUM_FLAG(flag, a, b);
    FIXPID_SATURATED_SUM(chosen, a, b);
    return (portable != expected ? 1u : 0u) + (flag != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_sum_of_nasty_and_random_values_is_saturated(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            wrong += sums_wrong(nasty32[i], nasty32[j]);
        }
    }
    numbers_seed(2);
    for (uint32_t n = 0; n < UINT32_C(100000); n += TEST_STRIDE) {
        const int32_t a = (int32_t)numbers_next();

        wrong += sums_wrong(a, (int32_t)numbers_next());
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static uint32_t signed_products_wrong(uint16_t gain, int16_t x)
{
    const int32_t expected = (int32_t)((int64_t)gain * x);
    int32_t multiply, bytes, chosen;

    FIXPID_SIGNED_MULTIPLY(multiply, gain, x);
    FIXPID_SIGNED_BYTES(bytes, gain, x);
    FIXPID_SIGNED_PRODUCT(chosen, gain, x);
    return (multiply != expected ? 1u : 0u) + (bytes != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_signed_product_of_every_value_and_nasty_ones(void)
{
    uint32_t wrong = 0;

    for (uint32_t value = 0; value <= 32767u; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            const uint16_t gain = (uint16_t)((uint16_t)nasty[i] & 32767u);
            const int16_t x = (int16_t)value;

            wrong += signed_products_wrong((uint16_t)value, nasty[i]);
            wrong += signed_products_wrong(gain, x);
            wrong += signed_products_wrong(gain, (int16_t)(-1 - x));
        }
    }
    wrong += signed_products_wrong(32767u, INT16_MAX);
    wrong += signed_products_wrong(32767u, INT16_MIN);
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}
