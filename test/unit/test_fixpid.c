// SPDX-License-Identifier: MIT
// The units of fixpid.h: a period in a rate's place, and a number of 32 bits
// that is limited to 16.
#include "fixpid.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "unity.h"

// In object mode the library is built for an object of this name.
FIXPID_DATA struct fixpid_pid pid_controller;

void setUp(void)
{
}

void tearDown(void)
{
}

void test_sat16_within_16_bits_is_the_number_itself(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        TEST_ASSERT_EQUAL_INT16(value, fixpid_sat16(value));
    }
}

void test_sat16_beyond_16_bits_is_the_nearest_end(void)
{
    for (int32_t beyond = 32768; beyond > 0; beyond *= 2) {
        TEST_ASSERT_EQUAL_INT16(32767, fixpid_sat16(beyond));
        TEST_ASSERT_EQUAL_INT16(-32768, fixpid_sat16(-beyond - 1));
        if (beyond > INT32_MAX / 2) {
            break;
        }
    }
    TEST_ASSERT_EQUAL_INT16(32767, fixpid_sat16(INT32_MAX));
    TEST_ASSERT_EQUAL_INT16(-32768, fixpid_sat16(INT32_MIN));
    TEST_ASSERT_EQUAL_INT16(32767, fixpid_sat16(60000)); // -5536 if it wrapped
}

void test_period_ms_is_the_rate_of_its_steps(void)
{
    static const struct fixpid_pid_gains by_rate =
        FIXPID_PID_GAINS(2, 0.5, 0.1, 10, 1);
    static const struct fixpid_pid_gains by_period =
        FIXPID_PID_GAINS(2, 0.5, 0.1, FIXPID_PERIOD_MS(100), 1);
    static const struct fixpid_pid_gains fast =
        FIXPID_PID_GAINS(2, 0.5, 0.1, FIXPID_PERIOD_MS(0.5), 3);

    TEST_ASSERT_EQUAL_UINT32(by_rate.ki_q24, by_period.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(by_rate.kd_q8, by_period.kd_q8);
    TEST_ASSERT_EQUAL_UINT32(4194, fast.ki_q24); // 0.5 / 2000 x 2^24
    TEST_ASSERT_EQUAL_UINT16(6400, fast.kd_q8);  // 0.1 x 2000 / 8 x 256
    TEST_ASSERT_EQUAL_UINT32(FIXPID_SLEW_RATE(10, 8),
                             FIXPID_SLEW_RATE(10, FIXPID_PERIOD_MS(125)));
}

// Half up, so that the last digit below a half and the half itself differ.
void test_folded_rounds_half_up(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, FIXPID_FOLDED(0.25));
    TEST_ASSERT_EQUAL_UINT32(1, FIXPID_FOLDED(0.5));
    TEST_ASSERT_EQUAL_UINT32(2, FIXPID_FOLDED(1.5));
}
