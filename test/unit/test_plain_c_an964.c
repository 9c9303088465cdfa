// SPDX-License-Identifier: MIT
// The straightforward forms that tools/cost measures beside the library give
// its answers.
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "numbers.h"
#include "plain_c_an964.h"
#include "plain_c_an964_8bit.h"
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

void setUp(void)
{
    numbers_seed(964);
}

void tearDown(void)
{
}

// Errors of every size; some gains at their ends.
static uint16_t any_gain(uint16_t most)
{
    const uint32_t kind = numbers_below(8);

    if (kind == 0u) {
        return 0;
    }
    return kind == 1u ? most : (uint16_t)numbers_below(most + 1u);
}

void test_plain_c_an964_step_gives_the_library_s_answers(void)
{
    struct plain_c_an964 plain = {.sum = 0};

    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        const int16_t error =
            (int16_t)(numbers_int16() / (1 << (i / 1000 % 12)));

        if (i % 200 == 0u) {
            const struct fixpid_an964_gains gains = {
                any_gain(1023), any_gain(1023), any_gain(1023)};

            TEST_ASSERT_TRUE(fixpid_an964_init(&an964_controller, &gains));
            plain = (struct plain_c_an964){.gains = gains};
        }
        TEST_ASSERT_EQUAL_INT32(fixpid_an964_step(&an964_controller, error),
                                plain_c_an964_step(&plain, error));
        TEST_ASSERT_EQUAL_INT16(fixpid_an964_integral(&an964_controller),
                                plain.integral);
        TEST_ASSERT_EQUAL_INT16(fixpid_an964_derivative(&an964_controller),
                                plain.derivative);
        TEST_ASSERT_EQUAL_HEX8(fixpid_an964_flags(&an964_controller),
                               plain.flags);
    }
}

void test_plain_c_an964_8bit_step_gives_the_library_s_answers(void)
{
    struct plain_c_an964_8bit plain = {.sum = 0};

    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        const int8_t error = (int8_t)(((int16_t)numbers_below(256) - 128) /
                                      (1 << (i / 1000 % 7)));

        if (i % 200 == 0u) {
            const struct fixpid_an964_8bit_gains gains = {
                (uint8_t)any_gain(127), (uint8_t)any_gain(127),
                (uint8_t)any_gain(127)};

            TEST_ASSERT_TRUE(
                fixpid_an964_8bit_init(&an964_8bit_controller, &gains));
            plain = (struct plain_c_an964_8bit){.gains = gains};
        }
        TEST_ASSERT_EQUAL_INT32(
            fixpid_an964_8bit_step(&an964_8bit_controller, error),
            plain_c_an964_8bit_step(&plain, error));
        TEST_ASSERT_EQUAL_INT16(
            fixpid_an964_8bit_integral(&an964_8bit_controller), plain.integral);
        TEST_ASSERT_EQUAL_INT16(
            fixpid_an964_8bit_derivative(&an964_8bit_controller),
            plain.derivative);
        TEST_ASSERT_EQUAL_HEX8(fixpid_an964_8bit_flags(&an964_8bit_controller),
                               plain.flags);
    }
}
