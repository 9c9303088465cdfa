// SPDX-License-Identifier: MIT
#include "heater.h"
#include "mock_fixpid_pid.h"
#include "unity.h"

void test_heater_step_regulates_to_600(void)
{
    fixpid_pid_step_ExpectAndReturn(&heater, 600, 512, 700);
    TEST_ASSERT_EQUAL_INT16(700, heater_step(512));
}
