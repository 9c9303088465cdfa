// SPDX-License-Identifier: MIT
// Several controllers side by side: pointer mode only. What has no object mode
// is tried in its own test.
#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_autotune.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_reaction.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_pid.h"
#include "reference.h"
#include "reference_control.h"
#include "reference_pid.h"
#include "reference_reaction.h"
#include "unity.h"

TEST_SOURCE_FILE("test/support/numbers_guard.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937_more.c")
TEST_SOURCE_FILE("src/an964/fixpid_an964.c")
TEST_SOURCE_FILE("src/an964/fixpid_an964_more.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_error.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_block.c")

#define COUNT 5

void setUp(void)
{
    numbers_seed(5);
}

void tearDown(void)
{
}

void test_an937_several_instances_keep_their_own_state(void)
{
    struct fixpid_an937 controllers[COUNT];
    struct reference_an937 references[COUNT];

    for (unsigned i = 0; i < COUNT; i++) {
        const struct fixpid_an937_config config = {
            (uint8_t)(40 * i), (uint8_t)(50 * i), (uint8_t)(60 * i),
            (uint16_t)(1000 * (i + 1)), (uint8_t)(i + 1)};

        TEST_ASSERT_TRUE(fixpid_an937_init(&controllers[i], &config));
        reference_an937_init(&references[i], config.kp_q4, config.ki_q4,
                             config.kd_q4, config.accumulated_error_limit,
                             config.derivative_period_ticks);
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(COUNT);
        const int16_t error = numbers_int16();

        fixpid_an937_tick(&controllers[i]);
        reference_an937_tick(&references[i]);
        TEST_ASSERT_EQUAL_INT32(reference_an937_step(&references[i], error),
                                fixpid_an937_step(&controllers[i], error));
    }
}

void test_an964_several_instances_keep_their_own_state(void)
{
    struct fixpid_an964 controllers[COUNT];
    struct reference_an964 references[COUNT];

    for (unsigned i = 0; i < COUNT; i++) {
        const struct fixpid_an964_gains gains = {
            (uint16_t)(200 * i), (uint16_t)(100 * i), (uint16_t)(250 * i)};

        TEST_ASSERT_TRUE(fixpid_an964_init(&controllers[i], &gains));
        references[i] =
            (struct reference_an964){.form = reference_an964_10bit(),
                                     .kp = gains.kp,
                                     .ki = gains.ki,
                                     .kd = gains.kd};
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(COUNT);
        const int16_t error = (int16_t)(numbers_int16() / 32);

        TEST_ASSERT_EQUAL_INT16(reference_an964_step(&references[i], error),
                                fixpid_an964_step(&controllers[i], error));
    }
}

void test_an964_8bit_several_instances_keep_their_own_state(void)
{
    struct fixpid_an964_8bit controllers[COUNT];
    struct reference_an964 references[COUNT];

    for (unsigned i = 0; i < COUNT; i++) {
        const struct fixpid_an964_8bit_gains gains = {
            (uint8_t)(25 * i), (uint8_t)(12 * i), (uint8_t)(31 * i)};

        TEST_ASSERT_TRUE(fixpid_an964_8bit_init(&controllers[i], &gains));
        references[i] = (struct reference_an964){.form = reference_an964_8bit(),
                                                 .kp = gains.kp,
                                                 .ki = gains.ki,
                                                 .kd = gains.kd};
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(COUNT);
        const int8_t error = (int8_t)((int32_t)numbers_below(256) - 128);

        TEST_ASSERT_EQUAL_INT16(reference_an964_step(&references[i], error),
                                fixpid_an964_8bit_step(&controllers[i], error));
    }
}

void test_pid_several_instances_keep_their_own_state(void)
{
    struct fixpid_pid controllers[COUNT];
    struct reference_pid references[COUNT];
    int16_t setpoint = 0;
    int16_t measurement;

    for (unsigned i = 0; i < COUNT; i++) {
        struct fixpid_pid_config config;

        numbers_pid_config(&config);
        TEST_ASSERT_EQUAL(reference_pid_init(&references[i], &config),
                          fixpid_pid_init(&controllers[i], &config));
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(COUNT);

        numbers_pid_inputs(&setpoint, &measurement);
        TEST_ASSERT_EQUAL_INT16(
            reference_pid_step(&references[i], setpoint, measurement),
            fixpid_pid_step(&controllers[i], setpoint, measurement));
        TEST_ASSERT_EQUAL_INT16(
            reference_pid_step_error(&references[i], measurement, n),
            fixpid_pid_step_error(&controllers[i], measurement, (int32_t)n));
        if (numbers_below(2) == 0) {
            const int16_t applied = numbers_int16();

            reference_pid_track(&references[i], applied, 3);
            fixpid_pid_track(&controllers[i], applied, 3);
            TEST_ASSERT_EQUAL_INT16(references[i].output,
                                    fixpid_pid_output(&controllers[i]));
        }
    }
}

// A slow experiment and a fast one, step by step in turn. Then each gets the
// other's record.
void test_autotune_several_instances_keep_their_own_state(void)
{
    static const uint16_t half_steps[2] = {30, 10};
    struct fixpid_autotune experiments[2];
    struct fixpid_autotune_record records[2];
    struct fixpid_autotune_stage stage;

    for (unsigned i = 0; i < 2; i++) {
        const struct fixpid_autotune_config config = {
            -300, 300, 0, INT16_MIN, INT16_MAX, 75, 1000, 1, false};

        TEST_ASSERT_TRUE(fixpid_autotune_init(&experiments[i], &config));
    }
    for (unsigned n = 0; n < 700; n++) {
        for (unsigned i = 0; i < 2; i++) {
            const bool low = n / half_steps[i] % 2u == 0u;

            fixpid_autotune_step(&experiments[i], 0,
                                 n < 34 ? 0 : (int16_t)(low ? -50 : 50));
        }
    }
    for (unsigned i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE,
                                fixpid_autotune_status(&experiments[i]));
        fixpid_autotune_progress(&experiments[i], &stage);
        TEST_ASSERT_EQUAL_UINT16(2u * half_steps[i], stage.period);
        TEST_ASSERT_TRUE(fixpid_autotune_pack(&experiments[i], &records[i]));
    }
    for (unsigned i = 0; i < 2; i++) {
        TEST_ASSERT_TRUE(
            fixpid_autotune_unpack(&experiments[i], &records[1u - i]));
        fixpid_autotune_progress(&experiments[i], &stage);
        TEST_ASSERT_EQUAL_UINT16(2u * half_steps[1u - i], stage.period);
    }
}

void test_guard_several_instances_keep_their_own_state(void)
{
    struct fixpid_guard guards[COUNT];
    struct reference_guard references[COUNT];
    struct fixpid_guard_config configs[COUNT];
    struct numbers_guard now[COUNT] = {{0, 0, 0}};

    for (unsigned i = 0; i < COUNT; i++) {
        do {
            numbers_guard_config(&configs[i]);
        } while (!reference_guard_init(&references[i], &configs[i]));
        TEST_ASSERT_TRUE(fixpid_guard_init(&guards[i], &configs[i]));
    }
    for (unsigned n = 0; n < 5000; n++) {
        const uint32_t i = numbers_below(COUNT);

        numbers_guard_move(&now[i], &configs[i]);
        TEST_ASSERT_EQUAL_HEX8(
            reference_guard_step(&references[i], now[i].setpoint,
                                 now[i].measurement, now[i].output),
            fixpid_guard_step(&guards[i], now[i].setpoint, now[i].measurement,
                              now[i].output));
    }
}

void test_reaction_several_instances_keep_their_own_state(void)
{
    struct fixpid_reaction reactions[COUNT];
    struct reference_reaction references[COUNT];

    for (int i = 0; i < COUNT; i++) {
        const struct fixpid_reaction_config config = {
            .output_drive = (int16_t)(100 * (i + 1)), .measurement_stop = 9999};

        TEST_ASSERT_TRUE(fixpid_reaction_init(&reactions[i], &config));
        TEST_ASSERT_TRUE(reference_reaction_init(&references[i], &config));
    }
    for (int at = 0; at < 100; at++) {
        for (int i = 0; i < COUNT; i++) {
            const int16_t y = (int16_t)(at < 40 ? 0 : (at - 40) * (i + 5));

            TEST_ASSERT_EQUAL_INT16(reference_reaction_step(&references[i], y),
                                    fixpid_reaction_step(&reactions[i], y));
        }
    }
}
