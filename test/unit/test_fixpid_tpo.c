// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "fixpid_tpo.h"
#include "numbers.h"
#include "numbers_control.h"
#include "poison.h"
#include "reference.h"
#include "reference_control.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("test/support/numbers_tpo.c")
TEST_SOURCE_FILE("src/tpo/fixpid_tpo.c")
TEST_SOURCE_FILE("src/tpo/fixpid_tpo_check.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif

#define ROWS 1000
#define INSTANCES 5

static FIXPID_DATA struct fixpid_tpo tpo;
static struct reference_tpo reference;
static struct fixpid_tpo_config config;

void setUp(void)
{
    config = (struct fixpid_tpo_config){100, 8, 2, 2};
}

void tearDown(void)
{
}

static bool init(void)
{
    const bool accepted = fixpid_tpo_init(&tpo, &config);

    TEST_ASSERT_EQUAL(reference_tpo_init(&reference, &config), accepted);
    TEST_ASSERT_EQUAL(accepted, fixpid_tpo_check(&config) == FIXPID_TPO_OK);
    return accepted;
}

static void reset(void)
{
    fixpid_tpo_reset(&tpo);
    reference_tpo_reset(&reference);
}

static bool step(int16_t duty)
{
    const bool on = fixpid_tpo_step(&tpo, duty);

    if (on != reference_tpo_step(&reference, duty)) {
        char text[100];
        snprintf(text, sizeof text,
                 "duty %d of %d, window %u, minimum on %u, off %u: "
                 "%s, and the other is defined",
                 duty, config.full, config.window, config.minimum_on,
                 config.minimum_off, on ? "on" : "off");
        TEST_FAIL_MESSAGE(text);
    }
    return on;
}

// The on-steps of a whole window, all of which come first.
static unsigned pulse_of(int16_t duty)
{
    unsigned pulse = 0;

    for (unsigned at = 0; at < config.window; at++) {
        if (step(duty)) {
            TEST_ASSERT_EQUAL_UINT(at, pulse);
            pulse++;
        }
    }
    return pulse;
}

static void window_gives(int16_t duty, unsigned pulse, int32_t carry)
{
    TEST_ASSERT_EQUAL_UINT(pulse, pulse_of(duty));
    TEST_ASSERT_EQUAL_INT32(carry, reference.carry);
}

void test_step_worked_example_carries_what_a_window_cannot_give(void)
{
    TEST_ASSERT_TRUE(init());
    window_gives(10, 0, 80);
    window_gives(10, 0, 160);
    window_gives(10, 2, 40);
    window_gives(80, 6, 80);
    window_gives(95, 8, 40);
    window_gives(95, 8, 0);
}

void test_step_duties_below_0_and_above_full_count_as_those(void)
{
    TEST_ASSERT_TRUE(init());
    window_gives(0, 0, 0);
    window_gives(-1, 0, 0);
    window_gives(INT16_MIN, 0, 0);
    window_gives(100, 8, 0);
    window_gives(101, 8, 0);
    window_gives(INT16_MAX, 8, 0);
}

// One beyond is as much as any: nothing of it is owed to the next window.
void test_step_duty_of_one_above_full_is_not_carried_over(void)
{
    config = (struct fixpid_tpo_config){1, 4, 0, 0};
    TEST_ASSERT_TRUE(init());
    window_gives(2, 4, 0);
    window_gives(0, 0, 0);
}

void test_step_credit_just_below_the_shortest_pulse_waits(void)
{
    config = (struct fixpid_tpo_config){5, 3, 2, 0};
    TEST_ASSERT_TRUE(init());
    window_gives(3, 0, 9); // of 2 * 5
}

void test_step_credit_just_below_a_whole_window_has_a_gap(void)
{
    config = (struct fixpid_tpo_config){5, 4, 0, 1};
    TEST_ASSERT_TRUE(init());
    window_gives(2, 1, 3);
    window_gives(4, 3, 4); // 19 of 4 * 5
}

void test_step_duty_of_the_first_step_counts_for_the_window(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_TRUE(step(50));
    TEST_ASSERT_TRUE(step(0));
    TEST_ASSERT_TRUE(step(0));
    TEST_ASSERT_TRUE(step(100));
    for (int at = 4; at < 8; at++) {
        TEST_ASSERT_FALSE(step(100));
    }
    TEST_ASSERT_TRUE(step(100));
}

void test_step_pulse_and_gap_of_just_the_minimum_are_given(void)
{
    TEST_ASSERT_TRUE(init());
    window_gives(25, 2, 0);
    window_gives(75, 6, 0);
}

void test_step_minimum_0_works_like_1(void)
{
    for (uint16_t minimum = 0; minimum <= 1; minimum++) {
        config.minimum_on = minimum;
        config.minimum_off = minimum;
        TEST_ASSERT_TRUE(init());
        window_gives(12, 0, 96);
        window_gives(13, 2, 0);
        window_gives(99, 7, 92);
        window_gives(99, 8, 84);
    }
}

void test_step_window_of_1_is_a_sigma_delta_modulator(void)
{
    unsigned on = 0;

    config = (struct fixpid_tpo_config){1000, 1, 0, 0};
    TEST_ASSERT_TRUE(init());
    for (int n = 0; n < 1000; n++) {
        on += step(123) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT(123, on);
    TEST_ASSERT_EQUAL_INT32(0, reference.carry);
}

void test_step_constant_duty_is_exact_over_many_windows(void)
{
    unsigned on = 0;

    config = (struct fixpid_tpo_config){1000, 50, 0, 0};
    TEST_ASSERT_TRUE(init());
    for (int window = 0; window < 1000; window++) {
        on += pulse_of(3);
    }
    TEST_ASSERT_EQUAL_UINT(150, on); // 1000 * 50 * 3 / 1000
}

void test_step_widest_window_reaches_the_bounds_of_the_credit(void)
{
    config = (struct fixpid_tpo_config){32767, 32767, 32767, 0};
    TEST_ASSERT_TRUE(init());
    window_gives(32766, 0, INT32_C(32766) * 32767);
    window_gives(32767, 32767, INT32_C(32766) * 32767);
    config = (struct fixpid_tpo_config){32767, 32767, 0, 32767};
    TEST_ASSERT_TRUE(init());
    window_gives(1, 32767, INT32_C(-32766) * 32767);
    window_gives(0, 0, INT32_C(-32766) * 32767);
}

void test_init_ends_of_the_ranges_are_taken(void)
{
    config = (struct fixpid_tpo_config){1, 1, 0, 0};
    TEST_ASSERT_TRUE(init());
    config = (struct fixpid_tpo_config){1, 1, 1, 0};
    TEST_ASSERT_TRUE(init());
    config = (struct fixpid_tpo_config){1, 1, 0, 1};
    TEST_ASSERT_TRUE(init());
    config = (struct fixpid_tpo_config){32767, 32767, 16383, 16384};
    TEST_ASSERT_TRUE(init());
}

static void is_refused(int16_t full, uint16_t window, uint16_t on, uint16_t off)
{
    config = (struct fixpid_tpo_config){100, 8, 2, 2};
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_TRUE(step(100));
    config = (struct fixpid_tpo_config){full, window, on, off};
    TEST_ASSERT_FALSE(init());
    for (int at = 0; at < 20; at++) {
        TEST_ASSERT_FALSE(step(INT16_MAX));
    }
    reset();
    TEST_ASSERT_FALSE(step(INT16_MAX));
}

void test_init_beyond_the_ranges_is_refused_and_off(void)
{
    is_refused(0, 8, 2, 2);
    is_refused(-1, 8, 2, 2);
    is_refused(INT16_MIN, 8, 2, 2);
    is_refused(100, 0, 0, 0);
    is_refused(100, 32768, 2, 2);
    is_refused(100, 65535, 2, 2);
    is_refused(100, 8, 9, 0);
    is_refused(100, 8, 0, 9);
    is_refused(100, 8, 5, 4);
    is_refused(100, 1, 1, 1);     // a sum of 2, where 0 and 0 are legal
    is_refused(100, 8, 65535, 2); // would be 1 in 16 bits
    is_refused(100, 8, 2, 65535);
}

// Every field is wrong, and then one after the other is right.
void test_check_names_the_first_wrong_field(void)
{
    config = (struct fixpid_tpo_config){0, 0, 9, 9};
    TEST_ASSERT_EQUAL(FIXPID_TPO_BAD_FULL, fixpid_tpo_check(&config));
    config.full = 1;
    TEST_ASSERT_EQUAL(FIXPID_TPO_BAD_WINDOW, fixpid_tpo_check(&config));
    config.window = 32768;
    TEST_ASSERT_EQUAL(FIXPID_TPO_BAD_WINDOW, fixpid_tpo_check(&config));
    config.window = 8;
    TEST_ASSERT_EQUAL(FIXPID_TPO_BAD_MINIMUM_ON, fixpid_tpo_check(&config));
    config.minimum_on = 8;
    TEST_ASSERT_EQUAL(FIXPID_TPO_BAD_MINIMUM_OFF, fixpid_tpo_check(&config));
    config.minimum_off = 0;
    TEST_ASSERT_EQUAL(FIXPID_TPO_OK, fixpid_tpo_check(&config));
}

void test_step_all_zero_object_is_off(void)
{
    static FIXPID_DATA struct fixpid_tpo zero;

    TEST_ASSERT_FALSE(fixpid_tpo_step(&zero, INT16_MAX));
    fixpid_tpo_reset(&zero);
    TEST_ASSERT_FALSE(fixpid_tpo_step(&zero, INT16_MAX));
}

void test_reset_begins_a_window_and_forgets_what_is_owed(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_UINT(0, pulse_of(20)); // 160 owed
    TEST_ASSERT_TRUE(step(100));
    reset();
    window_gives(10, 0, 80);
    window_gives(100, 8, 80);
    TEST_ASSERT_TRUE(step(100));
    reset();
    TEST_ASSERT_FALSE(step(0));
}

static void init_again(void)
{
    TEST_ASSERT_TRUE(init());
}

void test_init_drops_the_window_of_the_one_before(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_TRUE(step(100));
    init_again();
    TEST_ASSERT_FALSE(step(10));
}

void test_step_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(tpo);
    while (vectors_next(row)) {
        config.full = (int16_t)row[TPO_FULL];
        config.window = (uint16_t)row[TPO_WINDOW];
        config.minimum_on = (uint16_t)row[TPO_MINIMUM_ON];
        config.minimum_off = (uint16_t)row[TPO_MINIMUM_OFF];
        if (row[TPO_EVENT] == 1) {
            TEST_ASSERT_EQUAL_INT32(row[TPO_ACCEPTED], init());
        } else if (row[TPO_EVENT] == 2) {
            reset();
        }
        TEST_ASSERT_EQUAL_INT32(row[TPO_ON], step((int16_t)row[TPO_DUTY]));
        TEST_ASSERT_EQUAL_INT32(row[TPO_CARRY], reference.carry);
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}

static int64_t at_least_one(int64_t steps)
{
    return steps < 1 ? 1 : steps;
}

// What a window's first step has decided, as the header promises it.
static void check_window(int16_t duty)
{
    const int64_t on = at_least_one(reference.minimum_on);
    const int64_t off = at_least_one(reference.minimum_off);
    const int64_t gap = reference.window - reference.pulse;

    if ((reference.pulse != 0 && reference.pulse < on) ||
        (gap != 0 && gap < off)) {
        TEST_FAIL_MESSAGE("shorter than its minimum");
    }
    if ((duty <= 0 && reference.pulse != 0) ||
        (duty >= reference.full && gap != 0)) {
        TEST_FAIL_MESSAGE("a pulse at 0 or a gap at full");
    }
    if (reference.carry < -(off - 1) * reference.full ||
        reference.carry > on * reference.full - 1) {
        TEST_FAIL_MESSAGE("the carry is out of its bounds");
    }
}

void test_step_random_calls_match_the_definition(void)
{
    numbers_seed(42);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        int16_t duty;

        if (numbers_one_in(500)) {
            numbers_tpo_config(&config);
            (void)init();
        } else if (numbers_one_in(500)) {
            reset();
        }
        duty = numbers_tpo_duty(config.full);
        if (reference.full != 0 && reference.at == 0) {
            (void)step(duty);
            check_window(duty);
        } else {
            (void)step(duty);
        }
    }
}

static void init_good(void)
{
    (void)fixpid_tpo_init(&tpo, &config);
}

static void init_bad(void)
{
    struct fixpid_tpo_config bad = config;

    bad.window = 0;
    (void)fixpid_tpo_init(&tpo, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_tpo, whole);

    TEST_ASSERT_EQUAL_UINT(padding, poison_left(&tpo, sizeof tpo, init_good));
    TEST_ASSERT_EQUAL_UINT(padding, poison_left(&tpo, sizeof tpo, init_bad));
    TEST_ASSERT_EQUAL_UINT(20, sizeof tpo);
}

// Nothing undefined comes of any bytes, which the sanitizers see, and the next
// reset makes them good.
void test_step_of_any_bytes_a_reset_makes_good(void)
{
    numbers_seed(20);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        numbers_fill(&tpo, sizeof tpo);
        tpo.window >>= 1;
        (void)fixpid_tpo_step(&tpo, numbers_int16());
        (void)fixpid_tpo_step(&tpo, numbers_int16());
        fixpid_tpo_reset(&tpo);
        TEST_ASSERT_EQUAL_INT32(0, tpo.credit);
        TEST_ASSERT_EQUAL_UINT16(0, tpo.left);
    }
}

void test_tpo_several_instances_keep_their_own_state(void)
{
    struct fixpid_tpo tpos[INSTANCES];
    struct reference_tpo references[INSTANCES];

    for (unsigned i = 0; i < INSTANCES; i++) {
        const struct fixpid_tpo_config each = {
            (int16_t)(100 + i), (uint16_t)(3 + i), (uint16_t)(i / 2), 1};

        TEST_ASSERT_TRUE(fixpid_tpo_init(&tpos[i], &each));
        TEST_ASSERT_TRUE(reference_tpo_init(&references[i], &each));
    }
    for (unsigned n = 0; n < 2000; n++) {
        const uint32_t i = numbers_below(INSTANCES);
        const int16_t duty = (int16_t)numbers_below(110);

        TEST_ASSERT_EQUAL(reference_tpo_step(&references[i], duty),
                          fixpid_tpo_step(&tpos[i], duty));
    }
}
