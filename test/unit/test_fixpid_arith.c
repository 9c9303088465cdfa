// SPDX-License-Identifier: MIT
// Every form of the product leaf, over its whole domain.
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
