// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table against 64 bits.
#include "unity.h"

#include "table_arith_checks.h"

void setUp(void)
{
}

void tearDown(void)
{
}

void test_share_nasty_numbers_is_rounded_half_up(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, rise_all_wrong());
}

void test_share_both_ends_of_its_sum(void)
{
    TEST_ASSERT_EQUAL_UINT16(65535, rise_at(65535, 65535, 65535));
    TEST_ASSERT_EQUAL_UINT16(65534, rise_at(65535, 65534, 65535));
    TEST_ASSERT_EQUAL_UINT16(0, rise_at(0, 65534, 65535));
    TEST_ASSERT_EQUAL_UINT16(1, rise_at(1, 1, 2));
    TEST_ASSERT_EQUAL_UINT16(0, rise_at(1, 1, 3));
}

void test_less_is_the_whole_range(void)
{
    TEST_ASSERT_EQUAL_UINT16(65535, fixpid_difference(INT16_MAX, INT16_MIN));
    TEST_ASSERT_EQUAL_UINT16(0, fixpid_difference(INT16_MIN, INT16_MIN));
    TEST_ASSERT_EQUAL_UINT16(3, fixpid_difference(1, -2));
}

void test_between_falling_takes_the_half_up_too(void)
{
    TEST_ASSERT_EQUAL_INT16(1, height_at(0, 1, 1, 2));
    TEST_ASSERT_EQUAL_INT16(0, height_at(0, -1, 1, 2));
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, height_at(INT16_MAX, INT16_MIN, 0, 1));
    TEST_ASSERT_EQUAL_INT16(-32767,
                            height_at(INT16_MAX, INT16_MIN, 65534, 65535));
}
