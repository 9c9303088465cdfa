// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"
#include "numbers.h"
#include "poison.h"
#include "reference.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif
#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 walks a whole domain
#endif

FIXPID_DATA struct fixpid_an964_8bit an964_8bit_controller;
static struct reference_an964 reference;

static void start(uint8_t kp, uint8_t ki, uint8_t kd)
{
    const struct fixpid_an964_8bit_gains gains = {kp, ki, kd};

    fixpid_an964_8bit_init(&an964_8bit_controller, &gains);
    reference = (struct reference_an964){
        .form = reference_an964_8bit(), .kp = kp, .ki = ki, .kd = kd};
}

// One step of both, everything compared.
static int16_t step(int8_t error)
{
    const int64_t expected = reference_an964_step(&reference, error);
    const int16_t output =
        fixpid_an964_8bit_step(&an964_8bit_controller, error);

    TEST_ASSERT_EQUAL_INT16(expected, output);
    TEST_ASSERT_EQUAL_INT16(
        reference.proportional,
        fixpid_an964_8bit_proportional(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(reference.integral,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(reference.derivative, fixpid_an964_8bit_derivative(
                                                      &an964_8bit_controller));
    TEST_ASSERT_EQUAL_HEX8(
        (reference.sum_limited ? FIXPID_AN964_8BIT_SUM_LIMITED : 0) |
            (reference.output_limited ? FIXPID_AN964_8BIT_OUTPUT_LIMITED : 0),
        fixpid_an964_8bit_flags(&an964_8bit_controller));
    return output;
}

static void steps(unsigned count, int8_t error)
{
    for (unsigned i = 0; i < count; i++) {
        step(error);
    }
}

void setUp(void)
{
    numbers_seed(8);
    start(75, 5, 12);
}

void tearDown(void)
{
}

void test_step_sum_of_terms_times_kp_whole_domain(void)
{
    for (unsigned kp = 0; kp <= 127; kp += TEST_STRIDE) {
        start((uint8_t)kp, 0, 0);
        for (int error = -128; error <= 127; error++) {
            step((int8_t)error);
        }
    }
}

void test_step_integral_whole_domain(void)
{
    for (unsigned ki = 0; ki <= 127; ki += TEST_STRIDE) {
        start(32, (uint8_t)ki, 0);
        for (int sum = -FIXPID_AN964_8BIT_SUM_LIMIT;
             sum <= FIXPID_AN964_8BIT_SUM_LIMIT; sum += TEST_STRIDE) {
            an964_8bit_controller.sum = (uint16_t)sum;
            reference.sum = sum;
            step(0);
        }
    }
}

void test_step_derivative_whole_domain(void)
{
    for (unsigned kd = 0; kd <= 127; kd += TEST_STRIDE) {
        start(32, 0, (uint8_t)kd);
        for (int change = -255; change <= 255; change++) {
            const int8_t oldest = (int8_t)(change < 0 ? 127 : -128);
            an964_8bit_controller.error[2] = (uint8_t)oldest;
            reference.history[2] = oldest;
            step((int8_t)(oldest + change));
        }
    }
}

// The note's assembly program: 8 x 8 products, so S and I stop at 127.
void test_step_output_at_full_gain_is_504_duty_counts(void)
{
    start(127, 0, 0);
    TEST_ASSERT_EQUAL_INT16(504, step(127));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(-504, step(-128));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_8BIT_OUTPUT_LIMITED,
                           fixpid_an964_8bit_flags(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(-504, step(-127));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
}

void test_step_integral_is_limited_to_a_byte_on_both_sides(void)
{
    start(32, 127, 0);
    steps(60, 127);
    TEST_ASSERT_EQUAL_INT16(127,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
    start(32, 127, 0);
    steps(60, -128);
    TEST_ASSERT_EQUAL_INT16(-127,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
}

void test_step_sum_is_clamped_at_both_ends(void)
{
    start(1, 8, 0);
    steps(59, 127);
    step(7);
    TEST_ASSERT_EQUAL_INT16(7500, an964_8bit_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    step(1);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_8BIT_SUM_LIMITED,
                           fixpid_an964_8bit_flags(&an964_8bit_controller));
    start(1, 8, 0);
    steps(59, -127);
    step(-7);
    TEST_ASSERT_EQUAL_INT16(-7500, an964_8bit_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    step(-1);
    TEST_ASSERT_EQUAL_INT16(-7500, an964_8bit_controller.sum);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_8BIT_SUM_LIMITED,
                           fixpid_an964_8bit_flags(&an964_8bit_controller));
}

void test_flags_sum_and_output_limited_at_once_are_both_set(void)
{
    start(127, 127, 0);
    steps(90, 127);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_8BIT_SUM_LIMITED |
                               FIXPID_AN964_8BIT_OUTPUT_LIMITED,
                           fixpid_an964_8bit_flags(&an964_8bit_controller));
}

void test_step_derivative_is_rounded_down_and_integral_toward_zero(void)
{
    start(32, 1, 1);
    step(-1);
    TEST_ASSERT_EQUAL_INT16(
        -1, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(0,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
    start(32, 1, 1);
    step(3);
    TEST_ASSERT_EQUAL_INT16(
        0, fixpid_an964_8bit_derivative(&an964_8bit_controller));
}

void test_step_derivative_is_clamped_twice_on_both_sides(void)
{
    start(32, 0, 2);
    step(100);
    TEST_ASSERT_EQUAL_INT16(
        15, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    start(32, 0, 2);
    step(-100);
    TEST_ASSERT_EQUAL_INT16(
        -15, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    start(32, 0, 5);
    step(100);
    TEST_ASSERT_EQUAL_INT16(
        30, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    start(32, 0, 5);
    step(-100);
    TEST_ASSERT_EQUAL_INT16(
        -30, fixpid_an964_8bit_derivative(&an964_8bit_controller));
}

void test_step_derivative_looks_back_three_steps(void)
{
    start(32, 0, 4);
    step(3);
    step(8);
    step(14);
    TEST_ASSERT_EQUAL_INT16(
        14, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    step(21);
    TEST_ASSERT_EQUAL_INT16(
        18, fixpid_an964_8bit_derivative(&an964_8bit_controller));
}

void test_step_all_errors_crossed_match_the_reference(void)
{
    for (int first = -128; first <= 127; first += TEST_STRIDE) {
        for (int second = -128; second <= 127; second += TEST_STRIDE) {
            start((uint8_t)(first & 127), (uint8_t)(second & 127),
                  (uint8_t)((first + second) & 127));
            step((int8_t)first);
            step((int8_t)second);
            step((int8_t)first);
            step((int8_t)second);
        }
    }
}

void test_step_random_runs_match_the_reference(void)
{
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        if (numbers_below(300) == 0) {
            start((uint8_t)numbers_below(128), (uint8_t)numbers_below(128),
                  (uint8_t)numbers_below(128));
        }
        step((int8_t)((int32_t)numbers_below(256) - 128));
    }
}

void test_flags_sum_limited_lasts_until_a_step_within_or_a_reset(void)
{
    start(1, 0, 0);
    steps(90, 127);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN964_8BIT_SUM_LIMITED,
                           fixpid_an964_8bit_flags(&an964_8bit_controller));
    fixpid_an964_8bit_reset(&an964_8bit_controller);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    start(1, 0, 0);
    steps(90, 127);
    step(-5);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
}

void test_set_gains_at_every_step_matches_the_reference(void)
{
    for (unsigned i = 0; i < 2000; i++) {
        const uint8_t kp = (uint8_t)numbers_below(128);
        const uint8_t ki = (uint8_t)numbers_below(128);
        const uint8_t kd = (uint8_t)numbers_below(128);

        TEST_ASSERT_TRUE(
            fixpid_an964_8bit_set_gains(&an964_8bit_controller, kp, ki, kd));
        reference.kp = kp;
        reference.ki = ki;
        reference.kd = kd;
        step((int8_t)((int32_t)numbers_below(256) - 128));
    }
}

void test_set_gains_one_beyond_is_refused_and_changes_nothing(void)
{
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 128, 1, 1));
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 1, 128, 1));
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 1, 1, 128));
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 255, 255, 255));
    steps(30, 90);
    TEST_ASSERT_TRUE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 127, 127, 127));
    TEST_ASSERT_TRUE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 0, 0, 0));
}

static void assert_refused(void)
{
    for (int i = 0; i < 90; i++) {
        TEST_ASSERT_EQUAL_INT16(
            0, fixpid_an964_8bit_step(&an964_8bit_controller, 127));
        TEST_ASSERT_EQUAL_INT16(
            0, fixpid_an964_8bit_integral(&an964_8bit_controller));
        TEST_ASSERT_EQUAL_INT16(
            0, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    }
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 75, 5, 12));
    fixpid_an964_8bit_reset(&an964_8bit_controller);
    TEST_ASSERT_FALSE(
        fixpid_an964_8bit_set_gains(&an964_8bit_controller, 75, 5, 12));
    TEST_ASSERT_EQUAL_INT16(
        0, fixpid_an964_8bit_step(&an964_8bit_controller, 100));
    start(75, 5, 12);
    steps(10, 77);
}

void test_init_each_gain_one_beyond_is_refused(void)
{
    static const struct fixpid_an964_8bit_gains bad[] = {
        {128, 0, 0}, {0, 128, 0}, {0, 0, 128}, {255, 255, 255}};

    for (unsigned i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        TEST_ASSERT_FALSE(
            fixpid_an964_8bit_init(&an964_8bit_controller, &bad[i]));
        assert_refused();
    }
}

void test_init_each_gain_at_its_limits_is_accepted(void)
{
    static const struct fixpid_an964_8bit_gains good[] = {
        {0, 0, 0}, {127, 0, 0}, {0, 127, 0}, {0, 0, 127}, {127, 127, 127}};

    for (unsigned i = 0; i < sizeof good / sizeof good[0]; i++) {
        TEST_ASSERT_TRUE(
            fixpid_an964_8bit_init(&an964_8bit_controller, &good[i]));
    }
}

void test_step_all_zero_object_outputs_zero(void)
{
    static const struct fixpid_an964_8bit nothing;

    an964_8bit_controller = nothing;
    assert_refused();
}

void test_reset_clears_the_state_and_keeps_the_gains(void)
{
    start(127, 127, 127);
    steps(2, 127);
    TEST_ASSERT_NOT_EQUAL(0,
                          fixpid_an964_8bit_derivative(&an964_8bit_controller));
    TEST_ASSERT_NOT_EQUAL(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    fixpid_an964_8bit_reset(&an964_8bit_controller);
    TEST_ASSERT_EQUAL_INT16(
        0, fixpid_an964_8bit_proportional(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(0,
                            fixpid_an964_8bit_integral(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_INT16(
        0, fixpid_an964_8bit_derivative(&an964_8bit_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an964_8bit_flags(&an964_8bit_controller));
    reference = (struct reference_an964){
        .form = reference_an964_8bit(), .kp = 127, .ki = 127, .kd = 127};
    steps(5, 32);
}

void test_init_starts_from_rest(void)
{
    steps(60, 127);
    start(127, 127, 127);
    steps(5, -3);
}

// ---- Memory ----

static void init_good(void)
{
    static const struct fixpid_an964_8bit_gains good = {75, 5, 12};

    (void)fixpid_an964_8bit_init(&an964_8bit_controller, &good);
}

static void init_bad(void)
{
    static const struct fixpid_an964_8bit_gains bad = {75, 5, 128};

    (void)fixpid_an964_8bit_init(&an964_8bit_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_an964_8bit, ready);

    TEST_ASSERT_EQUAL_UINT(padding, poison_left(&an964_8bit_controller,
                                                sizeof(an964_8bit_controller),
                                                init_good));
    TEST_ASSERT_EQUAL_UINT(padding, poison_left(&an964_8bit_controller,
                                                sizeof(an964_8bit_controller),
                                                init_bad));
}

// A gain is at most 127, and a flipped bit would make 255 of it: the output of
// 504 would be 1012.
void test_step_a_flipped_bit_of_kp_keeps_the_output_within_its_limits(void)
{
    static const struct fixpid_an964_8bit_gains gains = {127, 0, 0};

    TEST_ASSERT_TRUE(fixpid_an964_8bit_init(&an964_8bit_controller, &gains));
    an964_8bit_controller.gains.kp ^= 0x80u;
    TEST_ASSERT_EQUAL_INT16(
        504, fixpid_an964_8bit_step(&an964_8bit_controller, 127));
}

// Nothing undefined comes of it either, which the sanitizers see.
void test_step_of_any_bytes_stays_within_its_limits(void)
{
    numbers_seed(8);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        numbers_fill(&an964_8bit_controller, sizeof(an964_8bit_controller));
        TEST_ASSERT_INT16_WITHIN(
            504, 0,
            fixpid_an964_8bit_step(&an964_8bit_controller,
                                   (int8_t)(numbers_next() >> 25)));
    }
}
