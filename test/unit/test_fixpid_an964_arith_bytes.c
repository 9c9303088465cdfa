// SPDX-License-Identifier: MIT
// The products of fixpid_an964 as a chip gets them that multiplies bytes.
#include "unity.h"

#undef __AVR__
#undef _PIC14
#define _PIC18 // XC8's name for one

#include "an964_arith_checks.h"

void setUp(void)
{
}

void tearDown(void)
{
}

void test_bytes_10x7_div16_whole_domain(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_10x7());
    TEST_ASSERT_EQUAL_UINT16(8120, fixpid_10x7_div16(1023, 127));
}

void test_bytes_10x8_div32_whole_domain_both_ways_and_limits(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_10x8());
}

void test_bytes_10x14_div1024_whole_domain(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, all_wrong_10x14());
    TEST_ASSERT_EQUAL_UINT16(16367, fixpid_10x14_div1024(1023, 16383));
}
