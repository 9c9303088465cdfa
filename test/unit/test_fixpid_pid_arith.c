// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_pid, in the compiler's own form.
#include "pid_arith_checks.h"
#include "unity.h"

TEST_SOURCE_FILE("test/support/numbers.c")
TEST_SOURCE_FILE("test/support/reference.c")

void setUp(void)
{
}

void tearDown(void)
{
}

void test_sub16_sat_every_value_and_nasty_ones(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, sub16_sat_all_wrong());
}

void test_add32_sat_nasty_and_random_values(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, add32_sat_all_wrong());
}

void test_mul16_every_value_and_nasty_ones(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, mul16_all_wrong());
}

void test_shift_right_nasty_and_random_values_goes_down(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, floors_all_wrong());
}

void test_shift_left_wherever_it_fits(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, shift_left_all_wrong());
}

void test_clamp32_nasty_values_and_limits_crossed(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, clamp32_all_wrong());
}

void test_complement_every_value(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, complement_all_wrong());
}

void test_is_just_the_limit_its_neighbours_and_fractions(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, is_just_all_wrong());
}

void test_whole_counts_every_value(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, whole_counts_all_wrong());
}

void test_reaches_the_limit_and_its_neighbours(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, reaches_all_wrong());
}

void test_rounded_counts_nasty_and_random_values(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, rounded_counts_all_wrong());
}
