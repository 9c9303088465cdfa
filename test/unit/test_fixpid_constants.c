// SPDX-License-Identifier: MIT
// Which constants the macros of the headers take, at both ends of each range.
// What FIXPID_CHECKED would ask of the compiler is asked of the program here;
// test/use/consumers shows that the compilers refuse. A double has 53 bits
// here.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "fixpid_table.h"
#include "unity.h"

// In object mode the library is built for objects of these names.
FIXPID_DATA struct fixpid_an937 an937_controller;
FIXPID_DATA struct fixpid_pid pid_controller;

static bool seen;

#undef FIXPID_CHECKED
#define FIXPID_CHECKED(value, legal) ((seen = (legal)) ? 0u : 1u)
#undef FIXPID_FOLDED // nothing to fold in what is illegal
#define FIXPID_FOLDED(value) 0u

#define Q24 16777216.0

static bool kp_legal(double kp)
{
    (void)FIXPID_PID_KP(kp);
    return seen;
}

static bool ki_legal(double ki, double rate)
{
    (void)FIXPID_PID_KI(ki, rate);
    return seen;
}

static bool kd_legal(double kd, double rate, int64_t filter)
{
    (void)FIXPID_PID_KD(kd, rate, filter);
    return seen;
}

// A rate that is refused is folded all the same, into nothing that counts.
__attribute__((no_sanitize("float-cast-overflow"))) static bool rate_legal(
    double counts, double steps)
{
    (void)FIXPID_SLEW_RATE(counts, steps);
    return seen;
}

static bool an937_gain_legal(double gain)
{
    (void)FIXPID_AN937_GAIN(gain);
    return seen;
}

static bool array_legal(struct fixpid_table table)
{
    (void)table;
    return seen;
}

void setUp(void)
{
    seen = false;
}

void tearDown(void)
{
}

void test_kp_is_0_or_from_half_a_256th(void)
{
    TEST_ASSERT_TRUE(kp_legal(0));
    TEST_ASSERT_TRUE(kp_legal(0.5 / 256));
    TEST_ASSERT_FALSE(kp_legal(0.4999 / 256));
    TEST_ASSERT_FALSE(kp_legal(-0.5 / 256));
    TEST_ASSERT_FALSE(kp_legal(-1));
    TEST_ASSERT_TRUE(kp_legal(0.75));
    TEST_ASSERT_TRUE(kp_legal(1));
}

void test_kp_from_half_above_32767_is_refused(void)
{
    TEST_ASSERT_TRUE(kp_legal(32767.4999 / 256));
    TEST_ASSERT_FALSE(kp_legal(32767.5 / 256));
    TEST_ASSERT_FALSE(kp_legal(1000));
}

void test_ki_is_0_or_from_8(void)
{
    TEST_ASSERT_TRUE(ki_legal(0, 100));
    TEST_ASSERT_TRUE(ki_legal(8 / Q24, 1));
    TEST_ASSERT_TRUE(ki_legal(8 * 100 / Q24, 100));
    TEST_ASSERT_FALSE(ki_legal(7.9999 / Q24, 1));
    TEST_ASSERT_FALSE(ki_legal(-8 / Q24, 1));
    TEST_ASSERT_FALSE(ki_legal(-8 / Q24, -1));
    TEST_ASSERT_FALSE(ki_legal(0, -1));
    TEST_ASSERT_FALSE(ki_legal(0, -0.5));
    TEST_ASSERT_TRUE(ki_legal(0.5, 1));
    TEST_ASSERT_TRUE(ki_legal(1, 0.5));
}

void test_ki_from_half_above_its_largest_is_refused(void)
{
    TEST_ASSERT_TRUE(ki_legal((FIXPID_PID_KI_MAX + 0.4999) / Q24, 1));
    TEST_ASSERT_FALSE(ki_legal((FIXPID_PID_KI_MAX + 0.5) / Q24, 1));
    TEST_ASSERT_FALSE(ki_legal(128, 1));
    TEST_ASSERT_FALSE(ki_legal(1, 0));
}

void test_kd_is_0_or_from_half_a_256th(void)
{
    TEST_ASSERT_TRUE(kd_legal(0, 1, 0));
    TEST_ASSERT_TRUE(kd_legal(0.5 / 256, 1, 0));
    TEST_ASSERT_FALSE(kd_legal(0.5 / 256, 0.5, 0));
    TEST_ASSERT_TRUE(kd_legal(64.0 / 256, 1, 7));
    TEST_ASSERT_FALSE(kd_legal(63.99 / 256, 1, 7));
    TEST_ASSERT_FALSE(kd_legal(-1, 1, 0));
    TEST_ASSERT_FALSE(kd_legal(-1, -1, 0));
    TEST_ASSERT_FALSE(kd_legal(0, -1, 0));
    TEST_ASSERT_FALSE(kd_legal(0, -0.5, 0));
    TEST_ASSERT_FALSE(kd_legal(0, 0, 0));
    TEST_ASSERT_TRUE(kd_legal(0.75, 0.5, 0));
}

void test_kd_from_half_above_32255_is_refused(void)
{
    TEST_ASSERT_TRUE(kd_legal(32255.4999 / 256, 1, 0));
    TEST_ASSERT_FALSE(kd_legal(32255.5 / 256, 1, 0));
    TEST_ASSERT_FALSE(kd_legal(1, 32255.5 / 256, 0));
}

void test_a_filter_beyond_0_to_7_is_refused(void)
{
    TEST_ASSERT_TRUE(kd_legal(1, 1, 7));
    TEST_ASSERT_FALSE(kd_legal(1, 1, 8));
    TEST_ASSERT_FALSE(kd_legal(1, 1, -1));
}

void test_a_slew_rate_is_0_or_from_half_a_65536th(void)
{
    TEST_ASSERT_TRUE(rate_legal(0, 100));
    TEST_ASSERT_TRUE(rate_legal(0.5 / 65536, 1));
    TEST_ASSERT_FALSE(rate_legal(0.499999 / 65536, 1));
    TEST_ASSERT_TRUE(rate_legal(1.0 / 65536, 2));
    TEST_ASSERT_FALSE(rate_legal(0.5 / 65536, 2));
    TEST_ASSERT_FALSE(rate_legal(-1, 1));
    TEST_ASSERT_FALSE(rate_legal(-1, -1));
    TEST_ASSERT_FALSE(rate_legal(0, -1));
    TEST_ASSERT_FALSE(rate_legal(0, -0.5));
    TEST_ASSERT_FALSE(rate_legal(0, 0));
    TEST_ASSERT_TRUE(rate_legal(0.75, 0.5));
}

void test_a_slew_rate_of_65536_counts_is_refused(void)
{
    TEST_ASSERT_TRUE(rate_legal(4294967295.4999 / 65536, 1));
    TEST_ASSERT_FALSE(rate_legal(4294967295.5 / 65536, 1));
    TEST_ASSERT_FALSE(rate_legal(1, 0));
}

void test_an_an937_gain_is_from_0_to_half_above_255(void)
{
    TEST_ASSERT_TRUE(an937_gain_legal(0));
    TEST_ASSERT_TRUE(an937_gain_legal(0.5));
    TEST_ASSERT_FALSE(an937_gain_legal(-0.001));
    TEST_ASSERT_TRUE(an937_gain_legal(255.4999 / 16));
    TEST_ASSERT_FALSE(an937_gain_legal(255.5 / 16));
}

#define TABLE_OF(array) array_legal((struct fixpid_table)FIXPID_TABLE(array))

void test_a_table_has_2_to_255_points(void)
{
    static const struct fixpid_table_point one[1];
    static const struct fixpid_table_point two[2];
    static const struct fixpid_table_point most[255];
    static const struct fixpid_table_point more[256];

    TEST_ASSERT_FALSE(TABLE_OF(one));
    TEST_ASSERT_TRUE(TABLE_OF(two));
    TEST_ASSERT_TRUE(TABLE_OF(most));
    TEST_ASSERT_FALSE(TABLE_OF(more));
}
