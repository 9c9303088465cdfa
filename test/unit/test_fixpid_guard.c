// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <string.h>

#include "fixpid_guard.h"
#include "numbers.h"
#include "numbers_control.h"
#include "poison.h"
#include "reference.h"
#include "reference_control.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("test/support/numbers_guard.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif

#define ROWS 1000

#define RISING FIXPID_GUARD_NOT_RISING
#define FALLING FIXPID_GUARD_NOT_FALLING
#define FROZEN FIXPID_GUARD_FROZEN
#define OSCILLATING FIXPID_GUARD_OSCILLATING
#define LOW FIXPID_GUARD_SENSOR_LOW
#define HIGH FIXPID_GUARD_SENSOR_HIGH
#define SETTLED FIXPID_GUARD_SETTLED
#define REFUSED FIXPID_GUARD_REFUSED

enum { EVENT_INIT = 1, EVENT_RESET, EVENT_ACKNOWLEDGE };

FIXPID_DATA struct fixpid_guard guard_controller;
static struct reference_guard reference;
static struct fixpid_guard_config config;
static int16_t setpoint;

void setUp(void)
{
    config = (struct fixpid_guard_config){
        .output_min = 0, .output_max = 160, .band = 4, .patience = 5};
    setpoint = 100;
}

void tearDown(void)
{
}

static void flags_are(unsigned flags)
{
    TEST_ASSERT_EQUAL_HEX8(flags, fixpid_guard_flags(&guard_controller));
    TEST_ASSERT_EQUAL_HEX8(flags, reference_guard_flags(&reference));
}

static bool init(void)
{
    const bool accepted = fixpid_guard_init(&guard_controller, &config);

    TEST_ASSERT_EQUAL(reference_guard_init(&reference, &config), accepted);
    flags_are(accepted ? 0 : REFUSED);
    return accepted;
}

static void begin(void)
{
    TEST_ASSERT_TRUE(init());
}

static void reset(void)
{
    fixpid_guard_reset(&guard_controller);
    reference_guard_reset(&reference);
}

static void acknowledge(void)
{
    fixpid_guard_acknowledge(&guard_controller);
    reference_guard_acknowledge(&reference);
}

static uint8_t step(int16_t measurement, int16_t output)
{
    const uint8_t flags =
        fixpid_guard_step(&guard_controller, setpoint, measurement, output);

    const unsigned defined =
        reference_guard_step(&reference, setpoint, measurement, output);

    if (flags != defined || flags != fixpid_guard_flags(&guard_controller)) {
        char text[100];
        snprintf(text, sizeof text,
                 "setpoint %d, measurement %d, output %d: "
                 "flags 0x%x, kept as 0x%x, 0x%x defined",
                 setpoint, measurement, output, flags,
                 fixpid_guard_flags(&guard_controller), defined);
        TEST_FAIL_MESSAGE(text);
    }
    return flags;
}

// Each of so many steps leaves these flags.
static void steps(unsigned count, int16_t measurement, int16_t output,
                  unsigned flags)
{
    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_HEX8(flags, step(measurement, output));
    }
}

// Edges: of each rule the last step without it, and the first with it.

void test_step_3_nearer_are_not_a_band(void)
{
    begin();
    steps(4, 50, 160, 0);
    steps(1, 53, 160, RISING);
    acknowledge();
    steps(4, 53, 160, 0); // the mark is 50
    steps(4, 54, 160, 0); // a band nearer: they count from here
    steps(9, 53, 159, 0); // not at the end
    steps(1, 52, 160, 0);
    steps(1, 52, 160, RISING);
}

void test_step_what_has_left_the_band_is_back_at_half_its_width(void)
{
    begin();
    steps(4, 96, 80, 0);
    steps(1, 96, 80, SETTLED);
    steps(1, 95, 80, 0);
    steps(5, 97, 80, 0);
    steps(4, 98, 80, 0);
    steps(1, 98, 80, SETTLED);
}

void test_step_half_of_an_odd_band_is_rounded_down(void)
{
    config.band = 5;
    begin();
    steps(1, 94, 80, 0);
    steps(9, 97, 80, 0);
    steps(4, 98, 80, 0);
    steps(1, 98, 80, SETTLED);
}

void test_step_inside_patience_steps_at_one_end_are_an_alarm(void)
{
    begin();
    steps(4, 98, 160, 0);
    steps(1, 102, 160, RISING);
    begin();
    steps(4, 98, 0, 0);
    steps(1, 102, 0, FALLING);
}

// Inside the band, with a reading that is not frozen.
static void inside(unsigned count, int16_t output, unsigned flags)
{
    for (unsigned i = 0; i < count; i++) {
        steps(1, (i % 2u == 0u) ? 98 : 102, output, flags);
    }
}

void test_step_inside_they_are_steps_in_a_row_at_the_same_end(void)
{
    begin();
    for (int turn = 0; turn < 3; turn++) {
        inside(4, 160, 0);
        inside(4, 0, 0);
    }
    begin();
    inside(4, 80, 0);
    inside(4, 160, 0); // what was counted to settle does not help them
    inside(1, 160, RISING);
    begin();
    inside(4, 160, 0);
    inside(8, 80, 0); // first back to 0, and then to settle
    inside(1, 80, SETTLED);
}

void test_step_inside_a_reading_that_is_the_setpoint_is_none(void)
{
    begin();
    steps(4, 100, 160, 0);
    steps(9, 100, 160, SETTLED);
}

void test_step_falling_is_watched_as_rising_is(void)
{
    begin();
    steps(9, 105, 160, 0);
    steps(4, 105, 0, 0);
    steps(1, 104, 0, FALLING);
}

void test_step_the_mark_is_where_it_was_farthest(void)
{
    begin();
    steps(1, 50, 160, 0);
    steps(1, 40, 160, 0);
    steps(2, 43, 160, 0);
    steps(5, 44, 160, 0); // the first is a band nearer
    steps(1, 44, 160, RISING);
    begin();
    steps(1, 150, 0, 0);
    steps(1, 160, 0, 0);
    steps(2, 157, 0, 0);
    steps(5, 156, 0, 0);
    steps(1, 156, 0, FALLING);
}

void test_step_an_output_beyond_an_end_counts_as_at_that_end(void)
{
    begin();
    steps(4, 50, INT16_MAX, 0);
    steps(1, 50, 161, RISING);
    begin();
    steps(4, 150, INT16_MIN, 0);
    steps(1, 150, -1, FALLING);
}

void test_step_at_the_other_end_nothing_counts_outside(void)
{
    begin();
    for (int16_t at = 0; at < 20; at++) {
        steps(1, (int16_t)(50 - at), 0, 0);
    }
    begin();
    for (int16_t at = 0; at < 20; at++) {
        steps(1, (int16_t)(150 + at), 160, 0);
    }
}

void test_step_saturation_while_the_reading_moves_is_no_fault(void)
{
    setpoint = 1000;
    begin();
    for (int16_t at = 0; at < 900; at++) { // a band in 4 steps, of 5
        steps(1, at, 160, 0);
    }
}

void test_step_a_new_setpoint_needs_no_call(void)
{
    begin();
    steps(4, 100, 80, 0);
    steps(1, 100, 80, SETTLED);
    setpoint = 200;
    steps(2, 101, 160, 0);
    for (int16_t at = 102; at < 199; at += 2) {
        (void)step(at, 160);
    }
    flags_are(0);
}

void test_step_frozen_where_the_output_is_more_than_a_quarter_away(void)
{
    begin();
    steps(4, 100, 80, 0);
    steps(2, 100, 80, SETTLED);  // now it was equal for 5 steps, at 80
    steps(4, 100, 121, SETTLED); // 41 away
    steps(20, 100, 120, SETTLED);
    steps(1, 100, 39, SETTLED | FROZEN);
}

void test_step_frozen_a_reading_that_moves_begins_anew(void)
{
    config.noisy = true;
    begin();
    for (int16_t turn = 0; turn < 5; turn++) {
        for (int at = 0; at < 10; at++) {
            TEST_ASSERT_EQUAL_HEX8(0, step((int16_t)(98 + turn), 80) & FROZEN);
        }
    }
    TEST_ASSERT_EQUAL_HEX8(FROZEN, step(102, 80) & FROZEN);
}

void test_step_noisy_sensor_is_frozen_after_twice_the_patience(void)
{
    config.noisy = true;
    begin();
    steps(4, 99, 80, 0);
    steps(6, 99, 80, SETTLED);
    steps(1, 99, 80, SETTLED | FROZEN);
    acknowledge();
    steps(9, 99, 80, SETTLED);
    steps(1, 99, 80, SETTLED | FROZEN);
}

void test_step_frozen_is_not_judged_beyond_reach(void)
{
    config.noisy = true;
    config.reach_min = 20;
    config.reach_max = 120;
    begin();
    setpoint = 121;
    (void)step(121, 80);
    for (int at = 0; at < 50; at++) {
        TEST_ASSERT_EQUAL_HEX8(0, step(121, 80) & FROZEN);
    }
    setpoint = 19;
    for (int at = 0; at < 50; at++) {
        TEST_ASSERT_EQUAL_HEX8(0, step(19, 80) & FROZEN);
    }
    acknowledge();
    setpoint = 20;
    (void)step(20, 80);
    for (int at = 0; at < 9; at++) {
        TEST_ASSERT_EQUAL_HEX8(0, step(20, 80) & FROZEN);
    }
    TEST_ASSERT_EQUAL_HEX8(FROZEN, step(20, 80) & FROZEN);
}

void test_step_reverse_exchanges_the_ends(void)
{
    config.reverse = true;
    begin();
    steps(6, 50, 160, 0);
    steps(4, 50, 0, 0);
    steps(1, 50, -1, RISING | FROZEN);
    begin();
    steps(9, 150, 0, 0);
    begin();
    steps(4, 150, 160, 0);
    steps(1, 150, 160, FALLING);
}

void test_step_setpoint_beyond_reach_counts_as_its_end(void)
{
    config.reach_min = 20;
    config.reach_max = 120;
    begin();
    setpoint = 200;
    steps(4, 118, 160, 0);
    steps(8, 118, 160, SETTLED);
    setpoint = 120;
    steps(4, 118, 160, SETTLED);
    steps(1, 118, 160, SETTLED | RISING);
    begin();
    setpoint = -200;
    steps(4, 22, 0, 0);
    steps(8, 22, 0, SETTLED);
    setpoint = 20;
    steps(4, 22, 0, SETTLED);
    steps(1, 22, 0, SETTLED | FALLING);
}

void test_step_setpoint_one_beyond_reach_counts_as_its_end(void)
{
    config.reach_min = 20;
    config.reach_max = 120;
    begin();
    setpoint = 121;
    steps(4, 118, 160, 0);
    steps(8, 118, 160, SETTLED);
    begin();
    setpoint = 19;
    steps(4, 22, 0, 0);
    steps(8, 22, 0, SETTLED);
}

// What was counted at rest does not run over.
void test_step_at_an_end_after_a_long_rest(void)
{
    begin();
    inside(1, 160, 0); // so that the end is the one before
    for (uint16_t at = 0; at < 33000u; at++) {
        (void)step((at % 2u == 0u) ? 98 : 102, 80);
    }
    inside(4, 160, SETTLED);
    inside(1, 160, SETTLED | RISING);
}

static void swing(unsigned times, unsigned flags)
{
    for (unsigned at = 0; at < times; at++) {
        (void)step((reference.zone == REFERENCE_BELOW) ? 105 : 95, 80);
    }
    flags_are(flags);
}

void test_step_oscillating_after_12_swings(void)
{
    begin();
    swing(1, 0); // and none yet
    swing(11, 0);
    swing(1, OSCILLATING);
    acknowledge();
    swing(11, 0);
    swing(1, OSCILLATING);
}

void test_step_what_goes_back_to_its_side_has_not_swung(void)
{
    begin();
    for (int turn = 0; turn < 20; turn++) {
        steps(1, 95, 80, 0);
        steps(1, 100, 80, 0);
    }
}

void test_step_a_setpoint_that_moves_by_more_than_a_band_begins_anew(void)
{
    begin();
    swing(12, 0);
    setpoint = 105; // 4 + 1
    swing(1, 0);
    begin();
    setpoint = 100;
    swing(12, 0);
    setpoint = 104; // 4: still the same
    swing(1, OSCILLATING);
}

void test_step_a_settled_loop_begins_anew(void)
{
    begin();
    swing(12, 0);
    steps(4, 100, 80, 0);
    steps(1, 100, 80, SETTLED);
    swing(1, 0);
    swing(11, 0);
    swing(1, OSCILLATING);
}

void test_step_4_readings_in_a_row_beyond_what_a_sensor_gives(void)
{
    config.measurement_min = 1;
    config.measurement_max = 1022;
    begin();
    steps(3, 0, 80, 0);
    steps(1, 1, 80, 0);
    steps(3, 0, 80, 0);
    steps(1, 0, 80, LOW);
    acknowledge();
    steps(3, 1023, 80, 0);
    steps(1, 1022, 80, 0);
    steps(3, 1023, 80, 0);
    steps(1, 1023, 80, HIGH);
    acknowledge();
    steps(3, -32768, 80, 0);
    steps(1, 32767, 80, HIGH); // what the fourth was
}

void test_step_without_a_range_any_reading_can_be(void)
{
    begin();
    steps(9, INT16_MIN, 80, 0);
    steps(9, INT16_MAX, 80, 0);
}

void test_step_by_hand_only_the_sensor_is_judged(void)
{
    config.measurement_min = 1;
    config.measurement_max = 1022;
    begin();
    for (int at = 0; at < 100; at++) {
        setpoint = (int16_t)(50 + at % 7);
        TEST_ASSERT_EQUAL_HEX8(0, step(setpoint, 160) & FIXPID_GUARD_ALARMS);
    }
    setpoint = 0;
    steps(3, 0, 160, SETTLED);
    steps(1, 0, 160, SETTLED | LOW);
}

void test_acknowledge_drops_all_that_is_on_its_way(void)
{
    config.measurement_min = 1;
    config.measurement_max = 1022;
    begin();
    steps(4, 50, 160, 0);
    acknowledge();
    steps(4, 50, 160, 0);
    steps(1, 50, 160, RISING);
    steps(4, 100, 160, RISING);
    steps(5, 100, 160, RISING | SETTLED);
    acknowledge();
    flags_are(SETTLED);
    steps(3, 0, 160, 0);
    acknowledge();
    steps(3, 0, 160, 0);
    swing(11, 0);
    acknowledge();
    swing(11, 0);
    swing(1, OSCILLATING);
}

void test_alarm_stays_set_until_it_is_acknowledged(void)
{
    begin();
    steps(4, 50, 160, 0);
    steps(1, 50, 160, RISING);
    steps(4, 100, 80, RISING);
    steps(50, 100, 80, RISING | SETTLED);
    reset();
    flags_are(0);
}

void test_reset_is_as_after_init(void)
{
    config.noisy = true;
    config.reverse = true;
    begin();
    for (int at = 0; at < 300; at++) {
        (void)step((int16_t)(50 + at / 3), (int16_t)(at % 200));
    }
    reset();
    flags_are(0);
    steps(6, 50, 160, 0);
    steps(4, 50, 0, 0);
    steps(1, 50, -1, RISING | FROZEN);
}

static void is_refused(void)
{
    const struct fixpid_guard_config bad = config;

    setUp();
    begin();
    steps(1, 50, 80, 0);
    config = bad;
    TEST_ASSERT_FALSE(init());
    steps(20, 50, 160, REFUSED);
    reset();
    flags_are(REFUSED);
    acknowledge();
    flags_are(REFUSED);
    steps(20, 50, 160, REFUSED);
    setUp();
}

void test_init_output_range_that_is_none_is_refused(void)
{
    config.output_min = 160;
    is_refused();
    config.output_min = 161;
    is_refused();
    config.output_min = INT16_MAX;
    config.output_max = INT16_MIN;
    is_refused();
    config.output_min = 159;
    begin();
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    begin();
}

void test_init_measurement_range_that_is_none_is_refused(void)
{
    config.measurement_min = 1;
    config.measurement_max = 1;
    is_refused();
    config.measurement_min = 1;
    config.measurement_max = 0;
    is_refused();
    config.measurement_min = 0;
    config.measurement_max = -1;
    is_refused();
    config.measurement_min = 1;
    config.measurement_max = 10;
    begin();
}

void test_init_reach_beyond_the_readings_is_refused(void)
{
    config.measurement_min = 1;
    config.measurement_max = 1022;
    config.reach_min = 1;
    config.reach_max = 1022;
    begin();
    config.reach_min = 0;
    is_refused();
    config.measurement_min = 1;
    config.measurement_max = 1022;
    config.reach_min = 1;
    config.reach_max = 1023;
    is_refused();
    config.reach_min = 200;
    config.reach_max = 100;
    is_refused();
    config.reach_min = INT16_MAX;
    config.reach_max = INT16_MIN;
    is_refused();
}

void test_init_reach_is_wider_than_two_bands(void)
{
    config.reach_min = 10;
    config.reach_max = 19;
    begin();
    config.reach_max = 18;
    is_refused();
    config.reach_min = INT16_MIN;
    config.reach_max = INT16_MAX;
    config.band = 32767;
    begin();
    config.reach_min = INT16_MIN + 1; // just two bands
    is_refused();
}

void test_init_band_and_patience_have_their_ranges(void)
{
    config.band = 0;
    is_refused();
    config.band = 32768;
    is_refused();
    config.band = 65535;
    is_refused();
    config.patience = 0;
    is_refused();
    config.patience = 1;
    is_refused();
    config.patience = 32768;
    is_refused();
    config.patience = 65535;
    is_refused();
    config.band = 1;
    config.patience = 2;
    begin();
    config.band = 32767;
    config.patience = 32767;
    begin();
}

void test_step_longest_patience(void)
{
    config.patience = 32767;
    config.noisy = true;
    begin();
    for (uint16_t at = 0; at < 32766u; at++) {
        (void)step(50, 160);
    }
    flags_are(0);
    steps(1, 50, 160, RISING);
    for (uint16_t at = 0; at < 32766u; at++) {
        (void)step(50, 160);
    }
    flags_are(RISING);
    (void)step(50, 160); // the first reading was a new one
    (void)step(50, 160);
    flags_are(RISING | FROZEN);
    begin();
    for (uint16_t at = 0; at < 32766u; at++) {
        (void)step(98, 0);
    }
    flags_are(0);
    steps(1, 98, 0, FALLING);
}

void test_step_widest_differences_do_not_wrap(void)
{
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    begin();
    setpoint = INT16_MAX;
    steps(4, INT16_MIN, INT16_MAX, 0);
    steps(1, INT16_MIN, INT16_MAX, RISING);
    steps(1, INT16_MAX - 5, INT16_MAX, RISING); // 65530 nearer
    setpoint = INT16_MIN;
    steps(4, INT16_MAX, INT16_MIN, RISING);
    steps(1, INT16_MAX, INT16_MIN, RISING | FALLING);
    begin();
    setpoint = 0;
    steps(4, 0, INT16_MIN, 0);
    steps(5, 0, INT16_MIN, SETTLED);
    steps(1, 0, INT16_MAX, SETTLED); // 65535 away: on its way to frozen
    steps(3, 0, INT16_MAX, SETTLED);
    steps(1, 0, INT16_MAX, SETTLED | FROZEN);
}

static void take_row(const int32_t row[])
{
    const unsigned options = (unsigned)row[GUARD_OPTIONS];

    config.output_min = (int16_t)row[GUARD_OUTPUT_MIN];
    config.output_max = (int16_t)row[GUARD_OUTPUT_MAX];
    config.measurement_min = (int16_t)row[GUARD_MEASUREMENT_MIN];
    config.measurement_max = (int16_t)row[GUARD_MEASUREMENT_MAX];
    config.reach_min = (int16_t)row[GUARD_REACH_MIN];
    config.reach_max = (int16_t)row[GUARD_REACH_MAX];
    config.band = (uint16_t)row[GUARD_BAND];
    config.patience = (uint16_t)row[GUARD_PATIENCE];
    config.reverse = (options & 0x80u) != 0u;
    config.noisy = (options & 0x40u) != 0u;
    if ((options & 0x3Fu) != 0u) { // it stands for what is refused
        config.patience = 0;
    }
    setpoint = (int16_t)row[GUARD_SETPOINT];
}

void test_step_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(guard);
    while (vectors_next(row)) {
        bool accepted = true;

        take_row(row);
        if (row[GUARD_EVENT] == EVENT_INIT) {
            accepted = init();
        } else if (row[GUARD_EVENT] == EVENT_RESET) {
            reset();
        } else if (row[GUARD_EVENT] == EVENT_ACKNOWLEDGE) {
            acknowledge();
        }
        TEST_ASSERT_EQUAL_INT32(row[GUARD_ACCEPTED], accepted);
        flags_are((unsigned)row[GUARD_FLAGS_BEFORE]);
        for (int32_t at = 0; at < row[GUARD_REPEAT]; at++) {
            (void)step((int16_t)row[GUARD_MEASUREMENT],
                       (int16_t)row[GUARD_OUTPUT]);
        }
        flags_are((unsigned)row[GUARD_FLAGS]);
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}

void test_step_random_calls_match_the_definition(void)
{
    struct numbers_guard now = {0, 0, 0};
    unsigned seen = 0;

    numbers_seed(43);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        if (i == 0 || numbers_one_in(500)) {
            numbers_guard_config(&config);
            (void)init();
        } else if (numbers_one_in(1000)) {
            reset();
        } else if (numbers_one_in(100)) {
            acknowledge();
        }
        numbers_guard_move(&now, &config);
        setpoint = now.setpoint;
        seen |= step(now.measurement, now.output);
    }
    TEST_ASSERT_EQUAL_HEX8(0xFF, seen); // each flag was
}

static void init_good(void)
{
    (void)fixpid_guard_init(&guard_controller, &config);
}

static void init_bad(void)
{
    struct fixpid_guard_config bad = config;

    bad.band = 0;
    (void)fixpid_guard_init(&guard_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    TEST_ASSERT_EQUAL_UINT(
        0, poison_left(&guard_controller, sizeof guard_controller, init_good));
    TEST_ASSERT_EQUAL_UINT(
        0, poison_left(&guard_controller, sizeof guard_controller, init_bad));
    TEST_ASSERT_EQUAL_UINT(32, sizeof guard_controller);
}

void test_step_all_zero_object_is_refused(void)
{
    static FIXPID_DATA const struct fixpid_guard zero;

    guard_controller = zero;
    TEST_ASSERT_EQUAL_HEX8(REFUSED, fixpid_guard_flags(&guard_controller));
    TEST_ASSERT_EQUAL_HEX8(REFUSED,
                           fixpid_guard_step(&guard_controller, 1, 2, 3));
    fixpid_guard_reset(&guard_controller);
    fixpid_guard_acknowledge(&guard_controller);
    TEST_ASSERT_EQUAL_HEX8(REFUSED,
                           fixpid_guard_step(&guard_controller, 1, 2, 3));
}

// Nothing undefined comes of any bytes, which the sanitizers see, and the next
// reset makes them good.
void test_step_of_any_bytes_a_reset_makes_good(void)
{
    numbers_seed(21);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        const int16_t any = numbers_int16();

        numbers_fill(&guard_controller, sizeof guard_controller);
        (void)fixpid_guard_step(&guard_controller, any, numbers_int16(),
                                numbers_int16());
        (void)fixpid_guard_step(&guard_controller, any, numbers_int16(),
                                numbers_int16());
        fixpid_guard_acknowledge(&guard_controller);
        fixpid_guard_reset(&guard_controller);
        TEST_ASSERT_EQUAL_HEX8(guard_controller.patience == 0u ? REFUSED : 0,
                               fixpid_guard_flags(&guard_controller));
    }
}

// From a model of the plant.

static struct fixpid_guard_model model;

// A plant of 10 bits, which full output of 255 counts raises by 700, with a lag
// of 1200 steps, a delay of 60 and a noise of half a count.
static void take_heater(void)
{
    static const struct fixpid_guard_model heater = {
        .slope_q24 = 38379, .dead_q4 = 960, .noise_q4 = 8, .gain_q8 = 703};

    model = heater;
    config.output_max = 255;
}

static bool from_model(void)
{
    struct fixpid_guard_config defined = config;
    const bool expected = reference_guard_from_model(&defined, &model);
    const bool accepted = fixpid_guard_from_model(&config, &model);

    if (accepted != expected || memcmp(&defined, &config, sizeof config) != 0) {
        char text[200];
        snprintf(text, sizeof text,
                 "slope %lu, dead %lu, noise %u, gain %lu, band %u: %d with "
                 "%u, %u, %u; %d with %u, %u, %u defined",
                 (unsigned long)model.slope_q24, (unsigned long)model.dead_q4,
                 model.noise_q4, (unsigned long)model.gain_q8, model.band,
                 accepted, config.band, config.patience, config.noisy, expected,
                 defined.band, defined.patience, defined.noisy);
        TEST_FAIL_MESSAGE(text);
    }
    return accepted;
}

static void rule_is(unsigned band, unsigned patience, bool noisy)
{
    TEST_ASSERT_TRUE(from_model());
    TEST_ASSERT_EQUAL_UINT(band, config.band);
    TEST_ASSERT_EQUAL_UINT(patience, config.patience);
    TEST_ASSERT_EQUAL(noisy, config.noisy);
}

// The result is false, and nothing is written.
static void has_no_guard(void)
{
    config.band = 7;
    config.patience = 9;
    config.noisy = true;
    TEST_ASSERT_FALSE(from_model());
    TEST_ASSERT_EQUAL_UINT(7, config.band);
    TEST_ASSERT_EQUAL_UINT(9, config.patience);
    TEST_ASSERT_TRUE(config.noisy);
}

void test_from_model_a_heater_and_its_guard(void)
{
    take_heater();
    config.measurement_min = 1;
    config.measurement_max = 1022;
    config.reverse = true;
    rule_is(8, 395, false); // 120 + 274.2
    TEST_ASSERT_EQUAL_INT16(0, config.output_min);
    TEST_ASSERT_EQUAL_INT16(255, config.output_max);
    TEST_ASSERT_EQUAL_INT16(1, config.measurement_min);
    TEST_ASSERT_EQUAL_INT16(1022, config.measurement_max);
    TEST_ASSERT_TRUE(config.reverse);
    TEST_ASSERT_TRUE(fixpid_guard_init(&guard_controller, &config));
}

void test_from_model_band_is_of_the_noise_or_of_two_counts(void)
{
    take_heater();
    model.noise_q4 = 9; // 8.5
    rule_is(9, 429, false);
    model.gain_q8 = 9 * 128;
    rule_is(9, 429, false);
    model.gain_q8 = 9 * 128 + 1;
    rule_is(10, 463, false);
    model.gain_q8 = UINT32_MAX; // it integrates
    rule_is(9, 429, false);
    model.gain_q8 = UINT32_MAX - 1u;
    has_no_guard();
}

void test_from_model_a_band_to_take_counts_in_the_patience(void)
{
    take_heater();
    model.band = 20;
    rule_is(20, 806, false); // 120 + 685.6
    model.band = 5;
    rule_is(5, 292, false); // 120 + 171.4
}

void test_from_model_more_bands_are_for_what_cools_slowly(void)
{
    take_heater();
    model.bands = 20;
    rule_is(8, 395, false);
    model.bands = 50;
    rule_is(8, 806, false); // 120 + 685.6
    model.bands = 255;
    rule_is(8, 3618, false);
    model.bands = 1;
    rule_is(8, 134, false);
    model.slope_q24 = UINT32_MAX;
    model.band = 32767;
    model.bands = 255;
    rule_is(32767, 248, false); // 120 + 127.99
}

void test_from_model_all_that_rounds_up_does_so_once(void)
{
    take_heater();
    config.output_max = 1;
    model.slope_q24 = 0x1000000; // a count per step
    model.dead_q4 = 9;           // 1.125
    model.band = 1;
    rule_is(1, 22, false);
    model.slope_q24 = 0x1000000 * UINT32_C(160) / 7 + 1u; // 20 bands in 7/8
    model.dead_q4 = 8 * 8;
    rule_is(1, 9, false);
    model.dead_q4++;
    rule_is(1, 9, false); // 9.000
    model.dead_q4++;
    rule_is(1, 10, false);
}

void test_from_model_noisy_of_a_count_and_16_steps(void)
{
    take_heater();
    model.noise_q4 = 15;
    rule_is(12, 532, false);
    model.noise_q4 = 16;
    rule_is(12, 532, true);
    model.slope_q24 = UINT32_MAX;
    model.dead_q4 = 15 * 8 - 1;
    rule_is(12, 15, false);
    model.dead_q4++;
    rule_is(12, 16, true);
}

void test_from_model_patience_at_both_ends(void)
{
    take_heater();
    model.slope_q24 = UINT32_MAX;
    model.dead_q4 = 0;
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    rule_is(8, 4, false);
    model.dead_q4 = 2 * 8;
    rule_is(8, 4, false);
    model.dead_q4 = 4 * 8;
    rule_is(8, 5, false);
    model.dead_q4 = UINT32_C(32767) * 8u - 1u;
    rule_is(8, 32767, false);
    model.dead_q4 = UINT32_C(32767) * 8u;
    has_no_guard();
    model.dead_q4 = UINT32_MAX;
    has_no_guard();
}

void test_from_model_a_plant_that_is_too_slow_is_refused(void)
{
    take_heater();
    model.dead_q4 = 0;
    model.slope_q24 = 322; // 32692.3
    rule_is(8, 32693, false);
    model.slope_q24 = 321;
    has_no_guard();
    model.slope_q24 = 1;
    has_no_guard();
    config.output_max = 1;
    model.band = 32767;
    has_no_guard();
    model.slope_q24 = 0;
    has_no_guard();
}

// 160 * 2^24 = 500719 * 5361 + 1
void test_from_model_the_least_above_a_whole_number_rounds_up(void)
{
    take_heater();
    config.output_max = 1;
    model.slope_q24 = 500719;
    model.band = 1;
    model.dead_q4 = 6;
    rule_is(1, 671, false); // (6 + 5362) / 8
    model.dead_q4 = 7;
    rule_is(1, 672, false);
}

// 160 bands * 2^24 / 65535 are between 40960 and 40961 eighths
void test_from_model_the_smallest_slope(void)
{
    take_heater();
    model.dead_q4 = 0;
    model.band = 1;
    model.slope_q24 = 1;
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    rule_is(1, 5121, false);
}

void test_from_model_widest_band(void)
{
    take_heater();
    model.slope_q24 = UINT32_MAX;
    model.band = 32767;
    rule_is(32767, 131, false);
    model.band = 32768;
    has_no_guard();
    model.band = 0;
    model.noise_q4 = 65526;
    rule_is(32767, 131, true);
    model.noise_q4 = 65527;
    has_no_guard();
}

void test_from_model_without_a_range_of_the_output_is_refused(void)
{
    take_heater();
    config.output_min = 255;
    has_no_guard();
    config.output_min = 256;
    has_no_guard();
    config.output_min = 254;
    model.slope_q24 = 0x1000000;
    rule_is(8, 280, false);
}

// Models that have a guard, and others.
static void draw_model(void)
{
    model.slope_q24 = numbers_any_size();
    model.dead_q4 = numbers_any_size();
    model.noise_q4 = (uint16_t)numbers_any_size();
    model.gain_q8 = numbers_any_size();
    model.band = 0;
    if (numbers_one_in(8)) {
        model.gain_q8 = UINT32_MAX;
    }
    if (numbers_one_in(4)) {
        model.band = (uint16_t)numbers_any_size();
    }
    model.bands = numbers_one_in(2) ? 0 : (uint8_t)numbers_next();
}

void test_from_model_random_models_match_the_definition(void)
{
    uint32_t accepted = 0;

    numbers_seed(47);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 10; i++) {
        draw_model();
        config.output_min = numbers_int16();
        config.output_max = numbers_int16();
        accepted += from_model() ? 1u : 0u;
    }
    TEST_ASSERT_TRUE(accepted > TEST_RANDOM_STEPS / 100);
}
