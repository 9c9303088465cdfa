// SPDX-License-Identifier: MIT
// Two's complement patterns, and the summands of shift and add.
#include "fixpid_bits.h"
#include "fixpid_shift_add.h"
#include "unity.h"

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
