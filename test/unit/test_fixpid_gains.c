// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "fixpid_gains.h"
#include "numbers.h"
#include "numbers_control.h"
#include "reference.h"
#include "reference_control.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("test/support/numbers_gains.c")
TEST_SOURCE_FILE("src/gains/fixpid_gains.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif
#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every kp
#endif

#define ROWS 1000
#define UNTOUCHED 0xA5

static struct fixpid_pid_gains gains;
static struct fixpid_gains_milli back;

void setUp(void)
{
    gains = (struct fixpid_pid_gains){UNTOUCHED, UNTOUCHED, UNTOUCHED, 5};
    back = (struct fixpid_gains_milli){UNTOUCHED, UNTOUCHED, UNTOUCHED};
}

void tearDown(void)
{
}

static bool same_gains(const struct fixpid_pid_gains *a,
                       const struct fixpid_pid_gains *b)
{
    return a->kp_q8 == b->kp_q8 && a->ki_q24 == b->ki_q24 &&
           a->kd_q8 == b->kd_q8 && a->derivative_filter == b->derivative_filter;
}

static void fail(const char *what, const uint32_t in[4], const uint32_t is[4],
                 const uint32_t defined[4])
{
    char text[240];

    snprintf(text, sizeof text,
             "%s of %lu, %lu, %lu at a rate of %lu / 1000: "
             "%lu with %lu, %lu, %lu; defined %lu with %lu, %lu, %lu",
             what, (unsigned long)in[0], (unsigned long)in[1],
             (unsigned long)in[2], (unsigned long)in[3], (unsigned long)is[0],
             (unsigned long)is[1], (unsigned long)is[2], (unsigned long)is[3],
             (unsigned long)defined[0], (unsigned long)defined[1],
             (unsigned long)defined[2], (unsigned long)defined[3]);
    TEST_FAIL_MESSAGE(text);
}

static bool from(uint32_t kp, uint32_t ki, uint32_t kd, uint32_t rate_milli,
                 uint8_t filter)
{
    const struct fixpid_gains_milli milli = {kp, ki, kd};
    struct fixpid_pid_gains defined = gains;
    const bool expected =
        reference_gains_from_milli(&defined, &milli, rate_milli, filter);
    const bool accepted =
        fixpid_gains_from_milli(&gains, &milli, rate_milli, filter);

    if (accepted != expected || !same_gains(&defined, &gains)) {
        const uint32_t in[4] = {kp, ki, kd, rate_milli};
        const uint32_t is[4] = {accepted, gains.kp_q8, gains.ki_q24,
                                gains.kd_q8};
        const uint32_t meant[4] = {expected, defined.kp_q8, defined.ki_q24,
                                   defined.kd_q8};
        fail("from thousandths", in, is, meant);
    }
    return accepted;
}

static bool to(uint32_t rate_milli)
{
    struct fixpid_gains_milli defined = back;
    const bool expected =
        reference_gains_to_milli(&defined, &gains, rate_milli);
    const bool accepted = fixpid_gains_to_milli(&back, &gains, rate_milli);

    if (accepted != expected || defined.kp != back.kp ||
        defined.ki != back.ki || defined.kd != back.kd) {
        const uint32_t in[4] = {gains.kp_q8, gains.ki_q24, gains.kd_q8,
                                rate_milli};
        const uint32_t is[4] = {accepted, back.kp, back.ki, back.kd};
        const uint32_t meant[4] = {expected, defined.kp, defined.ki,
                                   defined.kd};
        fail("to thousandths", in, is, meant);
    }
    return accepted;
}

static void gains_are(uint16_t kp_q8, uint32_t ki_q24, uint16_t kd_q8,
                      uint8_t filter)
{
    TEST_ASSERT_EQUAL_UINT16(kp_q8, gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT32(ki_q24, gains.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(kd_q8, gains.kd_q8);
    TEST_ASSERT_EQUAL_UINT8(filter, gains.derivative_filter);
}

static void back_is(uint32_t kp, uint32_t ki, uint32_t kd)
{
    TEST_ASSERT_EQUAL_UINT32(kp, back.kp);
    TEST_ASSERT_EQUAL_UINT32(ki, back.ki);
    TEST_ASSERT_EQUAL_UINT32(kd, back.kd);
}

// And leaves the gains as they were.
static void is_refused(uint32_t kp, uint32_t ki, uint32_t kd,
                       uint32_t rate_milli, uint8_t filter)
{
    setUp();
    TEST_ASSERT_FALSE(from(kp, ki, kd, rate_milli, filter));
    gains_are(UNTOUCHED, UNTOUCHED, UNTOUCHED, 5);
}

static void to_is_refused(uint32_t rate_milli)
{
    back = (struct fixpid_gains_milli){UNTOUCHED, UNTOUCHED, UNTOUCHED};
    TEST_ASSERT_FALSE(to(rate_milli));
    back_is(UNTOUCHED, UNTOUCHED, UNTOUCHED);
}

void test_from_milli_worked_example_is_what_the_macros_fold(void)
{
    static const struct fixpid_pid_gains folded =
        FIXPID_PID_GAINS(2, 0.5, 1, 10, 2);

    TEST_ASSERT_TRUE(from(2000, 500, 1000, 10000, 2));
    gains_are(512, 838861, 640, 2);
    TEST_ASSERT_TRUE(same_gains(&folded, &gains));
    TEST_ASSERT_TRUE(to(10000));
    back_is(2000, 500, 1000);
}

void test_from_milli_all_0_is_accepted(void)
{
    TEST_ASSERT_TRUE(from(0, 0, 0, 1, 7));
    gains_are(0, 0, 0, 7);
    TEST_ASSERT_TRUE(to(1));
    back_is(0, 0, 0);
}

void test_from_milli_kp_at_both_ends(void)
{
    is_refused(1, 0, 0, 1000, 0); // 0.256
    TEST_ASSERT_TRUE(from(2, 0, 0, 1000, 0));
    gains_are(1, 0, 0, 0);
    TEST_ASSERT_TRUE(to(1000));
    back_is(4, 0, 0);
    TEST_ASSERT_TRUE(from(127998, 0, 0, 1, 0));
    gains_are(32767, 0, 0, 0);
    TEST_ASSERT_TRUE(to(1));
    back_is(127996, 0, 0);
    is_refused(127999, 0, 0, 1, 0);
    is_refused(UINT32_MAX, 0, 0, 1, 0);
}

void test_from_milli_ki_at_both_ends(void)
{
    is_refused(0, 238, 0, 500000000, 0); // 7.99 / 2^24
    TEST_ASSERT_TRUE(from(0, 239, 0, 500000000, 0));
    gains_are(0, 8, 0, 0);
    TEST_ASSERT_TRUE(to(500000000));
    back_is(0, 238, 0);
    TEST_ASSERT_TRUE(from(0, 1, 0, 2097152, 0));
    gains_are(0, 8, 0, 0);
    is_refused(0, 1, 0, 2097153, 0);
    TEST_ASSERT_TRUE(from(0, 127996, 0, 1000, 0));
    gains_are(0, UINT32_C(2147416539), 0, 0);
    is_refused(0, 127997, 0, 1000, 0);
    TEST_ASSERT_TRUE(from(0, 32767, 0, 256, 0));
    gains_are(0, FIXPID_PID_KI_MAX, 0, 0);
    is_refused(0, UINT32_MAX, 0, 1, 0);
    is_refused(0, 256000, 0, 1000, 0);                            // 2^32
    TEST_ASSERT_TRUE(from(0, FIXPID_PID_KI_MAX, 0, 16777216, 0)); // as it is
    gains_are(0, FIXPID_PID_KI_MAX, 0, 0);
    is_refused(0, FIXPID_PID_KI_MAX + 1u, 0, 16777216, 0);
}

void test_from_milli_ki_of_a_half_rounds_up(void)
{
    TEST_ASSERT_TRUE(from(0, 25, 0, 33554432, 0)); // 12.5
    gains_are(0, 13, 0, 0);
    TEST_ASSERT_TRUE(to(33554432));
    back_is(0, 26, 0);
}

void test_from_milli_kd_at_both_ends(void)
{
    is_refused(0, 0, 1, 1000, 0); // 0.256
    TEST_ASSERT_TRUE(from(0, 0, 125998, 1000, 0));
    gains_are(0, 0, 32255, 0);
    is_refused(0, 0, 125999, 1000, 0);
    is_refused(0, 0, UINT32_MAX, 500000000, 0);
}

void test_from_milli_rate_and_filter_at_both_ends(void)
{
    TEST_ASSERT_TRUE(from(1000, 0, 0, 1, 0));
    TEST_ASSERT_TRUE(from(1000, 0, 0, 500000000, 7));
    is_refused(1000, 0, 0, 0, 0);
    is_refused(1000, 0, 0, 500000001, 0);
    is_refused(1000, 0, 0, UINT32_MAX, 0);
    is_refused(1000, 0, 0, 1000, 8);
    is_refused(1000, 0, 0, 1000, 255);
}

void test_to_milli_ki_or_kd_that_32_bits_do_not_hold_is_refused(void)
{
    TEST_ASSERT_TRUE(from(0, 0, UINT32_MAX, 1, 7));
    gains_are(0, 0, 8590, 7);
    to_is_refused(1); // 4295000000
    TEST_ASSERT_TRUE(from(0, UINT32_MAX, 0, 499999001, 0));
    gains_are(0, UINT32_C(144115476), 0, 0);
    to_is_refused(499999001); // 4294967295
    gains.ki_q24 = UINT32_C(144115197);
    to_is_refused(499999969); // 4294967295.5 and more
    gains.ki_q24 = FIXPID_PID_KI_MAX;
    to_is_refused(500000000); // high word above the divisor
}

void test_to_milli_rate_at_both_ends(void)
{
    gains = (struct fixpid_pid_gains){256, 0, 0, 0};
    TEST_ASSERT_TRUE(to(1));
    back_is(1000, 0, 0);
    TEST_ASSERT_TRUE(to(500000000));
    to_is_refused(0);
    to_is_refused(500000001);
}

void test_to_milli_gains_out_of_range_are_refused(void)
{
    gains = (struct fixpid_pid_gains){32767, FIXPID_PID_KI_MAX, 32255, 7};
    TEST_ASSERT_TRUE(to(1000));
    gains.kp_q8++;
    to_is_refused(1000);
    gains = (struct fixpid_pid_gains){0, FIXPID_PID_KI_MAX + 1u, 0, 0};
    to_is_refused(1000);
    gains = (struct fixpid_pid_gains){0, 0, 32256, 0};
    to_is_refused(1000);
    gains = (struct fixpid_pid_gains){0, 0, 0, 8};
    to_is_refused(1000);
}

void test_to_milli_shows_what_the_controller_has(void)
{
    TEST_ASSERT_TRUE(from(100, 0, 0, 1000, 0));
    TEST_ASSERT_TRUE(to(1000));
    back_is(102, 0, 0); // 26 / 256
}

void test_from_milli_of_to_milli_every_kp_is_the_same(void)
{
    for (uint32_t kp = 0; kp <= 32767u; kp += TEST_STRIDE) {
        gains = (struct fixpid_pid_gains){(uint16_t)kp, 0, 0, 0};
        TEST_ASSERT_TRUE(to(1000));
        TEST_ASSERT_TRUE(from(back.kp, 0, 0, 1000, 0));
        TEST_ASSERT_EQUAL_UINT16(kp, gains.kp_q8);
    }
}

void test_from_and_to_milli_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(gains);
    while (vectors_next(row)) {
        const uint32_t rate_milli = (uint32_t)row[GAINS_RATE];
        const uint8_t filter = (uint8_t)row[GAINS_FILTER];

        gains = (struct fixpid_pid_gains){0, 0, 0, filter};
        back = (struct fixpid_gains_milli){0, 0, 0};
        TEST_ASSERT_EQUAL_INT32(
            row[GAINS_ACCEPTED],
            from((uint32_t)row[GAINS_KP_MILLI], (uint32_t)row[GAINS_KI_MILLI],
                 (uint32_t)row[GAINS_KD_MILLI], rate_milli, filter));
        gains_are((uint16_t)row[GAINS_KP], (uint32_t)row[GAINS_KI],
                  (uint16_t)row[GAINS_KD], filter);
        if (row[GAINS_ACCEPTED] != 0) {
            TEST_ASSERT_EQUAL_INT32(row[GAINS_BACK_ACCEPTED], to(rate_milli));
            back_is((uint32_t)row[GAINS_KP_BACK], (uint32_t)row[GAINS_KI_BACK],
                    (uint32_t)row[GAINS_KD_BACK]);
        }
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}

void test_from_and_to_milli_random_calls_match_the_definition(void)
{
    struct fixpid_gains_milli milli;

    numbers_seed(43);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        const uint32_t rate_milli = numbers_gains_rate();

        numbers_gains_milli(&milli);
        (void)from(milli.kp, milli.ki, milli.kd, rate_milli,
                   numbers_gains_filter());
        if (numbers_one_in(4)) {
            gains.ki_q24 = numbers_any_size();
        }
        (void)to(numbers_one_in(2) ? rate_milli : numbers_gains_rate());
    }
}
