// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"
#include "numbers.h"
#include "poison.h"
#include "reference.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("src/an964/fixpid_an964.c")
TEST_SOURCE_FILE("src/an964/fixpid_an964_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif

FIXPID_DATA struct fixpid_an964 an964_controller;
static struct reference_an964 reference;

static void start(uint16_t kp, uint16_t ki, uint16_t kd)
{
    const struct fixpid_an964_gains gains = {kp, ki, kd};

    fixpid_an964_init(&an964_controller, &gains);
    reference = (struct reference_an964){
        .form = reference_an964_10bit(), .kp = kp, .ki = ki, .kd = kd};
}

// One step of both, everything compared.
static int16_t step(int16_t error)
{
    const int64_t expected = reference_an964_step(&reference, error);
    const int16_t output = fixpid_an964_step(&an964_controller, error);

    TEST_ASSERT_EQUAL_INT16(expected, output);
    TEST_ASSERT_EQUAL_INT16(reference.proportional,
                            fixpid_an964_proportional(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(reference.integral,
                            fixpid_an964_integral(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(reference.derivative,
                            fixpid_an964_derivative(&an964_controller));
    TEST_ASSERT_EQUAL_HEX8(
        (reference.sum_limited ? FIXPID_AN964_SUM_LIMITED : 0) |
            (reference.output_limited ? FIXPID_AN964_OUTPUT_LIMITED : 0),
        fixpid_an964_flags(&an964_controller));
    return output;
}

static void steps(unsigned count, int16_t error)
{
    for (unsigned i = 0; i < count; i++) {
        step(error);
    }
}

void setUp(void)
{
    numbers_seed(964);
    start(600, 40, 100);
}

void tearDown(void)
{
}

void test_step_recorded_rows_match_the_firmware(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    int32_t run = -1;
    unsigned rows = 0;

    VECTORS_OPEN(an964_firmware);
    while (vectors_next(row)) {
        if (row[AN964_RUN] != run) {
            run = row[AN964_RUN];
            start((uint16_t)row[AN964_KP], (uint16_t)row[AN964_KI],
                  (uint16_t)row[AN964_KD]);
        }
        TEST_ASSERT_TRUE(fixpid_an964_set_gains(
            &an964_controller, (uint16_t)row[AN964_KP], (uint16_t)row[AN964_KI],
            (uint16_t)row[AN964_KD]));
        TEST_ASSERT_EQUAL_INT16(
            row[AN964_OUT],
            fixpid_an964_step(&an964_controller, (int16_t)row[AN964_ERROR]));
        TEST_ASSERT_EQUAL_INT16(row[AN964_ERROR],
                                fixpid_an964_proportional(&an964_controller));
        TEST_ASSERT_EQUAL_INT16(row[AN964_SUM], an964_controller.sum);
        TEST_ASSERT_EQUAL_INT16(row[AN964_INTEGRAL],
                                fixpid_an964_integral(&an964_controller));
        TEST_ASSERT_EQUAL_INT16(row[AN964_DERIVATIVE],
                                fixpid_an964_derivative(&an964_controller));
        // No row reaches a limit, as docs/migrating.md says.
        TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(2000, rows);
}

// Equation 9: with kp = 1024 / 1024 out of reach, 1023 loses one count.
void test_step_proportional_alone_is_error_times_kp_over_1024(void)
{
    start(512, 0, 0);
    TEST_ASSERT_EQUAL_INT16(50, step(100));
    TEST_ASSERT_EQUAL_INT16(-50, step(-101));
    start(1023, 0, 0);
    TEST_ASSERT_EQUAL_INT16(340, step(341));
}

// The angle limit of the note: 20 degrees are 341 counts of 0.0586 degrees.
void test_step_twenty_degrees_at_full_gain_stays_below_the_output_limit(void)
{
    start(1023, 0, 1023);
    TEST_ASSERT_EQUAL_INT16(INT32_C(461) * 1023 / 1024, step(341));
}

// Figure 6: the difference is clamped to +-120, multiplied, shifted by 5, and
// the term is clamped to +-120 again; both lower clamps work.
void test_step_derivative_of_figure_6_is_clamped_twice_on_both_sides(void)
{
    start(1023, 0, 16);
    step(500);
    TEST_ASSERT_EQUAL_INT16(120 * 16 / 32,
                            fixpid_an964_derivative(&an964_controller));
    steps(3, 500);
    step(-500);
    TEST_ASSERT_EQUAL_INT16(-120 * 16 / 32,
                            fixpid_an964_derivative(&an964_controller));
    start(1023, 0, 33);
    step(500);
    TEST_ASSERT_EQUAL_INT16(120, fixpid_an964_derivative(&an964_controller));
    start(1023, 0, 33);
    step(-500);
    TEST_ASSERT_EQUAL_INT16(-120, fixpid_an964_derivative(&an964_controller));
    start(1023, 0, 1);
    step(-119);
    TEST_ASSERT_EQUAL_INT16(-4, fixpid_an964_derivative(&an964_controller));
}

void test_step_derivative_is_rounded_down_and_integral_toward_zero(void)
{
    start(1023, 0, 1);
    step(-1);
    TEST_ASSERT_EQUAL_INT16(-1, fixpid_an964_derivative(&an964_controller));
    start(1023, 0, 1);
    step(31);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_derivative(&an964_controller));
    start(1023, 15, 0);
    step(-511);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_integral(&an964_controller));
    step(-1);
    TEST_ASSERT_EQUAL_INT16(-1, fixpid_an964_integral(&an964_controller));
}

// Equation 8: the difference is taken over three steps.
void test_step_derivative_looks_back_three_steps(void)
{
    start(1023, 0, 32);
    step(10);
    step(25);
    step(45);
    TEST_ASSERT_EQUAL_INT16(45, fixpid_an964_derivative(&an964_controller));
    step(70);
    TEST_ASSERT_EQUAL_INT16(60, fixpid_an964_derivative(&an964_controller));
    step(70);
    TEST_ASSERT_EQUAL_INT16(45, fixpid_an964_derivative(&an964_controller));
}

void test_step_sum_is_clamped_at_both_ends(void)
{
    start(1, 16, 0);
    steps(29, 1023);
    TEST_ASSERT_EQUAL_INT16(29667, an964_controller.sum);
    step(333);
    TEST_ASSERT_EQUAL_INT16(30000, an964_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    step(1);
    TEST_ASSERT_EQUAL_INT16(30000, an964_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_SUM_LIMITED,
                           fixpid_an964_flags(&an964_controller));
    start(1, 16, 0);
    steps(29, -1023);
    step(-332);
    TEST_ASSERT_EQUAL_INT16(-29999, an964_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    step(-1);
    TEST_ASSERT_EQUAL_INT16(-29999, an964_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_SUM_LIMITED,
                           fixpid_an964_flags(&an964_controller));
    steps(2, -1023);
    TEST_ASSERT_EQUAL_INT16(-29999, an964_controller.sum);
}

void test_step_output_is_clamped_at_both_ends(void)
{
    start(1023, 0, 0);
    TEST_ASSERT_EQUAL_INT16(1000, step(1001));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(1000, step(1002));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_OUTPUT_LIMITED,
                           fixpid_an964_flags(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(-1000, step(-1001));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(-1000, step(-1002));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_OUTPUT_LIMITED,
                           fixpid_an964_flags(&an964_controller));
}

void test_flags_sum_and_output_limited_at_once_are_both_set(void)
{
    start(1023, 1023, 0);
    steps(40, 1023);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_SUM_LIMITED |
                               FIXPID_AN964_OUTPUT_LIMITED,
                           fixpid_an964_flags(&an964_controller));
}

void test_flags_sum_limited_lasts_until_a_step_within_or_a_reset(void)
{
    start(1, 1023, 0);
    steps(40, 1023);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_SUM_LIMITED,
                           fixpid_an964_flags(&an964_controller));
    fixpid_an964_reset(&an964_controller);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    start(1, 1023, 0);
    steps(40, 1023);
    step(-5);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
}

// docs/migrating.md: the program keeps the error in a signed char.
void test_step_error_beyond_a_byte_does_not_wrap(void)
{
    start(1023, 0, 0);
    TEST_ASSERT_EQUAL_INT16(179, step(180));
    TEST_ASSERT_EQUAL_INT16(-179, step(-180));
}

// docs/migrating.md: 117 * 281 and 120 * 274 do not fit the program's 16 bits.
void test_step_products_beyond_16_bits_are_exact(void)
{
    start(16, 281, 0);
    steps(40, 1023);
    TEST_ASSERT_EQUAL_INT16(INT32_C(117) * 281 / 16,
                            fixpid_an964_integral(&an964_controller));
    start(16, 1023, 0);
    steps(40, -1023);
    TEST_ASSERT_EQUAL_INT16(-7480, fixpid_an964_integral(&an964_controller));
    start(16, 0, 274);
    step(120);
    TEST_ASSERT_EQUAL_INT16(120, fixpid_an964_derivative(&an964_controller));
    start(16, 0, 1023);
    step(-120);
    TEST_ASSERT_EQUAL_INT16(-120, fixpid_an964_derivative(&an964_controller));
}

void test_step_error_of_any_size_is_limited_to_ten_bits(void)
{
    start(512, 0, 0);
    TEST_ASSERT_EQUAL_INT16(511, step(INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(1023, fixpid_an964_proportional(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(-511, step(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(-1023,
                            fixpid_an964_proportional(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(-511, step(-1024));
    TEST_ASSERT_EQUAL_INT16(-511, step(-1022));
}

// kp multiplies all terms: halving the supply and doubling kp cancel.
void test_set_gains_kp_on_the_fly_scales_the_output_without_a_transient(void)
{
    int16_t before;

    start(400, 160, 100);
    steps(8, 100);
    before = step(100);
    TEST_ASSERT_TRUE(fixpid_an964_set_gains(&an964_controller, 800, 160, 100));
    reference.kp = 800;
    TEST_ASSERT_INT16_WITHIN(2, 2 * before, step(100));
}

void test_step_nasty_errors_crossed_match_the_reference(void)
{
    static const uint16_t gains[] = {0, 1, 31, 280, 512, 1022, 1023};

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            start(gains[i % 7], gains[j % 7], gains[(i + j) % 7]);
            step(nasty[i]);
            step(nasty[j]);
            step(nasty[i]);
            step(nasty[j]);
            step(nasty[j]);
        }
    }
}

void test_step_random_runs_match_the_reference(void)
{
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        if (numbers_below(300) == 0) {
            start((uint16_t)numbers_below(1024), (uint16_t)numbers_below(1024),
                  (uint16_t)numbers_below(1024));
        }
        step((i / 1000) % 2 != 0 ? numbers_int16()
                                 : (int16_t)(numbers_int16() / 64));
    }
}

void test_set_gains_at_every_step_matches_the_reference(void)
{
    for (unsigned i = 0; i < 2000; i++) {
        const uint16_t kp = (uint16_t)numbers_below(1024);
        const uint16_t ki = (uint16_t)numbers_below(1024);
        const uint16_t kd = (uint16_t)numbers_below(1024);

        TEST_ASSERT_TRUE(fixpid_an964_set_gains(&an964_controller, kp, ki, kd));
        reference.kp = kp;
        reference.ki = ki;
        reference.kd = kd;
        step((int16_t)(numbers_int16() / 32));
    }
}

void test_set_gains_one_beyond_is_refused_and_changes_nothing(void)
{
    TEST_ASSERT_FALSE(fixpid_an964_set_gains(&an964_controller, 1024, 1, 1));
    TEST_ASSERT_FALSE(fixpid_an964_set_gains(&an964_controller, 1, 1024, 1));
    TEST_ASSERT_FALSE(fixpid_an964_set_gains(&an964_controller, 1, 1, 1024));
    TEST_ASSERT_FALSE(
        fixpid_an964_set_gains(&an964_controller, 65535, 65535, 65535));
    steps(30, 700);
    TEST_ASSERT_TRUE(
        fixpid_an964_set_gains(&an964_controller, 1023, 1023, 1023));
    TEST_ASSERT_TRUE(fixpid_an964_set_gains(&an964_controller, 0, 0, 0));
}

static void assert_refused(void)
{
    for (int i = 0; i < 90; i++) {
        TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_step(&an964_controller, 1023));
        TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_integral(&an964_controller));
        TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_derivative(&an964_controller));
    }
    TEST_ASSERT_FALSE(fixpid_an964_set_gains(&an964_controller, 600, 40, 100));
    fixpid_an964_reset(&an964_controller);
    TEST_ASSERT_FALSE(fixpid_an964_set_gains(&an964_controller, 600, 40, 100));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_step(&an964_controller, 1000));
    start(600, 40, 100);
    steps(10, 77);
}

void test_init_each_gain_one_beyond_is_refused(void)
{
    static const struct fixpid_an964_gains bad[] = {
        {1024, 0, 0}, {0, 1024, 0}, {0, 0, 1024}, {65535, 65535, 65535}};

    for (unsigned i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        start(1023, 1023, 1023);
        TEST_ASSERT_FALSE(fixpid_an964_init(&an964_controller, &bad[i]));
        assert_refused();
    }
}

void test_init_each_gain_at_its_limits_is_accepted(void)
{
    static const struct fixpid_an964_gains good[] = {{0, 0, 0},
                                                     {1023, 0, 0},
                                                     {0, 1023, 0},
                                                     {0, 0, 1023},
                                                     {1023, 1023, 1023}};

    for (unsigned i = 0; i < sizeof good / sizeof good[0]; i++) {
        TEST_ASSERT_TRUE(fixpid_an964_init(&an964_controller, &good[i]));
    }
}

void test_step_all_zero_object_outputs_zero(void)
{
    static const struct fixpid_an964 nothing;

    an964_controller = nothing;
    assert_refused();
}

void test_reset_clears_the_state_and_keeps_the_gains(void)
{
    start(1023, 1023, 1023);
    steps(2, 1023);
    TEST_ASSERT_NOT_EQUAL(0, fixpid_an964_derivative(&an964_controller));
    TEST_ASSERT_NOT_EQUAL(0, fixpid_an964_flags(&an964_controller));
    fixpid_an964_reset(&an964_controller);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_proportional(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_integral(&an964_controller));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_derivative(&an964_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_flags(&an964_controller));
    reference = (struct reference_an964){
        .form = reference_an964_10bit(), .kp = 1023, .ki = 1023, .kd = 1023};
    steps(5, 321);
}

void test_init_starts_from_rest(void)
{
    steps(40, 1000);
    start(1023, 1023, 1023);
    steps(5, -3);
}

// ---- Memory ----

static void init_good(void)
{
    static const struct fixpid_an964_gains good = {600, 40, 100};

    (void)fixpid_an964_init(&an964_controller, &good);
}

static void init_bad(void)
{
    static const struct fixpid_an964_gains bad = {600, 40, 1024};

    (void)fixpid_an964_init(&an964_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_an964, ready);

    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&an964_controller, sizeof(an964_controller), init_good));
    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&an964_controller, sizeof(an964_controller), init_bad));
}

// Nothing undefined comes of it either, which the sanitizers see.
void test_step_of_any_bytes_stays_within_its_limits(void)
{
    numbers_seed(964);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        numbers_fill(&an964_controller, sizeof(an964_controller));
        TEST_ASSERT_INT16_WITHIN(
            FIXPID_AN964_OUTPUT_LIMIT, 0,
            fixpid_an964_step(&an964_controller, numbers_int16()));
    }
}
