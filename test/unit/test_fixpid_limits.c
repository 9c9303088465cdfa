// SPDX-License-Identifier: MIT
// The AN964 forms with whatever limits they were compiled with: tools/test runs
// this with every knob at both ends of its range.
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "numbers.h"
#include "reference.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an964/fixpid_an964.c")
TEST_SOURCE_FILE("src/an964/fixpid_an964_more.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif

FIXPID_DATA struct fixpid_an964 an964_controller;
FIXPID_DATA struct fixpid_an964_8bit an964_8bit_controller;
static struct reference_an964 reference;

void setUp(void)
{
    numbers_seed(1);
}

void tearDown(void)
{
}

static void start_10bit(uint16_t kp, uint16_t ki, uint16_t kd)
{
    const struct fixpid_an964_gains gains = {kp, ki, kd};

    fixpid_an964_init(&an964_controller, &gains);
    reference = (struct reference_an964){
        .form = reference_an964_10bit(), .kp = kp, .ki = ki, .kd = kd};
}

static int16_t step_10bit(int16_t error)
{
    const int64_t expected = reference_an964_step(&reference, error);
    const int16_t output = fixpid_an964_step(&an964_controller, error);

    TEST_ASSERT_EQUAL_INT16(expected, output);
    TEST_ASSERT_EQUAL_INT16(reference.integral,
                            fixpid_an964_integral(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(reference.derivative,
                            fixpid_an964_derivative(&an964_controller));
    return output;
}

static void start_8bit(uint8_t kp, uint8_t ki, uint8_t kd)
{
    const struct fixpid_an964_8bit_gains gains = {kp, ki, kd};

    fixpid_an964_8bit_init(&an964_8bit_controller, &gains);
    reference = (struct reference_an964){
        .form = reference_an964_8bit(), .kp = kp, .ki = ki, .kd = kd};
}

static void step_8bit(int8_t error)
{
    const int64_t expected = reference_an964_step(&reference, error);

    TEST_ASSERT_EQUAL_INT16(
        expected, fixpid_an964_8bit_step(&an964_8bit_controller, error));
    TEST_ASSERT_EQUAL_INT16(reference.integral,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(reference.derivative, fixpid_an964_8bit_derivative(
                                                      &an964_8bit_controller));
}

void test_an964_step_reaches_and_keeps_every_limit_on_both_sides(void)
{
    start_10bit(1023, 1023, 1023);
    for (int i = 0; i < 60; i++) {
        step_10bit(1023);
    }
    TEST_ASSERT_EQUAL_INT16(FIXPID_AN964_SUM_LIMIT, an964_controller.sum);
    TEST_ASSERT_EQUAL_INT16(FIXPID_AN964_OUTPUT_LIMIT, step_10bit(1023));
    start_10bit(1023, 1023, 1023);
    step_10bit(1023);
    TEST_ASSERT_EQUAL_INT16(FIXPID_AN964_TERM_LIMIT,
                            fixpid_an964_derivative(&an964_controller));
    start_10bit(1023, 1023, 1023);
    step_10bit(-1023);
    TEST_ASSERT_EQUAL_INT16(-FIXPID_AN964_TERM_LIMIT,
                            fixpid_an964_derivative(&an964_controller));
    for (int i = 0; i < 60; i++) {
        step_10bit(-1023);
    }
    TEST_ASSERT_EQUAL_INT16(1 - FIXPID_AN964_SUM_LIMIT, an964_controller.sum);
    TEST_ASSERT_EQUAL_INT16(-FIXPID_AN964_OUTPUT_LIMIT, step_10bit(-1023));
}

void test_an964_step_random_runs_match_the_reference(void)
{
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 10; i++) {
        if (numbers_below(100) == 0) {
            start_10bit((uint16_t)numbers_below(1024),
                        (uint16_t)numbers_below(1024),
                        (uint16_t)(numbers_below(1024) >> (i % 10)));
        }
        step_10bit((int16_t)(numbers_int16() / (1 << (i / 1000 % 12))));
    }
}

void test_an964_8bit_step_reaches_and_keeps_every_limit_on_both_sides(void)
{
    start_8bit(127, 127, 127);
    step_8bit(127);
    TEST_ASSERT_EQUAL_INT16(
        FIXPID_AN964_8BIT_TERM_LIMIT,
        fixpid_an964_8bit_derivative(&an964_8bit_controller));
    for (int i = 0; i < 80; i++) {
        step_8bit(127);
    }
    TEST_ASSERT_EQUAL_INT16(FIXPID_AN964_8BIT_SUM_LIMIT,
                            an964_8bit_controller.sum);
    start_8bit(127, 127, 127);
    step_8bit(-128);
    TEST_ASSERT_EQUAL_INT16(
        -FIXPID_AN964_8BIT_TERM_LIMIT,
        fixpid_an964_8bit_derivative(&an964_8bit_controller));
    for (int i = 0; i < 80; i++) {
        step_8bit(-128);
    }
    TEST_ASSERT_EQUAL_INT16(-FIXPID_AN964_8BIT_SUM_LIMIT,
                            an964_8bit_controller.sum);
}

void test_an964_8bit_step_random_runs_match_the_reference(void)
{
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 10; i++) {
        if (numbers_below(100) == 0) {
            start_8bit((uint8_t)numbers_below(128), (uint8_t)numbers_below(128),
                       (uint8_t)(numbers_below(128) >> (i % 7)));
        }
        step_8bit((int8_t)((int32_t)numbers_below(256) - 128));
    }
}
