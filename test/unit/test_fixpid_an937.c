// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"
#include "numbers.h"
#include "plain_c_an937.h"
#include "poison.h"
#include "reference.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("src/an937/fixpid_an937.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif

FIXPID_DATA struct fixpid_an937 an937_controller;
static struct reference_an937 reference;

static const struct fixpid_an937_config motor = {96, 80, 16, 4000, 4};

static void start(uint8_t kp, uint8_t ki, uint8_t kd, uint16_t limit,
                  uint8_t period)
{
    const struct fixpid_an937_config config = {kp, ki, kd, limit, period};

    fixpid_an937_init(&an937_controller, &config);
    reference_an937_init(&reference, kp, ki, kd, limit, period);
}

static void tick(void)
{
    fixpid_an937_tick(&an937_controller);
    reference_an937_tick(&reference);
}

// One step of both, everything compared.
static int32_t step(int16_t error)
{
    const int64_t expected = reference_an937_step(&reference, error);
    const int32_t output = fixpid_an937_step(&an937_controller, error);

    TEST_ASSERT_EQUAL_INT32(expected, output);
    TEST_ASSERT_EQUAL_INT32(reference.proportional,
                            fixpid_an937_proportional(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(reference.integral,
                            fixpid_an937_integral(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(reference.derivative,
                            fixpid_an937_derivative(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(reference.accumulated,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(reference_an937_stat1(&reference),
                           fixpid_an937_stat1(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(reference.delta == 0 ? FIXPID_AN937_D_ERR_Z : 0,
                           fixpid_an937_stat2(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(
        (reference.saturated ? FIXPID_AN937_SUM_SATURATED : 0) |
            (reference.limited ? FIXPID_AN937_ACCUMULATED_ERROR_LIMITED : 0) |
            (reference.overrun ? FIXPID_AN937_TICK_OVERRUN : 0),
        fixpid_an937_flags(&an937_controller));
    return output;
}

static int32_t tick_and_step(int16_t error)
{
    tick();
    return step(error);
}

void setUp(void)
{
    numbers_seed(937);
    start(motor.kp_q4, motor.ki_q4, motor.kd_q4, motor.accumulated_error_limit,
          motor.derivative_period_ticks);
}

void tearDown(void)
{
}

void test_step_recorded_rows_match_the_firmware(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    int32_t run = -1;
    unsigned rows = 0;

    VECTORS_OPEN(an937_firmware);
    while (vectors_next(row)) {
        const uint8_t kp = (uint8_t)row[AN937_KP];
        const uint8_t ki = (uint8_t)row[AN937_KI];
        const uint8_t kd = (uint8_t)row[AN937_KD];

        if (row[AN937_RUN] != run) {
            run = row[AN937_RUN];
            start(kp, ki, kd, 4000, 4);
        }
        TEST_ASSERT_TRUE(fixpid_an937_set_gains(&an937_controller, kp, ki, kd));
        if (row[AN937_TICK] != 0) {
            fixpid_an937_tick(&an937_controller);
        }
        TEST_ASSERT_NOT_EQUAL(0, row[AN937_ERROR]); // as docs/migrating.md says
        TEST_ASSERT_EQUAL_INT32(
            row[AN937_PID_OUT],
            fixpid_an937_step(&an937_controller, (int16_t)row[AN937_ERROR]));
        TEST_ASSERT_EQUAL_INT32(
            row[AN937_A_ERROR],
            fixpid_an937_accumulated_error(&an937_controller));
        TEST_ASSERT_EQUAL_INT32(row[AN937_ERROR] < 0 ? -row[AN937_PROP]
                                                     : row[AN937_PROP],
                                fixpid_an937_proportional(&an937_controller));
        TEST_ASSERT_EQUAL_INT32(row[AN937_A_ERROR] < 0 ? -row[AN937_INTEG]
                                                       : row[AN937_INTEG],
                                fixpid_an937_integral(&an937_controller));
        TEST_ASSERT_EQUAL_INT32(row[AN937_D_ERROR] < 0 ? -row[AN937_DERIV]
                                                       : row[AN937_DERIV],
                                fixpid_an937_derivative(&an937_controller));
        TEST_ASSERT_EQUAL_INT32(row[AN937_D_ERROR] * kd,
                                fixpid_an937_derivative(&an937_controller));
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(2000, rows);
}

void test_step_worked_example_gives_the_table(void)
{
    TEST_ASSERT_EQUAL_INT32(2880, tick_and_step(240));
    TEST_ASSERT_EQUAL_INT32(240,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(23040,
                            fixpid_an937_proportional(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(19200, fixpid_an937_integral(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(3840, fixpid_an937_derivative(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(2880, step(240));
    TEST_ASSERT_EQUAL_INT32(3640, tick_and_step(200));
    TEST_ASSERT_EQUAL_INT32(440,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(19200,
                            fixpid_an937_proportional(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(35200, fixpid_an937_integral(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(1340, tick_and_step(-100));
    TEST_ASSERT_EQUAL_INT32(340,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(-9600,
                            fixpid_an937_proportional(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(27200, fixpid_an937_integral(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(140, step(-300));
    TEST_ASSERT_EQUAL_INT32(-28800,
                            fixpid_an937_proportional(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(3840, fixpid_an937_derivative(&an937_controller));
}

// AN937 Table 2: of 10, 8, 12, 9, 6, 4 % only the third and the last meet a
// tick. One percent is 40 counts.
void test_step_errors_of_table_2_accumulate_on_ticks_only(void)
{
    static const struct {
        int16_t percent;
        bool tick;
        int16_t accumulated_percent;
    } rows[] = {{10, false, 0}, {8, false, 0},  {12, true, 12},
                {9, false, 12}, {6, false, 12}, {4, true, 16}};

    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (rows[i].tick) {
            tick();
        }
        step((int16_t)(40 * rows[i].percent));
        TEST_ASSERT_EQUAL_INT32(
            40 * rows[i].accumulated_percent,
            fixpid_an937_accumulated_error(&an937_controller));
    }
}

// The note's motor: 96/80/16, and 144 once it runs near its set speed.
void test_set_gains_motor_goes_to_144_and_the_output_jumps_by_the_law(void)
{
    int32_t before;

    for (int i = 0; i < 10; i++) {
        tick_and_step(150);
    }
    before = step(0);
    TEST_ASSERT_TRUE(fixpid_an937_set_gains(&an937_controller, 96, 144, 16));
    reference.ki = 144;
    TEST_ASSERT_EQUAL_INT32(1500,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(before + INT32_C(64) * 1500 / 16, step(0));
}

// docs/migrating.md: the firmware gives a shrinking error the sign of the
// error.
void test_step_error_shrinks_derivative_pushes_against_proportional(void)
{
    tick_and_step(1000);
    for (int i = 0; i < 4; i++) {
        tick_and_step(400);
    }
    TEST_ASSERT_EQUAL_INT32(16 * (400 - 1000),
                            fixpid_an937_derivative(&an937_controller));
    TEST_ASSERT_GREATER_THAN_INT32(
        0, fixpid_an937_proportional(&an937_controller));
}

// docs/migrating.md: the firmware holds its output and skips the tick.
void test_step_error_zero_is_computed_like_any_other(void)
{
    tick_and_step(100);
    for (int i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_INT32((80 * 100 + 16 * (i < 3 ? 100 : -100)) / 16,
                                tick_and_step(0));
    }
}

void test_step_first_tick_takes_a_derivative_sample(void)
{
    tick_and_step(7);
    TEST_ASSERT_EQUAL_INT32(16 * 7, fixpid_an937_derivative(&an937_controller));
}

void test_step_derivative_is_sampled_every_period(void)
{
    for (int i = 0; i < 20; i++) {
        tick_and_step((int16_t)(i * i));
        TEST_ASSERT_EQUAL_INT32(i < 4
                                    ? 0
                                    : 16 * ((i / 4 * 4) * (i / 4 * 4) -
                                            (i / 4 * 4 - 4) * (i / 4 * 4 - 4)),
                                fixpid_an937_derivative(&an937_controller));
    }
}

void test_step_output_is_truncated_toward_zero(void)
{
    start(1, 0, 0, 1, 1);
    TEST_ASSERT_EQUAL_INT32(0, step(15));
    TEST_ASSERT_EQUAL_INT32(0, step(-15));
    TEST_ASSERT_EQUAL_INT32(-1, step(-16));
    TEST_ASSERT_EQUAL_INT32(-1, step(-31));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_stat1(&an937_controller) &
                                  FIXPID_AN937_PID_SIGN);
}

void test_step_sum_saturates_at_24_bits_on_both_sides(void)
{
    start(255, 255, 255, 65535, 1);
    tick_and_step(INT16_MIN);
    TEST_ASSERT_EQUAL_INT32(-1048575, tick_and_step(INT16_MIN));
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_SUM_SATURATED,
                          fixpid_an937_flags(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_stat1(&an937_controller) &
                                  FIXPID_AN937_PID_SIGN);
    start(255, 255, 255, 65535, 1);
    tick_and_step(INT16_MAX);
    TEST_ASSERT_EQUAL_INT32(1048575, tick_and_step(INT16_MAX));
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_SUM_SATURATED,
                          fixpid_an937_flags(&an937_controller));
    step(0);
    TEST_ASSERT_BITS_LOW(FIXPID_AN937_SUM_SATURATED,
                         fixpid_an937_flags(&an937_controller));
}

void test_step_sum_at_the_limit_is_not_flagged_and_one_beyond_is(void)
{
    start(255, 1, 0, 65535, 255);
    tick_and_step(INT16_MAX);
    tick_and_step(INT16_MAX);
    tick_and_step(1);
    TEST_ASSERT_EQUAL_INT32(65535,
                            fixpid_an937_accumulated_error(&an937_controller));
    fixpid_an937_set_gains(&an937_controller, 255, 129, 0);
    reference.ki = 129;
    step(32641); // 255 * 32641 + 129 * 65535 = 16777470
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_SUM_SATURATED,
                          fixpid_an937_flags(&an937_controller));
    step(32640); // 16777215 = 2^24 - 1
    TEST_ASSERT_BITS_LOW(FIXPID_AN937_SUM_SATURATED,
                         fixpid_an937_flags(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(1048575, step(32640));
    fixpid_an937_set_gains(&an937_controller, 1, 255, 0);
    reference.kp = 1;
    reference.ki = 255;
    step(32767); // 32767 + 255 * 65535 = 16744192
    TEST_ASSERT_BITS_LOW(FIXPID_AN937_SUM_SATURATED,
                         fixpid_an937_flags(&an937_controller));
}

void test_flags_sum_and_accumulated_error_limited_at_once_are_both_set(void)
{
    start(255, 255, 255, 65535, 1);
    tick_and_step(INT16_MAX);
    tick_and_step(INT16_MAX);
    tick_and_step(INT16_MAX);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN937_SUM_SATURATED |
                               FIXPID_AN937_ACCUMULATED_ERROR_LIMITED,
                           fixpid_an937_flags(&an937_controller));
}

void test_step_accumulated_error_at_the_limit_is_not_flagged(void)
{
    tick_and_step(4000);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    tick_and_step(1);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN937_ACCUMULATED_ERROR_LIMITED,
                           fixpid_an937_flags(&an937_controller));
    step(1);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    for (int i = 0; i < 9; i++) {
        tick_and_step(-1000);
    }
    TEST_ASSERT_EQUAL_INT32(-4000,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN937_ACCUMULATED_ERROR_LIMITED,
                           fixpid_an937_flags(&an937_controller));
}

void test_step_widest_limit_holds_65535_and_flags_the_carry(void)
{
    start(1, 1, 1, 65535, 1);
    tick_and_step(INT16_MIN);
    tick_and_step(-32767);
    TEST_ASSERT_EQUAL_INT32(-65535,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    tick_and_step(INT16_MIN);
    TEST_ASSERT_EQUAL_INT32(-65535,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN937_ACCUMULATED_ERROR_LIMITED,
                           fixpid_an937_flags(&an937_controller));
}

void test_step_limit_of_one_is_legal(void)
{
    start(16, 16, 16, 1, 1);
    TEST_ASSERT_EQUAL_INT32(201, tick_and_step(100));
    TEST_ASSERT_EQUAL_INT32(-301, tick_and_step(-100));
}

void test_step_opposite_errors_bring_the_accumulated_error_to_positive_zero(
    void)
{
    tick_and_step(-500);
    tick_and_step(500);
    TEST_ASSERT_EQUAL_INT32(0,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_A_ERR_SIGN | FIXPID_AN937_A_ERR_ZERO,
                          fixpid_an937_stat1(&an937_controller));
}

void test_step_nasty_errors_crossed_match_the_reference(void)
{
    static const uint8_t gains[] = {0, 1, 16, 127, 128, 255};
    static const uint16_t limits[] = {1, 4000, 65535};

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            const uint8_t gain = gains[(i + j) % 6];
            start(gains[i % 6], gain, gains[j % 6], limits[(i * 3 + j) % 3], 1);
            tick_and_step(nasty[i]);
            tick_and_step(nasty[j]);
            step(nasty[i]);
            tick_and_step(nasty[i]);
        }
    }
}

void test_step_random_runs_match_the_reference(void)
{
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        if (numbers_below(200) == 0) {
            start((uint8_t)numbers_next(), (uint8_t)numbers_next(),
                  (uint8_t)numbers_next(),
                  (uint16_t)(1 + numbers_below(65535) / (1 + i % 20)),
                  (uint8_t)(1 + numbers_below(i % 2 != 0 ? 255 : 5)));
        }
        if (numbers_below(3) != 0) {
            tick();
        }
        if (numbers_below(8) != 0) {
            step(numbers_int16());
        }
    }
}

// The form that tools/cost compares with does the same work.
void test_step_random_runs_match_the_straightforward_form(void)
{
    struct plain_c_an937 plain;

    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 4; i++) {
        const struct fixpid_an937_config config = {
            (uint8_t)numbers_next(), (uint8_t)numbers_next(),
            (uint8_t)numbers_next(), (uint16_t)(1 + numbers_below(65535)),
            (uint8_t)(1 + numbers_below(5))};
        const int16_t error = numbers_int16();

        if (i % 50 == 0) {
            fixpid_an937_init(&an937_controller, &config);
            plain_c_an937_init(&plain, &config);
        }
        for (uint32_t ticks = numbers_below(4); ticks > 1; ticks--) {
            fixpid_an937_tick(&an937_controller);
            plain_c_an937_tick(&plain);
        }
        TEST_ASSERT_EQUAL_INT32(plain_c_an937_step(&plain, error),
                                fixpid_an937_step(&an937_controller, error));
        TEST_ASSERT_EQUAL_INT32(
            plain.accumulated_error,
            fixpid_an937_accumulated_error(&an937_controller));
        TEST_ASSERT_EQUAL_INT32(plain.config.kd_q4 * plain.delta,
                                fixpid_an937_derivative(&an937_controller));
        TEST_ASSERT_EQUAL_HEX8(
            (plain.sum_saturated ? FIXPID_AN937_SUM_SATURATED : 0) |
                (plain.accumulated_error_limited
                     ? FIXPID_AN937_ACCUMULATED_ERROR_LIMITED
                     : 0) |
                (plain.tick_overrun ? FIXPID_AN937_TICK_OVERRUN : 0),
            fixpid_an937_flags(&an937_controller));
        TEST_ASSERT_EQUAL(plain.sum >= 0,
                          (fixpid_an937_stat1(&an937_controller) &
                           FIXPID_AN937_PID_SIGN) != 0u);
    }
}

void test_set_gains_at_every_step_matches_the_reference(void)
{
    for (unsigned i = 0; i < 2000; i++) {
        const uint8_t kp = (uint8_t)numbers_next();
        const uint8_t ki = (uint8_t)numbers_next();
        const uint8_t kd = (uint8_t)numbers_next();

        TEST_ASSERT_TRUE(fixpid_an937_set_gains(&an937_controller, kp, ki, kd));
        reference.kp = kp;
        reference.ki = ki;
        reference.kd = kd;
        tick_and_step(numbers_int16());
    }
}

void test_set_accumulated_error_limit_acts_at_the_next_tick(void)
{
    tick_and_step(3000);
    TEST_ASSERT_TRUE(
        fixpid_an937_set_accumulated_error_limit(&an937_controller, 1000));
    reference.limit = 1000;
    step(-100);
    TEST_ASSERT_EQUAL_INT32(3000,
                            fixpid_an937_accumulated_error(&an937_controller));
    tick_and_step(-100);
    TEST_ASSERT_EQUAL_INT32(1000,
                            fixpid_an937_accumulated_error(&an937_controller));
}

void test_set_accumulated_error_limit_zero_is_refused_and_changes_nothing(void)
{
    TEST_ASSERT_FALSE(
        fixpid_an937_set_accumulated_error_limit(&an937_controller, 0));
    tick_and_step(4000);
    tick_and_step(4000);
    TEST_ASSERT_EQUAL_INT32(4000,
                            fixpid_an937_accumulated_error(&an937_controller));
}

void test_set_derivative_period_acts_when_the_countdown_ends(void)
{
    tick_and_step(0);
    TEST_ASSERT_TRUE(fixpid_an937_set_derivative_period(&an937_controller, 2));
    reference.period = 2;
    for (int i = 1; i < 12; i++) {
        tick_and_step((int16_t)(100 * i));
    }
}

void test_set_derivative_period_zero_is_refused_and_changes_nothing(void)
{
    TEST_ASSERT_FALSE(fixpid_an937_set_derivative_period(&an937_controller, 0));
    for (int i = 1; i < 12; i++) {
        tick_and_step((int16_t)(100 * i));
    }
}

void test_step_longest_period_samples_every_255_ticks(void)
{
    start(0, 0, 16, 1, 255);
    tick_and_step(10);
    for (int i = 0; i < 254; i++) {
        TEST_ASSERT_EQUAL_INT32(10, tick_and_step(30));
    }
    TEST_ASSERT_EQUAL_INT32(20, tick_and_step(30));
}

static void assert_refused(void)
{
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        fixpid_an937_tick(&an937_controller);
        TEST_ASSERT_EQUAL_INT32(0,
                                fixpid_an937_step(&an937_controller, nasty[i]));
    }
    TEST_ASSERT_EQUAL_INT8(0,
                           fixpid_an937_step_percent(&an937_controller, 100));
    TEST_ASSERT_FALSE(fixpid_an937_set_gains(&an937_controller, 255, 255, 255));
    TEST_ASSERT_FALSE(
        fixpid_an937_set_accumulated_error_limit(&an937_controller, 4000));
    TEST_ASSERT_FALSE(fixpid_an937_set_derivative_period(&an937_controller, 4));
    fixpid_an937_reset(&an937_controller);
    fixpid_an937_tick(&an937_controller);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_an937_step(&an937_controller, 4000));
    TEST_ASSERT_TRUE(fixpid_an937_init(&an937_controller, &motor));
    TEST_ASSERT_EQUAL_INT32(6, fixpid_an937_step(&an937_controller, 1));
}

void test_init_limit_zero_is_refused(void)
{
    const struct fixpid_an937_config config = {96, 80, 16, 0, 4};

    TEST_ASSERT_FALSE(fixpid_an937_init(&an937_controller, &config));
    assert_refused();
}

void test_init_period_zero_is_refused(void)
{
    const struct fixpid_an937_config config = {96, 80, 16, 4000, 0};

    TEST_ASSERT_FALSE(fixpid_an937_init(&an937_controller, &config));
    assert_refused();
}

void test_step_all_zero_object_outputs_zero(void)
{
    static const struct fixpid_an937 nothing;

    an937_controller = nothing;
    assert_refused();
}

void test_init_extremes_are_accepted(void)
{
    static const struct fixpid_an937_config least = {0, 0, 0, 1, 1};
    static const struct fixpid_an937_config most = {255, 255, 255, 65535, 255};

    TEST_ASSERT_TRUE(fixpid_an937_init(&an937_controller, &least));
    TEST_ASSERT_TRUE(fixpid_an937_init(&an937_controller, &most));
}

void test_init_starts_from_rest(void)
{
    tick_and_step(4000);
    tick();
    tick();
    start(96, 80, 16, 4000, 4);
    TEST_ASSERT_EQUAL_HEX8(0xDF, fixpid_an937_stat1(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0x04, fixpid_an937_stat2(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    step(100);
    tick_and_step(100);
}

void test_reset_clears_the_state_and_keeps_the_configuration(void)
{
    tick_and_step(-4000);
    tick_and_step(-4000);
    tick();
    tick();
    fixpid_an937_reset(&an937_controller);
    reference_an937_init(&reference, 96, 80, 16, 4000, 4);
    TEST_ASSERT_EQUAL_HEX8(0xDF, fixpid_an937_stat1(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    TEST_ASSERT_EQUAL_INT32(0, fixpid_an937_proportional(&an937_controller));
    step(50);
    for (int i = 0; i < 6; i++) {
        tick_and_step(3000);
    }
}

void test_tick_lost_leaves_the_integral_alone(void)
{
    tick_and_step(100);
    step(100);
    TEST_ASSERT_EQUAL_INT32(100,
                            fixpid_an937_accumulated_error(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
}

void test_tick_doubled_is_added_once_and_reported_until_cleared(void)
{
    tick();
    tick_and_step(100);
    TEST_ASSERT_EQUAL_INT32(100,
                            fixpid_an937_accumulated_error(&an937_controller));
    tick_and_step(100);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_AN937_TICK_OVERRUN,
                           fixpid_an937_flags(&an937_controller));
    fixpid_an937_clear_flags(&an937_controller);
    reference.overrun = false;
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
    tick_and_step(100);
}

void test_clear_flags_clears_those_of_the_last_step(void)
{
    tick_and_step(4001);
    fixpid_an937_clear_flags(&an937_controller);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_flags(&an937_controller));
}

void test_clear_flags_leaves_the_status_alone(void)
{
    tick_and_step(-4001);
    fixpid_an937_clear_flags(&an937_controller);
    TEST_ASSERT_EQUAL_HEX8(reference_an937_stat1(&reference),
                           fixpid_an937_stat1(&an937_controller));
    TEST_ASSERT_BITS_LOW(FIXPID_AN937_PID_SIGN,
                         fixpid_an937_stat1(&an937_controller));
}

void test_status_derivative_sign_is_that_of_the_term(void)
{
    start(0, 0, 0, 1, 1);
    tick_and_step(-5);
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_D_ERR_SIGN,
                          fixpid_an937_stat1(&an937_controller));
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_an937_stat2(&an937_controller));
}

void test_status_mag_is_always_zero(void)
{
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        tick_and_step(nasty[i]);
        TEST_ASSERT_BITS_LOW(0x20, fixpid_an937_stat1(&an937_controller));
    }
}

// The note's percent mode: 40 counts a percent, 1600 counts of output.
void test_step_percent_whole_range_matches_the_definition(void)
{
    for (int percent = -128; percent <= 127; percent++) {
        const int64_t error = 40 * reference_clamp(percent, -100, 100);

        tick();
        TEST_ASSERT_EQUAL_INT8(
            reference_clamp(reference_an937_step(&reference, error) / 1600,
                            -100, 100),
            fixpid_an937_step_percent(&an937_controller, (int8_t)percent));
    }
}

void test_step_percent_six_percent_from_rest(void)
{
    // 240 counts: 6 * 240 + 5 * 240 + 1 * 240 = 2880, and 2880 / 1600 = 1
    fixpid_an937_tick(&an937_controller);
    TEST_ASSERT_EQUAL_INT8(1, fixpid_an937_step_percent(&an937_controller, 6));
    TEST_ASSERT_EQUAL_INT8(0, fixpid_an937_step_percent(&an937_controller, -6));
}

void test_step_percent_full_error_with_kp_1_gives_2_percent(void)
{
    start(FIXPID_AN937_GAIN(1.0), 0, 0, 4000, 4);
    TEST_ASSERT_EQUAL_INT8(2,
                           fixpid_an937_step_percent(&an937_controller, 100));
    TEST_ASSERT_EQUAL_INT8(-2,
                           fixpid_an937_step_percent(&an937_controller, -100));
}

void test_step_percent_output_is_limited_on_both_sides(void)
{
    start(255, 255, 255, 65535, 1);
    for (int i = 0; i < 20; i++) {
        fixpid_an937_tick(&an937_controller);
        fixpid_an937_step_percent(&an937_controller, 127);
    }
    TEST_ASSERT_EQUAL_INT8(100,
                           fixpid_an937_step_percent(&an937_controller, 127));
    for (int i = 0; i < 40; i++) {
        fixpid_an937_tick(&an937_controller);
        fixpid_an937_step_percent(&an937_controller, -128);
    }
    TEST_ASSERT_EQUAL_INT8(-100,
                           fixpid_an937_step_percent(&an937_controller, -128));
}

// 255 * 4000 / 16 = 63750 is below 40 * 1600, 255 * 4040 / 16 = 64387 is not
void test_step_percent_101_counts_as_100(void)
{
    start(255, 0, 0, 4000, 1);
    TEST_ASSERT_EQUAL_INT8(39,
                           fixpid_an937_step_percent(&an937_controller, 101));
    TEST_ASSERT_EQUAL_INT8(-39,
                           fixpid_an937_step_percent(&an937_controller, -101));
}

// (137 * 4000 + 255 * 8000) / 16 = 161750 is 101 * 1600 and some
void test_step_percent_output_of_101_is_100(void)
{
    start(137, 255, 0, 65535, 1);
    fixpid_an937_tick(&an937_controller);
    fixpid_an937_step_percent(&an937_controller, 100);
    fixpid_an937_tick(&an937_controller);
    TEST_ASSERT_EQUAL_INT8(100,
                           fixpid_an937_step_percent(&an937_controller, 100));
    start(137, 255, 0, 65535, 1);
    fixpid_an937_tick(&an937_controller);
    fixpid_an937_step_percent(&an937_controller, -100);
    fixpid_an937_tick(&an937_controller);
    TEST_ASSERT_EQUAL_INT8(-100,
                           fixpid_an937_step_percent(&an937_controller, -100));
}

// (2 * 4000 + 255 * 10002) / 16 = 159906, just below 100 * 1600
void test_step_percent_just_below_full_is_99(void)
{
    start(2, 255, 0, 10002, 1);
    for (int i = 0; i < 4; i++) {
        fixpid_an937_tick(&an937_controller);
        fixpid_an937_step_percent(&an937_controller, 100);
    }
    TEST_ASSERT_EQUAL_INT8(99,
                           fixpid_an937_step_percent(&an937_controller, 100));
}

void test_gain_macro_rounds_to_a_sixteenth(void)
{
    static const uint8_t gains[] = {
        FIXPID_AN937_GAIN(0.0),   FIXPID_AN937_GAIN(0.03),
        FIXPID_AN937_GAIN(0.04),  FIXPID_AN937_GAIN(1),
        FIXPID_AN937_GAIN(5.0),   FIXPID_AN937_GAIN(6.0),
        FIXPID_AN937_GAIN(9.0),   FIXPID_AN937_GAIN(15.9375),
        FIXPID_AN937_GAIN(15.96),
    };
    static const uint8_t expected[] = {0, 0, 1, 16, 80, 96, 144, 255, 255};

    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, gains, sizeof expected);
}

// ---- Memory ----

static void init_good(void)
{
    static const struct fixpid_an937_config good = {96, 80, 16, 4000, 4};

    (void)fixpid_an937_init(&an937_controller, &good);
}

static void init_bad(void)
{
    static const struct fixpid_an937_config bad = {96, 80, 16, 0, 4};

    (void)fixpid_an937_init(&an937_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_an937, step_flags);

    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&an937_controller, sizeof(an937_controller), init_good));
    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&an937_controller, sizeof(an937_controller), init_bad));
}

// Nothing undefined comes of it either, which the sanitizers see.
void test_step_of_any_bytes_stays_within_its_limits(void)
{
    numbers_seed(937);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        int32_t output;

        numbers_fill(&an937_controller, sizeof(an937_controller));
        output = fixpid_an937_step(&an937_controller, numbers_int16());
        TEST_ASSERT_INT32_WITHIN(1048575, 0, output);
        TEST_ASSERT_INT8_WITHIN(
            100, 0, fixpid_an937_step_percent(&an937_controller, 100));
        (void)fixpid_an937_integral(&an937_controller);
        (void)fixpid_an937_derivative(&an937_controller);
        (void)fixpid_an937_stat1(&an937_controller);
    }
}

void test_step_after_any_bytes_and_a_reset_starts_from_rest(void)
{
    numbers_seed(7);
    for (unsigned turn = 0; turn < 100u; turn++) {
        numbers_fill(&an937_controller, sizeof(an937_controller));
        fixpid_an937_reset(&an937_controller);
        TEST_ASSERT_EQUAL_INT32(0, fixpid_an937_step(&an937_controller, 0));
        TEST_ASSERT_EQUAL_INT32(
            0, fixpid_an937_accumulated_error(&an937_controller));
    }
}
