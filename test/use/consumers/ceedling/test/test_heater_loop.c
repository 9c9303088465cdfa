// SPDX-License-Identifier: MIT
#include "fixpid_pid.h"
#include "heater.h"
#include "unity.h"

TEST_SOURCE_FILE("fixpid_pid_more.c")

void test_heater_step_far_below_is_full_power(void)
{
    TEST_ASSERT_TRUE(heater_start());
    TEST_ASSERT_EQUAL_INT16(1023, heater_step(0));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, fixpid_pid_flags(&heater));
}
