// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit as a chip gets them that multiplies bytes.
#include "unity.h"

#undef __AVR__
#undef _PIC14
#define _PIC18 // XC8's name for one

#include "an964_8bit_arith_checks.h"

void setUp(void)
{
}

void tearDown(void)
{
}

void test_bytes_7x7_div4_whole_domain_both_ways_and_limits(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_div4());
}

void test_bytes_7x7_div8_whole_domain(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_div8());
}

void test_bytes_7x7_div32_whole_domain(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_div32());
    TEST_ASSERT_EQUAL_UINT16(504, fixpid_7x7_div32(127, 127));
}
