// SPDX-License-Identifier: MIT
// fixpid_pid without its features: this test and what it links are compiled
// with FIXPID_PID_FEATURES=0x00.
#include "unity.h"

#include <string.h>

#include "fixpid_pid.h"

#include "numbers.h"
#include "numbers_pid.h"
#include "reference_pid.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_check.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_error.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("test/support/reference.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 20000
#endif

// In object mode the library is built for the object of this name.
struct fixpid_pid pid_controller;

static struct fixpid_pid_config config;

void setUp(void)
{
    const struct fixpid_pid_config plain = {FIXPID_PID_GAINS(2, 1, 0.5, 10, 0),
                                            0,
                                            1000,
                                            0,
                                            0,
                                            0,
                                            false,
                                            false,
                                            false};

    config = plain;
    memset(&pid_controller, 0xA5, sizeof pid_controller);
}

void tearDown(void)
{
}

static void init_accepts(void)
{
    TEST_ASSERT_EQUAL(FIXPID_PID_OK, fixpid_pid_check(&config));
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    TEST_ASSERT_BITS_LOW(FIXPID_PID_REFUSED, fixpid_pid_flags(&pid_controller));
}

static void init_refuses(void)
{
    TEST_ASSERT_NOT_EQUAL(FIXPID_PID_OK, fixpid_pid_check(&config));
    TEST_ASSERT_FALSE(fixpid_pid_init(&pid_controller, &config));
    TEST_ASSERT_BITS_HIGH(FIXPID_PID_REFUSED,
                          fixpid_pid_flags(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 1000, 0));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, -1000, 500));
}

void test_typical_ends_of_the_gains_are_those_without_features(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x7FFF7F, FIXPID_PID_KI_MAX);
    TEST_ASSERT_EQUAL_UINT(0, FIXPID_PID_FILTER_MAX);
    TEST_ASSERT_EQUAL_UINT32(8388479, FIXPID_PID_KI(8388479 / 16777216.0, 1));
}

void test_typical_init_of_a_plain_pid_is_accepted(void)
{
    init_accepts();
    config.setpoint_weight_q8 = 256;
    init_accepts();
}

void test_typical_init_with_a_filter_is_refused(void)
{
    for (uint8_t filter = 1; filter <= 8; filter++) {
        config.gains.derivative_filter = filter;
        init_refuses();
    }
}

void test_typical_init_with_a_setpoint_weight_is_refused(void)
{
    static const uint16_t weights[] = {1, 2, 128, 254, 255, 257, 512, 65535};

    for (unsigned at = 0; at < sizeof weights / sizeof weights[0]; at++) {
        config.setpoint_weight_q8 = weights[at];
        init_refuses();
    }
}

void test_typical_init_with_any_option_is_refused(void)
{
    for (unsigned options = 1; options < 8; options++) {
        config.reverse = (options & 1u) != 0;
        config.derivative_on_error = (options & 2u) != 0;
        config.proportional_on_measurement = (options & 4u) != 0;
        init_refuses();
    }
}

void test_typical_check_names_the_first_field_that_needs_a_feature(void)
{
    config.setpoint_weight_q8 = 255;
    config.reverse = true;
    config.derivative_on_error = true;
    TEST_ASSERT_EQUAL(FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8,
                      fixpid_pid_check(&config));
    config.setpoint_weight_q8 = 0;
    config.proportional_on_measurement = true;
    TEST_ASSERT_EQUAL(FIXPID_PID_BAD_REVERSE, fixpid_pid_check(&config));
    config.reverse = false;
    TEST_ASSERT_EQUAL(FIXPID_PID_BAD_DERIVATIVE_ON_ERROR,
                      fixpid_pid_check(&config));
    config.derivative_on_error = false;
    TEST_ASSERT_EQUAL(FIXPID_PID_BAD_PROPORTIONAL_ON_MEASUREMENT,
                      fixpid_pid_check(&config));
    config.proportional_on_measurement = false;
    TEST_ASSERT_EQUAL(FIXPID_PID_OK, fixpid_pid_check(&config));
    config.gains.derivative_filter = 1;
    TEST_ASSERT_EQUAL(FIXPID_PID_BAD_DERIVATIVE_FILTER,
                      fixpid_pid_check(&config));
}

void test_typical_init_with_ki_above_a_half_is_refused(void)
{
    config.gains.ki_q24 = 8388479;
    init_accepts();
    config.gains.ki_q24 = 8388480;
    init_refuses();
    config.gains.ki_q24 = 0x7FFF0000;
    init_refuses();
}

void test_typical_set_gains_that_need_a_feature_is_refused(void)
{
    struct fixpid_pid_gains gains = {300, 8388479, 200, 0};

    init_accepts();
    TEST_ASSERT_TRUE(fixpid_pid_set_gains(&pid_controller, &gains));
    gains.ki_q24 = 8388480;
    TEST_ASSERT_FALSE(fixpid_pid_set_gains(&pid_controller, &gains));
    gains.ki_q24 = 1000;
    gains.derivative_filter = 1;
    TEST_ASSERT_FALSE(fixpid_pid_set_gains(&pid_controller, &gains));
    // P + I + D of the gains that were taken
    TEST_ASSERT_EQUAL_INT16(67, fixpid_pid_step(&pid_controller, 40, 0));
    TEST_ASSERT_EQUAL_INT32(12000, fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(INT32_C(40) * 32767,
                            fixpid_pid_integral(&pid_controller));
}

// The object held other bits before init, and none of them counts.
static void steps_are_the_references(uint32_t ki_q24)
{
    struct reference_pid reference;

    config.gains.ki_q24 = ki_q24;
    config.output_min = -3000;
    config.output_max = 3000;
    init_accepts();
    TEST_ASSERT_TRUE(reference_pid_init(&reference, &config));
    for (uint32_t step = 0; step < TEST_RANDOM_STEPS; step++) {
        const int16_t setpoint = (int16_t)(numbers_int16() / 16);
        const int16_t measurement = (int16_t)(numbers_int16() / 16);

        TEST_ASSERT_EQUAL_INT16(
            reference_pid_step(&reference, setpoint, measurement),
            fixpid_pid_step(&pid_controller, setpoint, measurement));
        TEST_ASSERT_EQUAL_INT32(reference_pid_integral(&reference),
                                fixpid_pid_integral(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(reference.derivative,
                                fixpid_pid_derivative(&pid_controller));
        TEST_ASSERT_EQUAL_HEX8(reference_pid_flags(&reference),
                               fixpid_pid_flags(&pid_controller));
    }
}

void test_typical_steps_with_either_kind_of_ki_are_the_definitions(void)
{
    numbers_seed(12);
    steps_are_the_references(20001);
    steps_are_the_references(8388479);
}

void test_typical_steps_by_the_error_are_the_definitions(void)
{
    struct reference_pid reference;

    init_accepts();
    TEST_ASSERT_TRUE(reference_pid_init(&reference, &config));
    numbers_seed(13);
    for (uint32_t step = 0; step < TEST_RANDOM_STEPS; step++) {
        const int32_t error = (int32_t)numbers_int16() * 2;
        const int32_t rise = (int32_t)numbers_int16() * 2;

        TEST_ASSERT_EQUAL_INT16(
            reference_pid_step_error(&reference, error, rise),
            fixpid_pid_step_error(&pid_controller, error, rise));
        TEST_ASSERT_EQUAL_INT16(
            reference_pid_step(&reference, 0, (int16_t)error),
            fixpid_pid_step(&pid_controller, 0, (int16_t)error));
        TEST_ASSERT_EQUAL_INT32(reference.derivative,
                                fixpid_pid_derivative(&pid_controller));
    }
}

void test_typical_set_limits_drops_windup_and_keeps_the_rest(void)
{
    struct reference_pid reference;

    init_accepts();
    TEST_ASSERT_TRUE(reference_pid_init(&reference, &config));
    for (int step = 0; step < 300; step++) {
        (void)fixpid_pid_step(&pid_controller, 30, 0);
        (void)reference_pid_step(&reference, 30, 0);
    }
    TEST_ASSERT_TRUE(fixpid_pid_set_limits(&pid_controller, 0, 100));
    TEST_ASSERT_TRUE(reference_pid_set_limits(&reference, 0, 100));
    TEST_ASSERT_EQUAL_INT32(reference_pid_integral(&reference),
                            fixpid_pid_integral(&pid_controller));
    TEST_ASSERT_TRUE(fixpid_pid_set_integral_limits(&pid_controller, -10, 20));
    TEST_ASSERT_TRUE(reference_pid_set_integral_limits(&reference, -10, 20));
    TEST_ASSERT_EQUAL_INT32(reference_pid_integral(&reference),
                            fixpid_pid_integral(&pid_controller));
}

void test_typical_reset_clears_what_no_function_sets(void)
{
    init_accepts();
    (void)fixpid_pid_step(&pid_controller, 100, 0);
    fixpid_pid_reset(&pid_controller);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, fixpid_pid_flags(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 0, 0));
}

// Nor does a state with what only a feature has come back.
void test_typical_restore_goes_on_and_refuses_what_no_function_sets(void)
{
    uint8_t state[FIXPID_PID_STATE_SIZE];
    int16_t next;

    init_accepts();
    (void)fixpid_pid_step(&pid_controller, 100, 0);
    fixpid_pid_state(&pid_controller, state);
    next = fixpid_pid_step(&pid_controller, 100, 70);
    init_accepts();
    TEST_ASSERT_TRUE(fixpid_pid_restore(&pid_controller, state));
    TEST_ASSERT_EQUAL_INT16(next, fixpid_pid_step(&pid_controller, 100, 70));
    state[12] = 1; // the feed-forward
    TEST_ASSERT_FALSE(fixpid_pid_restore(&pid_controller, state));
    state[12] = 0;
    state[13] = 0x80;
    TEST_ASSERT_FALSE(fixpid_pid_restore(&pid_controller, state));
    state[13] = 0;
    state[2] = FIXPID_PID_MANUAL;
    TEST_ASSERT_FALSE(fixpid_pid_restore(&pid_controller, state));
    state[2] = FIXPID_PID_SEEDED;
    TEST_ASSERT_FALSE(fixpid_pid_restore(&pid_controller, state));
    state[2] = FIXPID_PID_AT_MAX;
    TEST_ASSERT_TRUE(fixpid_pid_restore(&pid_controller, state));
}
