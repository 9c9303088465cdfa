// SPDX-License-Identifier: MIT
// Two's complement patterns, and the summands of shift and add.
#include "common/fixpid_bits.h"
#include "common/fixpid_shift_add.h"
#include "unity.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every value of 16 bits
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

void test_negated_every_pattern(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const uint16_t bits = (uint16_t)((uint32_t)value & 0xFFFFu);

        TEST_ASSERT_EQUAL_UINT16((uint32_t)-value & 0xFFFFu,
                                 fixpid_negated(bits));
    }
}

void test_sign_bit_is_that_of_the_negative_patterns(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const uint16_t bits = (uint16_t)((uint32_t)value & 0xFFFFu);

        TEST_ASSERT_EQUAL_INT(value < 0, (bits & FIXPID_SIGN_BIT) != 0u);
    }
}

void test_add_byte_if_any_bit_up_to_the_largest_sum(void)
{
    for (unsigned bit = 0; bit < 8u; bit++) {
        uint8_t sum = 100;

        fixpid_add_byte_if(&sum, 155, (uint8_t)(1u << bit));
        TEST_ASSERT_EQUAL_UINT8(255, sum);
    }
}

void test_add_byte_if_no_bit_adds_nothing(void)
{
    uint8_t sum = 100;

    fixpid_add_byte_if(&sum, 155, 0);
    TEST_ASSERT_EQUAL_UINT8(100, sum);
}

void test_add_word_if_any_bit_up_to_the_largest_sum(void)
{
    for (unsigned bit = 0; bit < 8u; bit++) {
        uint16_t sum = 1000;

        fixpid_add_word_if(&sum, 64535u, (uint8_t)(1u << bit));
        TEST_ASSERT_EQUAL_UINT16(65535u, sum);
    }
}

void test_add_word_if_no_bit_adds_nothing(void)
{
    uint16_t sum = 1000;

    fixpid_add_word_if(&sum, 64535u, 0);
    TEST_ASSERT_EQUAL_UINT16(1000, sum);
}

// Beyond 32 bits they are those of patterns, as the proofs want it.
void test_add32_and_sub32_wrap(void)
{
    TEST_ASSERT_EQUAL_INT32(-1, fixpid_add32(INT32_MAX, INT32_MIN));
    TEST_ASSERT_EQUAL_INT32(INT32_MIN, fixpid_add32(INT32_MAX, 1));
    TEST_ASSERT_EQUAL_INT32(70001, fixpid_add32(70000, 1));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, fixpid_sub32(INT32_MIN, 1));
    TEST_ASSERT_EQUAL_INT32(-1, fixpid_sub32(70000, 70001));
    TEST_ASSERT_EQUAL_INT32(70001, fixpid_sub32(70000, -1));
}

void test_8x8_every_pair(void)
{
    uint32_t wrong = 0;

    for (uint16_t a = 0; a < 256u; a++) {
        for (uint16_t b = 0; b < 256u; b++) {
            wrong += (fixpid_8x8((uint8_t)a, (uint8_t)b) != (uint32_t)a * b)
                         ? 1u
                         : 0u;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static uint32_t wrong_product_in_turns(uint16_t gain, int32_t x, uint8_t bits)
{
    return ((int64_t)fixpid_product_in_turns(gain, x, bits) !=
            (int64_t)gain * x)
               ? 1u
               : 0u;
}

void test_product_in_turns_every_gain_with_both_ends(void)
{
    static const int32_t ends[] = {-32768, -32767, -1, 0, 1, 21845, 32767};
    uint32_t wrong = 0;

    for (unsigned i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        for (uint32_t gain = 0; gain <= 32767u; gain += TEST_STRIDE) {
            wrong += wrong_product_in_turns((uint16_t)gain, ends[i], 15);
        }
        wrong += wrong_product_in_turns(32767u, ends[i], 15);
    }
    for (uint16_t gain = 0; gain <= 255u; gain++) {
        wrong += wrong_product_in_turns(gain, -65535, 8);
        wrong += wrong_product_in_turns(gain, 65535, 8);
        wrong += wrong_product_in_turns(gain, -(INT32_C(1) << 22), 8);
        wrong += wrong_product_in_turns(gain, (INT32_C(1) << 22) - 1, 8);
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_product_in_turns_every_factor_with_the_largest_gain(void)
{
    uint32_t wrong = 0;

    for (int32_t x = -32768; x <= 32767; x += TEST_STRIDE) {
        wrong += wrong_product_in_turns(32767u, x, 15);
        wrong += wrong_product_in_turns(21845u, x, 15);
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}
