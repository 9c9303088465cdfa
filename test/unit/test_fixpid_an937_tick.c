// SPDX-License-Identifier: MIT
// A tick from an interrupt that arrives inside a step, which is using another:
// the source is compiled here with an interrupt before each of its sums.
// (Without the public header: Ceedling would link the source that belongs to
// it, too.)
#include "an937/fixpid_an937_arith.h"
#include "unity.h"

FIXPID_DATA struct fixpid_an937 an937_controller;

static bool interrupted;

static void interrupt(void)
{
    if (interrupted) {
        interrupted = false;
        fixpid_an937_tick(&an937_controller);
    }
}

#define fixpid_number_add(sum, change, limit, flags)                           \
    (interrupt(), fixpid_number_add(sum, change, limit, flags))
#include "an937/fixpid_an937.c"
#undef fixpid_number_add

#define IS_VOLATILE(member)                                                    \
    __builtin_types_compatible_p(__typeof__(&(member)), volatile uint8_t *)

void setUp(void)
{
    static const struct fixpid_an937_config config = {96, 80, 16, 4000, 4};

    interrupted = false;
    TEST_ASSERT_TRUE(fixpid_an937_init(&an937_controller, &config));
}

void tearDown(void)
{
}

void test_step_a_tick_inside_is_kept_for_the_next(void)
{
    fixpid_an937_tick(&an937_controller);
    interrupted = true;
    fixpid_an937_step(&an937_controller, 100);
    TEST_ASSERT_FALSE(interrupted);
    TEST_ASSERT_EQUAL_UINT8(1, an937_controller.tick_pending);
    TEST_ASSERT_EQUAL_UINT8(0, an937_controller.tick_overrun);

    // The next step accumulates again, though no other tick has come.
    const int32_t once = an937_controller.accumulated_error.value;
    fixpid_an937_step(&an937_controller, 100);
    TEST_ASSERT_EQUAL_UINT8(0, an937_controller.tick_pending);
    TEST_ASSERT_NOT_EQUAL(once, an937_controller.accumulated_error.value);
}

void test_step_without_a_tick_uses_none(void)
{
    interrupted = true;
    fixpid_an937_step(&an937_controller, 100);
    TEST_ASSERT_TRUE(interrupted);
    TEST_ASSERT_EQUAL_UINT8(0, an937_controller.tick_pending);
}

// What an interrupt writes is read anew, and written at once.
void test_the_bytes_of_a_tick_are_volatile(void)
{
    TEST_ASSERT_TRUE(IS_VOLATILE(an937_controller.tick_pending));
    TEST_ASSERT_TRUE(IS_VOLATILE(an937_controller.tick_overrun));
    TEST_ASSERT_FALSE(IS_VOLATILE(an937_controller.derivative_countdown));
}
