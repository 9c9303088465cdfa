// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "fixpid_slew.h"
#include "numbers.h"
#include "numbers_control.h"
#include "poison.h"
#include "reference.h"
#include "reference_control.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("test/support/numbers_slew.c")
TEST_SOURCE_FILE("src/slew/fixpid_slew.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif

#define ROWS 1000
#define INSTANCES 5

static FIXPID_DATA struct fixpid_slew slew;
static struct reference_slew reference;

void setUp(void)
{
    fixpid_slew_init(&slew, 0, 0);
    reference_slew_init(&reference, 0, 0);
}

void tearDown(void)
{
}

static void steps_to(int16_t target, int16_t output, int32_t value)
{
    TEST_ASSERT_EQUAL_INT16(output, fixpid_slew_step(&slew, target));
    TEST_ASSERT_EQUAL_INT32(value, fixpid_slew_value(&slew));
}

void test_step_worked_example_rises_and_falls_at_its_rates(void)
{
    fixpid_slew_init(&slew, 98304, 16384); // +1.5, -0.25
    steps_to(4, 2, 98304);
    steps_to(4, 3, 196608);
    steps_to(4, 4, 262144);
    steps_to(4, 4, 262144);
    steps_to(2, 4, 245760);
    steps_to(2, 4, 229376);
    steps_to(2, 3, 212992);
    steps_to(2, 3, 196608);
    steps_to(-1, 3, 180224);
}

void test_step_all_zero_object_holds_0(void)
{
    static FIXPID_DATA struct fixpid_slew zero;

    TEST_ASSERT_EQUAL_INT16(0, fixpid_slew_step(&zero, INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_slew_step(&zero, INT16_MIN));
}

void test_step_without_limit_and_with_fall_0_rises_only(void)
{
    fixpid_slew_init(&slew, FIXPID_SLEW_NO_LIMIT, 0);
    fixpid_slew_seed(&slew, INT16_MIN);
    steps_to(32767, 32767, 2147418112);
    steps_to(-32768, 32767, 2147418112);
    fixpid_slew_set_rates(&slew, 1, FIXPID_SLEW_NO_LIMIT);
    steps_to(-32768, -32768, INT32_MIN);
    steps_to(32767, -32768, -INT32_MAX);
}

void test_step_of_65535_counts_at_once_has_no_limit(void)
{
    fixpid_slew_init(&slew, UINT32_C(0xFFFF0000), UINT32_C(0xFFFF0000));
    fixpid_slew_seed(&slew, INT16_MIN);
    steps_to(32767, 32767, 2147418112);
    steps_to(-32768, -32768, INT32_MIN);
}

void test_step_rate_from_the_middle_to_beyond_either_end_does_not_wrap(void)
{
    fixpid_slew_init(&slew, UINT32_C(0xFFFF0000), UINT32_C(0xFFFF0000));
    steps_to(32767, 32767, 2147418112);
    fixpid_slew_reset(&slew);
    steps_to(-32768, -32768, INT32_MIN);
}

void test_step_a_65536th_below_no_limit_is_that_much_short(void)
{
    fixpid_slew_init(&slew, UINT32_C(0xFFFEFFFF), UINT32_C(0xFFFEFFFF));
    fixpid_slew_seed(&slew, INT16_MIN);
    steps_to(32767, 32767, 2147418111);
    fixpid_slew_seed(&slew, INT16_MAX);
    steps_to(-32768, -32768, -INT32_MAX);
}

void test_step_result_is_rounded_half_up(void)
{
    fixpid_slew_init(&slew, 0x7FFF, 0x8000);
    steps_to(1, 0, 0x7FFF);
    fixpid_slew_reset(&slew);
    fixpid_slew_set_rates(&slew, 0x8000, 0x8000);
    steps_to(1, 1, 0x8000);
    fixpid_slew_reset(&slew);
    steps_to(-1, 0, -INT32_C(32768));
    fixpid_slew_reset(&slew);
    fixpid_slew_set_rates(&slew, 0x8000, 0x8001);
    steps_to(-1, -1, -INT32_C(32769));
}

void test_step_slowest_rate_takes_65536_steps_for_a_count(void)
{
    fixpid_slew_init(&slew, 1, 1);
    for (int32_t n = 1; n < 65536; n++) {
        (void)fixpid_slew_step(&slew, 1);
        TEST_ASSERT_EQUAL_INT32(n, fixpid_slew_value(&slew));
    }
    steps_to(1, 1, 65536);
    steps_to(1, 1, 65536);
}

void test_step_at_its_target_stays_at_any_rate(void)
{
    fixpid_slew_seed(&slew, 5);
    steps_to(5, 5, 327680);
    fixpid_slew_set_rates(&slew, 77, 99);
    steps_to(5, 5, 327680);
}

void test_step_new_target_counts_from_the_fraction(void)
{
    fixpid_slew_init(&slew, 0x4000, 0x2000);
    steps_to(10, 0, 0x4000);
    steps_to(-10, 0, 0x2000);
    steps_to(-10, 0, 0);
    steps_to(-10, 0, -0x2000);
}

void test_init_starts_from_0_and_not_from_the_target(void)
{
    fixpid_slew_seed(&slew, 100);
    fixpid_slew_init(&slew, 0x10000, 0x10000);
    steps_to(100, 1, 0x10000);
}

void test_reset_keeps_the_rates(void)
{
    fixpid_slew_init(&slew, 0x20000, 0x30000);
    (void)fixpid_slew_step(&slew, 100);
    fixpid_slew_reset(&slew);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_slew_value(&slew));
    steps_to(100, 2, 0x20000);
    steps_to(-100, -1, -0x10000);
}

void test_set_rates_keeps_the_value(void)
{
    fixpid_slew_seed(&slew, -7);
    fixpid_slew_set_rates(&slew, 0x10000, 0);
    TEST_ASSERT_EQUAL_INT32(-7 * INT32_C(65536), fixpid_slew_value(&slew));
    steps_to(0, -6, -6 * INT32_C(65536));
}

void test_step_behind_it_a_target_within_the_rate_comes_back_as_it_is(void)
{
    fixpid_slew_init(&slew, 3 * UINT32_C(65536), 3 * UINT32_C(65536));
    steps_to(3, 3, 3 * INT32_C(65536));
    steps_to(1, 1, INT32_C(65536));
    steps_to(-2, -2, -2 * INT32_C(65536));
}

void test_rate_macro_folds_half_up(void)
{
    static const uint32_t rates[] = {
        FIXPID_SLEW_RATE(0, 100),     FIXPID_SLEW_RATE(1, 65536),
        FIXPID_SLEW_RATE(0.5, 65536), FIXPID_SLEW_RATE(10, 4),
        FIXPID_SLEW_RATE(2.5, 65536), FIXPID_SLEW_RATE(65535, 1),
        FIXPID_SLEW_RATE(65535.5, 1)};

    TEST_ASSERT_EQUAL_UINT32(0, rates[0]);
    TEST_ASSERT_EQUAL_UINT32(1, rates[1]);
    TEST_ASSERT_EQUAL_UINT32(1, rates[2]);
    TEST_ASSERT_EQUAL_UINT32(163840, rates[3]);
    TEST_ASSERT_EQUAL_UINT32(3, rates[4]);
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(0xFFFF0000), rates[5]);
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(0xFFFF8000), rates[6]);
}

static void init(uint32_t rise, uint32_t fall)
{
    fixpid_slew_init(&slew, rise, fall);
    reference_slew_init(&reference, rise, fall);
}

static void set_rates(uint32_t rise, uint32_t fall)
{
    fixpid_slew_set_rates(&slew, rise, fall);
    reference.rise = rise;
    reference.fall = fall;
}

static void seed(int16_t value)
{
    fixpid_slew_seed(&slew, value);
    reference_slew_seed(&reference, value);
}

static int16_t step(int16_t target)
{
    const int16_t output = fixpid_slew_step(&slew, target);

    const int16_t defined = (int16_t)reference_slew_step(&reference, target);

    if (output != defined || fixpid_slew_value(&slew) != reference.value) {
        char text[120];
        snprintf(text, sizeof text,
                 "target %d, rise %lu, fall %lu: output %d, value %ld; "
                 "defined %d, %ld",
                 target, (unsigned long)reference.rise,
                 (unsigned long)reference.fall, output,
                 (long)fixpid_slew_value(&slew), defined,
                 (long)reference.value);
        TEST_FAIL_MESSAGE(text);
    }
    return output;
}

static void make_event(const int32_t row[])
{
    const uint32_t rise = (uint32_t)row[SLEW_RISE];
    const uint32_t fall = (uint32_t)row[SLEW_FALL];

    switch (row[SLEW_EVENT]) {
    case 0:
        break;
    case 1:
        init(rise, fall);
        break;
    case 2:
        fixpid_slew_reset(&slew);
        reference.value = 0;
        break;
    case 3:
        set_rates(rise, fall);
        break;
    case 4:
        seed((int16_t)row[SLEW_SEED]);
        break;
    default:
        TEST_FAIL_MESSAGE("unknown event");
    }
}

void test_step_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(slew);
    while (vectors_next(row)) {
        make_event(row);
        TEST_ASSERT_EQUAL_INT16(row[SLEW_OUTPUT],
                                step((int16_t)row[SLEW_TARGET]));
        TEST_ASSERT_EQUAL_INT32(row[SLEW_VALUE], fixpid_slew_value(&slew));
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}

static int64_t whole_counts_of(int64_t rate)
{
    return (rate + 65535) / 65536;
}

void test_step_random_calls_match_the_definition(void)
{
    int16_t target = 0;
    int16_t before = 0;

    numbers_seed(41);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        int16_t output;

        switch (numbers_below(64)) {
        case 0:
            init(numbers_slew_rate(), numbers_slew_rate());
            before = 0;
            break;
        case 1:
            fixpid_slew_reset(&slew);
            reference.value = 0;
            before = 0;
            break;
        case 2:
            set_rates(numbers_slew_rate(), numbers_slew_rate());
            break;
        case 3:
            before = numbers_int16();
            seed(before);
            break;
        default:
            break;
        }
        if (numbers_one_in(8)) {
            target = numbers_int16();
        }
        output = step(target);
        if ((int32_t)output - before > whole_counts_of(reference.rise) ||
            (int32_t)before - output > whole_counts_of(reference.fall)) {
            TEST_FAIL_MESSAGE("moves by more than the rate");
        }
        before = output;
    }
}

static void init_it(void)
{
    fixpid_slew_init(&slew, 0, 0);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    TEST_ASSERT_EQUAL_UINT(12, sizeof slew);
    TEST_ASSERT_EQUAL_UINT(0, poison_left(&slew, sizeof slew, init_it));
}

void test_slew_several_instances_keep_their_own_state(void)
{
    struct fixpid_slew slews[INSTANCES];
    struct reference_slew references[INSTANCES];

    for (unsigned i = 0; i < INSTANCES; i++) {
        fixpid_slew_init(&slews[i], 100000u * i, 70000u * i);
        reference_slew_init(&references[i], 100000 * (int32_t)i,
                            70000 * (int32_t)i);
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(INSTANCES);
        const int16_t target = numbers_int16();

        TEST_ASSERT_EQUAL_INT32(reference_slew_step(&references[i], target),
                                fixpid_slew_step(&slews[i], target));
    }
}
