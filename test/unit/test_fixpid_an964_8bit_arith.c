// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit over their whole domains, in the form that
// the compiler's macros choose.
#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "fixpid_an964_8bit.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static uint8_t at_most(unsigned value, unsigned limit)
{
    return (uint8_t)(value > limit ? limit : value);
}

static uint32_t wrong_div4(unsigned x, unsigned limit)
{
    uint32_t wrong = 0;

    for (unsigned k = 0; k <= FIXPID_AN964_8BIT_TERM_LIMIT; k++) {
        wrong += (fixpid_7x7_div4((uint8_t)x, (uint8_t)k, 0, (uint8_t)limit) !=
                  at_most(x * k / 4u, limit))
                     ? 1u
                     : 0u;
        wrong +=
            (fixpid_7x7_div4((uint8_t)x, (uint8_t)k, 0xFF, (uint8_t)limit) !=
             at_most((x * k + 3u) / 4u, limit))
                ? 1u
                : 0u;
    }
    return wrong;
}

void test_7x7_div4_whole_domain_both_ways_and_limits(void)
{
    static const uint8_t limits[] = {
        FIXPID_AN964_8BIT_TERM_LIMIT, 0, 1, 30, 31, 126, 127};
    uint32_t wrong = 0;

    for (unsigned x = 0; x <= 127u; x++) {
        for (unsigned i = 0; i < sizeof limits; i++) {
            wrong += wrong_div4(x, limits[i]);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_7x7_div8_whole_domain(void)
{
    uint32_t wrong = 0;

    for (unsigned x = 0; x <= 127u; x++) {
        for (unsigned k = 0; k <= 127u; k++) {
            wrong += (fixpid_7x7_div8((uint8_t)x, (uint8_t)k) !=
                      at_most(x * k / 8u, 127))
                         ? 1u
                         : 0u;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_7x7_div32_whole_domain(void)
{
    uint32_t wrong = 0;

    for (unsigned x = 0; x <= 127u; x++) {
        for (unsigned k = 0; k <= 127u; k++) {
            wrong += (fixpid_7x7_div32((uint8_t)x, (uint8_t)k) != x * k / 32u)
                         ? 1u
                         : 0u;
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
    TEST_ASSERT_EQUAL_UINT16(504, fixpid_7x7_div32(127, 127));
}
