// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table as a chip gets it that multiplies bytes.
#include "unity.h"

#undef __AVR__
#undef _PIC14
#define _PIC18 // XC8's name for one

#include "table_arith_checks.h"

void setUp(void)
{
}

void tearDown(void)
{
}

void test_bytes_share_nasty_numbers_is_rounded_half_up(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, rise_all_wrong());
}

void test_bytes_product_nasty_numbers(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(4294836225), product(65535, 65535));
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(65537) * 255u,
                             product(65535, 255) + 510u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(0x1234) * 0x5678u,
                             product(0x1234, 0x5678));
    TEST_ASSERT_EQUAL_UINT32(0, product(65535, 0));
}
