// SPDX-License-Identifier: MIT
// The recorded rows, and the start from rest. They are apart from the other
// tests of fixpid_pid, because an ATmega2560 has RAM for the names of so many
// only.
#include "fixpid_pid.h"
#include "pid_both.h"
#include "reference_pid.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_pid.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_check.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("test/support/reference.c")
TEST_SOURCE_FILE("test/support/numbers.c")
TEST_SOURCE_FILE("test/support/numbers_pid.c")

FIXPID_DATA struct fixpid_pid pid_controller;

void setUp(void)
{
    config = valve;
    TEST_ASSERT_TRUE(init());
}

void tearDown(void)
{
}

static void make_event(const int32_t row[])
{
    switch (row[PID_EVENT]) {
    case PID_NOTHING:
        break;
    case PID_INIT:
        TEST_ASSERT_TRUE(init());
        break;
    case PID_RESET:
        reset();
        break;
    case PID_SET_GAINS:
        TEST_ASSERT_TRUE(set_gains());
        break;
    case PID_SET_LIMITS:
        TEST_ASSERT_TRUE(set_limits(config.output_min, config.output_max));
        break;
    case PID_SET_INTEGRAL_LIMITS:
        TEST_ASSERT_TRUE(
            set_integral_limits(config.integral_min, config.integral_max));
        break;
    case PID_SET_FEEDFORWARD:
        set_feedforward((int16_t)row[PID_VALUE]);
        break;
    case PID_SET_MANUAL:
        set_manual((int16_t)row[PID_VALUE]);
        break;
    case PID_SET_AUTO:
        set_auto();
        break;
    case PID_SEED:
        seed((int16_t)row[PID_VALUE]);
        break;
    default:
        TEST_FAIL_MESSAGE("unknown event");
    }
}

void test_step_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(pid_definition);
    while (vectors_next(row)) {
        vectors_pid_config(&config, row);
        vectors_pid_set_options(
            &config, vectors_pid_options(row[PID_OPTIONS], row[PID_WEIGHT]));
        make_event(row);
        TEST_ASSERT_EQUAL_INT16(
            row[PID_OUTPUT],
            step((int16_t)row[PID_SETPOINT], (int16_t)row[PID_MEASUREMENT]));
        TEST_ASSERT_EQUAL_INT32(row[PID_P],
                                fixpid_pid_proportional(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(row[PID_I], integral());
        TEST_ASSERT_EQUAL_INT32(row[PID_D],
                                fixpid_pid_derivative(&pid_controller));
        TEST_ASSERT_EQUAL_HEX8(row[PID_STATUS], flags() & VECTORS_PID_FLAGS);
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(2000, rows);
}

static void after_the_step(const int32_t row[])
{
    const int16_t value = (int16_t)row[TRACK_VALUE3];

    switch (row[TRACK_EVENT2]) {
    case PID_NOTHING:
        break;
    case PID_RESET:
        reset();
        break;
    case PID_SET_MANUAL:
        set_manual(value);
        break;
    case PID_SET_AUTO:
        set_auto();
        break;
    case PID_SEED:
        seed(value);
        break;
    default:
        TEST_FAIL_MESSAGE("unknown event");
    }
    if (row[TRACK_TRACKED] != 0) {
        track((int16_t)row[TRACK_APPLIED], (uint8_t)row[TRACK_SHIFT]);
    }
}

// Compares the rows of a file with track.csv's columns; returns their number.
static unsigned rows_with_two_events(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    while (vectors_next(row)) {
        vectors_pid_config(&config, row);
        TEST_ASSERT_EQUAL(row[TRACK_ACCEPTED] != 0, before_the_step(row));
        TEST_ASSERT_EQUAL_INT16(row[TRACK_OUTPUT],
                                step((int16_t)row[TRACK_SETPOINT],
                                     (int16_t)row[TRACK_MEASUREMENT]));
        after_the_step(row);
        TEST_ASSERT_EQUAL_INT16(row[TRACK_LAST_OUTPUT],
                                fixpid_pid_output(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(row[TRACK_P],
                                fixpid_pid_proportional(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(row[TRACK_I], integral());
        TEST_ASSERT_EQUAL_INT32(row[TRACK_D],
                                fixpid_pid_derivative(&pid_controller));
        TEST_ASSERT_EQUAL_HEX8(row[TRACK_STATUS], flags());
        rows++;
    }
    return rows;
}

void test_track_recorded_rows_match_the_definition(void)
{
    VECTORS_OPEN(track);
    TEST_ASSERT_EQUAL_UINT(1000, rows_with_two_events());
}

void test_step_recorded_rows_of_the_start_match_the_definition(void)
{
    VECTORS_OPEN(rest);
    TEST_ASSERT_EQUAL_UINT(600, rows_with_two_events());
}

// The output would be the feed-forward, or what its range has nearest to that.
void test_rest_integral_is_what_the_feedforward_lacks_to_the_range(void)
{
    static const struct {
        int16_t output_min, output_max, feedforward, integral;
    } rows[] = {{1000, 2000, 0, 1000},
                {50, 100, 0, 50},
                {-2000, -1000, 0, -1000},
                {0, 255, 0, 0},
                {0, 255, 20, 0},
                {0, 255, 255, 0},
                {0, 255, 300, -45},
                {0, 255, -1, 1},
                {1000, 2000, 1500, 0},
                {1000, 2000, -500, 1500},
                {-2000, -1000, 5, -1005},
                {-32768, 32767, -32768, 0},
                {32766, 32767, -32768, 32767}};

    config.proportional_on_measurement = true;
    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        config.output_min = rows[n].output_min;
        config.output_max = rows[n].output_max;
        TEST_ASSERT_TRUE(init());
        set_feedforward(INT16_MAX); // is forgotten
        set_feedforward(rows[n].feedforward);
        TEST_ASSERT_EQUAL_INT32(rows[n].integral * INT32_C(65536), integral());
        config.output_min = 7; // the same by another way
        config.output_max = 8;
        TEST_ASSERT_TRUE(init());
        set_feedforward(rows[n].feedforward);
        TEST_ASSERT_TRUE(set_limits(rows[n].output_min, rows[n].output_max));
        TEST_ASSERT_EQUAL_INT32(rows[n].integral * INT32_C(65536), integral());
    }
}

void test_rest_integral_stays_within_its_own_limits(void)
{
    config.output_min = 1000;
    config.output_max = 2000;
    config.integral_min = -300;
    config.integral_max = 300;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT32(300 * INT32_C(65536), integral());
    set_feedforward(2500);
    TEST_ASSERT_EQUAL_INT32(-300 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_limits(-2, -1));
    set_feedforward(0);
    TEST_ASSERT_EQUAL_INT32(-INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(0, 5));
    TEST_ASSERT_EQUAL_INT32(0, integral());
    reset();
    TEST_ASSERT_EQUAL_INT32(0, integral());
}

// A range without 0 is where the loop starts, and not what it has to reach.
void test_step_range_without_0_moves_in_the_first_step(void)
{
    static const struct {
        int16_t output_min, output_max;
    } rows[] = {{1000, 2000}, {50, 100}, {30, 70}};

    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        config.output_min = rows[n].output_min;
        config.output_max = rows[n].output_max;
        TEST_ASSERT_TRUE(init());
        TEST_ASSERT_EQUAL_INT16(rows[n].output_min + 21, step(10, 0));
        TEST_ASSERT_EQUAL_HEX8(0, flags());
    }
    config.output_min = -2000;
    config.output_max = -1000;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(-1021, step(-10, 0));
}

// Where the setpoint is the measurement, the output is at rest; beside it there
// is b * kp * (r - y).
void test_step_first_one_with_a_weight_starts_from_rest(void)
{
    for (uint16_t weight = 0; weight < 256; weight++) {
        config.output_min = -32768;
        config.output_max = 32767;
        config.setpoint_weight_q8 = weight;
        config.proportional_on_measurement = weight == 0u;
        config.reverse = (weight & 2u) != 0u;
        TEST_ASSERT_TRUE(init());
        set_feedforward(100);
        TEST_ASSERT_EQUAL_INT16(100, step(300, 300));
        TEST_ASSERT_EQUAL_INT16(100, step(300, 300));
        reset();
        TEST_ASSERT_INT16_WITHIN(
            3, (config.reverse ? -1 : 1) * (100 * weight / 128 + 5),
            step(400, 300));
    }
}

void test_step_first_one_with_a_weight_keeps_the_integral_within_its_limits(
    void)
{
    static const int16_t ends[] = {INT16_MIN, INT16_MIN + 1, -1,       0,
                                   1,         INT16_MAX - 1, INT16_MAX};

    config.gains.kp_q8 = 32767;
    config.proportional_on_measurement = true;
    for (unsigned n = 0; n < 2 * sizeof ends / sizeof ends[0]; n++) {
        const int16_t y = ends[n / 2];

        config.reverse = n % 2 != 0;
        config.integral_min = 0;
        config.integral_max = 0;
        TEST_ASSERT_TRUE(init());
        step(y, y);
        config.integral_min = -20;
        config.integral_max = 30;
        TEST_ASSERT_TRUE(init());
        step(y, y);
    }
    config.gains.kp_q8 = 256;
    config.reverse = false;
    TEST_ASSERT_TRUE(init());
    step(30, 30);
    TEST_ASSERT_EQUAL_INT32(30 * INT32_C(65536), integral());
    reset();
    step(29, 29);
    TEST_ASSERT_EQUAL_INT32(29 * INT32_C(65536), integral());
    reset();
    step(-20, -20);
    TEST_ASSERT_EQUAL_INT32(-20 * INT32_C(65536), integral());
    reset();
    step(-21, -21);
    TEST_ASSERT_EQUAL_INT32(-20 * INT32_C(65536), integral());
    reset();
    step(31, 31);
    TEST_ASSERT_EQUAL_INT32(30 * INT32_C(65536), integral());
    config.gains.kp_q8 = 384;
    config.integral_min = -32;
    config.integral_max = 31;
    TEST_ASSERT_TRUE(init());
    step(21, 21); // 31.5
    TEST_ASSERT_EQUAL_INT32(31 * INT32_C(65536), integral());
    reset();
    step(-21, -21);
    TEST_ASSERT_EQUAL_INT32(-32 * INT32_C(65536) + 32768, integral());
    config.gains.ki_q24 = 0;
    TEST_ASSERT_TRUE(init());
    pid_controller.integral_fraction = 0x80; // as from a state's bytes
    (void)fixpid_pid_step(&pid_controller, 9, 9);
    TEST_ASSERT_EQUAL_HEX8(0, pid_controller.integral_fraction);
}

// Held before the first step: it starts from what is held, as it always did.
void test_rest_what_is_held_before_the_first_step_stays(void)
{
    config.setpoint_weight_q8 = 64;
    TEST_ASSERT_TRUE(init());
    seed(90);
    set_feedforward(40);
    TEST_ASSERT_EQUAL_INT32(90 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_limits(10, 80));
    TEST_ASSERT_EQUAL_INT32(80 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(0, 5));
    TEST_ASSERT_EQUAL_INT32(80 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(0, 0));
    TEST_ASSERT_EQUAL_INT16(80, step(500, 450));
    TEST_ASSERT_EQUAL_INT16(80, step(500, 450)); // not at rest once more
    reset();
    set_manual(33);
    set_feedforward(7);
    TEST_ASSERT_EQUAL_INT16(33, step(500, 450));
    set_auto();
    TEST_ASSERT_EQUAL_INT16(33, step(500, 450));
    reset();
    set_manual(44);
    set_auto();
    TEST_ASSERT_EQUAL_INT16(44, step(500, 450));
}

// A feed-forward that changes once the loop runs is added, and nothing else.
void test_rest_ends_with_the_first_step(void)
{
    step(0, 0);
    set_feedforward(300);
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_TRUE(set_limits(100, 200));
    TEST_ASSERT_EQUAL_INT32(-100 * INT32_C(65536), integral());
    reset();
    set_manual(50);
    step(0, 0);
    set_auto();
    set_feedforward(10);
    TEST_ASSERT_EQUAL_INT32(100 * INT32_C(65536), integral());
}
