// SPDX-License-Identifier: MIT
#include "fixpid_relay.h"
#include "numbers.h"
#include "poison.h"
#include "unity.h"

TEST_SOURCE_FILE("src/relay/fixpid_relay.c")

#define REST 77

FIXPID_DATA struct fixpid_relay relay_controller;
static struct fixpid_relay_config config;

static bool init(void)
{
    return fixpid_relay_init(&relay_controller, &config);
}

static int16_t step(int16_t setpoint, int16_t measurement)
{
    return fixpid_relay_step(&relay_controller, setpoint, measurement);
}

static uint8_t status(void)
{
    return fixpid_relay_status(&relay_controller);
}

// One half cycle of so many steps about a setpoint of 0, the last of which
// measures `extreme`, where the relay switches.
static int16_t half(uint16_t count, int16_t extreme)
{
    for (uint16_t i = 1; i < count; i++) {
        step(0, 0);
    }
    return step(0, extreme);
}

static void cycle(uint16_t high_steps, uint16_t low_steps, int16_t top,
                  int16_t bottom)
{
    half(high_steps, top);
    half(low_steps, bottom);
}

// The experiment up to its first switch to high, with the first cycle that
// never counts: high for 3 steps, low for 3 steps, down to `bottom`.
static void begin(int16_t bottom)
{
    TEST_ASSERT_TRUE(init());
    step(0, 0); // the first step of the first half
    cycle(3, 3, 30000, bottom);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
}

static void is_over(uint8_t with)
{
    TEST_ASSERT_EQUAL_UINT8(with, status());
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0, 0));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0, INT16_MAX));
    TEST_ASSERT_EQUAL_UINT8(with, status());
}

// An experiment with one averaged cycle: its outcome.
static uint8_t experiment(uint16_t high_steps, uint16_t low_steps, int16_t top,
                          int16_t bottom)
{
    begin(bottom);
    cycle(high_steps, low_steps, top, bottom);
    return status();
}

void setUp(void)
{
    config = (struct fixpid_relay_config){.output_min = -100,
                                          .output_max = 100,
                                          .output_rest = REST,
                                          .measurement_min = INT16_MIN,
                                          .measurement_max = INT16_MAX,
                                          .hysteresis = 10,
                                          .timeout_steps = 1000,
                                          .cycles = 1,
                                          .options = 0};
}

void tearDown(void)
{
}

// --- init and reset ---

static void refused(void)
{
    TEST_ASSERT_FALSE(init());
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_REFUSED, status());
    TEST_ASSERT_EQUAL_INT16(0, step(100, 0));
    TEST_ASSERT_EQUAL_INT16(0, step(100, INT16_MAX));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_REFUSED, status());
    setUp();
}

static void accepted(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    setUp();
}

void test_init_output_min_not_below_max_is_refused(void)
{
    config.output_min = 100;
    refused();
    config.output_min = 101;
    refused();
    config.output_min = 99;
    accepted();
    config.output_max = -100;
    refused();
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    accepted();
}

void test_init_measurement_min_not_below_max_is_refused(void)
{
    config.measurement_min = INT16_MAX;
    refused();
    config.measurement_min = 51;
    config.measurement_max = 50;
    refused();
    config.measurement_min = 49;
    config.measurement_max = 50;
    accepted();
}

void test_init_hysteresis_outside_1_to_8191_is_refused(void)
{
    config.hysteresis = 0;
    refused();
    config.hysteresis = 1;
    accepted();
    config.hysteresis = 8191;
    accepted();
    config.hysteresis = 8192;
    refused();
    config.hysteresis = UINT16_MAX;
    refused();
}

void test_init_timeout_outside_2_to_32767_is_refused(void)
{
    config.timeout_steps = 0;
    refused();
    config.timeout_steps = 1;
    refused();
    config.timeout_steps = 2;
    accepted();
    config.timeout_steps = 32767;
    accepted();
    config.timeout_steps = 32768u;
    refused();
}

void test_init_cycles_outside_1_to_8_are_refused(void)
{
    config.cycles = 0;
    refused();
    config.cycles = 1;
    accepted();
    config.cycles = 8;
    accepted();
    config.cycles = 9;
    refused();
    config.cycles = UINT8_MAX;
    refused();
}

void test_init_options_but_reverse_are_refused(void)
{
    for (unsigned options = 0; options <= UINT8_MAX; options++) {
        config.options = (uint8_t)options;
        if (options == 0 || options == FIXPID_RELAY_REVERSE) {
            accepted();
        } else {
            refused();
        }
    }
}

void test_init_refused_stays_refused_until_a_good_init(void)
{
    struct fixpid_pid_gains gains;

    config.cycles = 0;
    TEST_ASSERT_FALSE(init());
    fixpid_relay_reset(&relay_controller);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_REFUSED, status());
    TEST_ASSERT_EQUAL_INT16(0, step(100, 0));
    TEST_ASSERT_FALSE(fixpid_relay_result(&relay_controller, 0, &gains));
    config.cycles = 1;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(100, step(100, 0));
}

void test_an_all_zero_object_is_refused(void)
{
    static const struct fixpid_relay zero; // like one at file scope

    relay_controller = zero;
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_REFUSED, status());
    TEST_ASSERT_EQUAL_INT16(0, step(100, 0));
    fixpid_relay_reset(&relay_controller);
    TEST_ASSERT_EQUAL_INT16(0, step(100, 0));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_REFUSED, status());
}

void test_reset_starts_on_the_side_of_the_first_error(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(20, 20, 50, -50));
    fixpid_relay_reset(&relay_controller);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    TEST_ASSERT_EQUAL_INT16(-100, step(0, 1)); // it was at high before
}

void test_reset_counts_the_timeout_from_the_start(void)
{
    config.timeout_steps = 20;
    begin(-50);
    half(15, 0);
    fixpid_relay_reset(&relay_controller);
    half(20, 0);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    step(0, 0);
    is_over(FIXPID_RELAY_NO_OSCILLATION);
}

void test_reset_averages_from_the_start(void)
{
    config.cycles = 3;
    begin(-50);
    cycle(20, 20, 50, -50);
    cycle(20, 20, 50, -50);
    fixpid_relay_reset(&relay_controller);
    step(0, 0);
    for (unsigned i = 0; i < 3; i++) {
        cycle(20, 20, 50, -50);
        TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    }
    cycle(20, 20, 50, -50);
    is_over(FIXPID_RELAY_DONE);
}

// Cycles of which none is like the one before it.
static void unlike_cycles(unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        const uint16_t steps = (i % 2u == 0u) ? 20u : 40u;

        TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
        cycle(steps, steps, 50, -50);
    }
}

void test_reset_counts_the_24_cycles_from_the_start(void)
{
    config.cycles = 2;
    begin(-50);
    unlike_cycles(22);
    fixpid_relay_reset(&relay_controller);
    step(0, 0);
    unlike_cycles(24);
    is_over(FIXPID_RELAY_IRREGULAR);
}

// --- the relay ---

void test_step_first_error_decides_the_first_side(void)
{
    static const struct {
        int16_t setpoint, measurement, output, reversed;
    } rows[] = {{0, 0, 100, 100},
                {0, 1, -100, 100},
                {0, -1, 100, -100},
                {INT16_MAX, 1 - INT16_MAX, 100, -100},
                {INT16_MIN, INT16_MAX - 1, -100, 100}};

    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        setUp();
        TEST_ASSERT_TRUE(init());
        TEST_ASSERT_EQUAL_INT16(rows[i].output,
                                step(rows[i].setpoint, rows[i].measurement));
        config.options = FIXPID_RELAY_REVERSE;
        TEST_ASSERT_TRUE(init());
        TEST_ASSERT_EQUAL_INT16(rows[i].reversed,
                                step(rows[i].setpoint, rows[i].measurement));
    }
}

static void switches_beyond(uint16_t hysteresis, int16_t setpoint)
{
    config.hysteresis = hysteresis;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(100, step(setpoint, setpoint));
    TEST_ASSERT_EQUAL_INT16(
        100, step(setpoint, (int16_t)(setpoint + (int16_t)hysteresis)));
    TEST_ASSERT_EQUAL_INT16(
        -100, step(setpoint, (int16_t)(setpoint + (int16_t)hysteresis + 1)));
    TEST_ASSERT_EQUAL_INT16(
        -100, step(setpoint, (int16_t)(setpoint - (int16_t)hysteresis)));
    TEST_ASSERT_EQUAL_INT16(
        100, step(setpoint, (int16_t)(setpoint - (int16_t)hysteresis - 1)));
}

void test_step_switches_one_count_beyond_the_hysteresis(void)
{
    switches_beyond(1, 0);
    switches_beyond(10, 300);
    switches_beyond(8191, 0);
    switches_beyond(8191, -24575);
    switches_beyond(8191, 24574);
}

// The error has 17 bits: 32767 - (-32767) is 65534.
void test_step_ends_of_the_types_switch_by_the_true_error(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(100, step(INT16_MAX, 1 - INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(-100, step(INT16_MIN, INT16_MAX - 1));
    TEST_ASSERT_EQUAL_INT16(100, step(INT16_MAX, 1 - INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(100, step(INT16_MAX, INT16_MAX - 1));
    TEST_ASSERT_EQUAL_INT16(-100, step(INT16_MIN, 1 - INT16_MAX + 20));
}

void test_step_reverse_gives_the_same_outputs_for_a_mirrored_plant(void)
{
    config.options = FIXPID_RELAY_REVERSE;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(100, step(0, 0));
    TEST_ASSERT_EQUAL_INT16(100, step(0, -10));
    TEST_ASSERT_EQUAL_INT16(-100, step(0, -11));
    TEST_ASSERT_EQUAL_INT16(-100, step(0, 10));
    TEST_ASSERT_EQUAL_INT16(100, step(0, 11));
    half(20, -30);
    half(20, 30);
    is_over(FIXPID_RELAY_DONE);
}

void test_step_the_setpoint_may_move(void)
{
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(100, step(500, 500));
    TEST_ASSERT_EQUAL_INT16(-100, step(489, 500));
    TEST_ASSERT_EQUAL_INT16(100, step(511, 500));
}

// --- endings ---

void test_step_measurement_at_its_limits_is_saturated(void)
{
    static const struct {
        int16_t measurement;
        bool ends;
    } rows[] = {{-500, true}, {-499, false}, {399, false},
                {400, true},  {-501, true},  {401, true}};

    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        setUp();
        config.measurement_min = -500;
        config.measurement_max = 400;
        TEST_ASSERT_TRUE(init());
        step(0, 0);
        if (rows[i].ends) {
            TEST_ASSERT_EQUAL_INT16(REST, step(0, rows[i].measurement));
            is_over(FIXPID_RELAY_SATURATED);
        } else {
            TEST_ASSERT_NOT_EQUAL(REST, step(0, rows[i].measurement));
            TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
        }
    }
}

void test_step_first_measurement_at_a_limit_is_saturated(void)
{
    config.measurement_max = 0;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(REST, step(0, 0));
    is_over(FIXPID_RELAY_SATURATED);
}

// A half of timeout - 1 steps is the longest; then the timeout ends it.
static void times_out_after(uint16_t timeout)
{
    config.timeout_steps = timeout;
    TEST_ASSERT_TRUE(init());
    step(0, 0);
    TEST_ASSERT_EQUAL_INT16(-100, half((uint16_t)(timeout - 1u), 50));
    TEST_ASSERT_EQUAL_INT16(100, half((uint16_t)(timeout - 1u), -50));
    TEST_ASSERT_EQUAL_INT16(-100, half((uint16_t)(timeout - 1u), 50));
    TEST_ASSERT_EQUAL_INT16(REST, half(timeout, -50));
    is_over(FIXPID_RELAY_NO_OSCILLATION);
}

void test_step_half_cycle_of_timeout_steps_is_no_oscillation(void)
{
    times_out_after(2);
    times_out_after(3);
    times_out_after(1000);
    times_out_after(32767);
}

void test_step_first_half_is_timed_too(void)
{
    config.timeout_steps = 5;
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL_INT16(100, step(0, 0));
    }
    TEST_ASSERT_EQUAL_INT16(REST, step(0, 50));
    is_over(FIXPID_RELAY_NO_OSCILLATION);
}

void test_step_saturated_is_said_before_no_oscillation(void)
{
    config.timeout_steps = 2;
    config.measurement_max = 50;
    TEST_ASSERT_TRUE(init());
    step(0, 0);
    step(0, 0);
    TEST_ASSERT_EQUAL_INT16(REST, step(0, 50));
    is_over(FIXPID_RELAY_SATURATED);
}

void test_step_done_after_one_cycle_more_than_asked_for(void)
{
    for (uint8_t cycles = 1; cycles <= 8; cycles++) {
        setUp();
        config.cycles = cycles;
        begin(-50);
        for (uint8_t i = 0; i < cycles; i++) {
            TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
            TEST_ASSERT_EQUAL_INT16(-100, half(20, 50));
            const int16_t output = half(20, -50);
            TEST_ASSERT_EQUAL_INT16(i + 1 < cycles ? 100 : REST, output);
        }
        is_over(FIXPID_RELAY_DONE);
    }
}

// With two cycles asked for: whether the second is averaged with the first.
static bool are_alike(uint16_t first_steps, int16_t first_top,
                      uint16_t second_steps, int16_t second_top)
{
    const uint16_t half_steps = (uint16_t)(second_steps / 2u);
    uint8_t at_end;

    config.cycles = 2;
    begin(-50);
    cycle((uint16_t)(first_steps - 10u), 10, first_top, -50);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    cycle((uint16_t)(second_steps - half_steps), half_steps, second_top, -50);
    at_end = status();
    if (at_end == FIXPID_RELAY_RUNNING) { // the average begins with it
        cycle((uint16_t)(second_steps - half_steps), half_steps, second_top,
              -50);
        TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, status());
    }
    return at_end == FIXPID_RELAY_DONE;
}

// A cycle of 40 steps may differ by 40 / 4 + 2 = 12, one of 43 by no more.
void test_step_periods_alike_within_a_quarter_and_two(void)
{
    TEST_ASSERT_TRUE(are_alike(40, 50, 40, 50));
    TEST_ASSERT_TRUE(are_alike(28, 50, 40, 50));
    TEST_ASSERT_FALSE(are_alike(27, 50, 40, 50));
    TEST_ASSERT_TRUE(are_alike(52, 50, 40, 50));
    TEST_ASSERT_FALSE(are_alike(53, 50, 40, 50));
    TEST_ASSERT_TRUE(are_alike(55, 50, 43, 50));
    TEST_ASSERT_FALSE(are_alike(56, 50, 43, 50));
    TEST_ASSERT_TRUE(are_alike(31, 50, 43, 50));
    TEST_ASSERT_FALSE(are_alike(30, 50, 43, 50));
}

// From -50 to 50 is a swing of 100: 100 / 4 + 2 = 27.
void test_step_swings_alike_within_a_quarter_and_two(void)
{
    TEST_ASSERT_TRUE(are_alike(40, 50, 40, 50));
    TEST_ASSERT_TRUE(are_alike(40, 77, 40, 50));
    TEST_ASSERT_FALSE(are_alike(40, 78, 40, 50));
    TEST_ASSERT_TRUE(are_alike(40, 23, 40, 50));
    TEST_ASSERT_FALSE(are_alike(40, 22, 40, 50));
    TEST_ASSERT_TRUE(are_alike(40, 80, 40, 53));
    TEST_ASSERT_FALSE(are_alike(40, 81, 40, 53));
}

void test_step_a_cycle_is_compared_with_the_last_not_with_the_first(void)
{
    config.cycles = 4;
    begin(-50);
    cycle(20, 20, 50, -50);
    cycle(25, 25, 60, -50);
    cycle(31, 31, 75, -50);
    cycle(38, 38, 90, -50);
    is_over(FIXPID_RELAY_DONE);
}

void test_step_24_cycles_without_enough_alike_are_irregular(void)
{
    config.cycles = 2;
    begin(-50);
    unlike_cycles(22);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    cycle(20, 20, 50, -50); // the 24th, after one of 40
    is_over(FIXPID_RELAY_IRREGULAR);
}

void test_step_the_24th_cycle_may_still_be_the_last_one_wanted(void)
{
    config.cycles = 2;
    begin(-50);
    unlike_cycles(22);
    cycle(40, 40, 50, -50);
    is_over(FIXPID_RELAY_DONE);
}

void test_step_one_half_beyond_four_times_the_other_is_irregular(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(40, 10, 50, -50));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_IRREGULAR,
                            experiment(41, 10, 50, -50));
    is_over(FIXPID_RELAY_IRREGULAR);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(10, 40, 50, -50));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_IRREGULAR,
                            experiment(10, 41, 50, -50));
    is_over(FIXPID_RELAY_IRREGULAR);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_IRREGULAR, experiment(5, 1, 50, -50));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_IRREGULAR, experiment(1, 5, 50, -50));
}

// 4 * 16384 would be 0 in 16 bits.
void test_step_halves_of_any_length_are_compared(void)
{
    config.timeout_steps = 32767;
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE,
                            experiment(20000, 16384, 50, -50));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE,
                            experiment(16384, 20000, 50, -50));
}

void test_step_only_the_halves_of_the_last_cycle_are_compared(void)
{
    config.cycles = 2;
    begin(-50);
    cycle(44, 10, 50, -50);
    cycle(27, 27, 50, -50);
    is_over(FIXPID_RELAY_DONE);
}

void test_step_periods_below_six_steps_are_too_fast(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(3, 3, 50, -50));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_TOO_FAST, experiment(3, 2, 50, -50));
    is_over(FIXPID_RELAY_TOO_FAST);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_TOO_FAST, experiment(1, 1, 50, -50));
}

void test_step_too_fast_is_judged_by_the_mean_period(void)
{
    config.cycles = 2;
    begin(-50);
    cycle(3, 4, 50, -50);
    cycle(3, 2, 50, -50);
    is_over(FIXPID_RELAY_DONE);
    begin(-50);
    cycle(3, 3, 50, -50);
    cycle(3, 2, 50, -50);
    is_over(FIXPID_RELAY_TOO_FAST);
}

void test_step_swings_below_four_hysteresis_are_too_small(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(20, 20, 20, -20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_TOO_SMALL,
                            experiment(20, 20, 19, -20));
    is_over(FIXPID_RELAY_TOO_SMALL);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_TOO_SMALL,
                            experiment(20, 20, 20, -19));
}

// 4 * 8 * 8191 = 262112 needs more than 16 bits.
void test_step_too_small_is_judged_by_the_mean_swing(void)
{
    config.cycles = 8;
    config.hysteresis = 8191;
    begin(-16382);
    for (unsigned i = 0; i < 7; i++) {
        cycle(20, 20, 16382, -16382);
    }
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, status());
    cycle(20, 20, 16382, -16382);
    is_over(FIXPID_RELAY_DONE);
    begin(-16382);
    for (unsigned i = 0; i < 7; i++) {
        cycle(20, 20, 16382, -16382);
    }
    cycle(20, 20, 16381, -16382);
    is_over(FIXPID_RELAY_TOO_SMALL);
}

// Eight cycles with the mean below 6 steps, the last of which is lopsided:
// 7 * 5 + 9 = 44, 8 * 6 = 48.
void test_step_of_several_reasons_irregular_then_too_fast_is_given(void)
{
    config.cycles = 8;
    begin(-11);
    for (unsigned i = 0; i < 7; i++) {
        cycle(3, 2, 11, -11);
    }
    cycle(8, 1, 11, -11);
    is_over(FIXPID_RELAY_IRREGULAR);
    config.cycles = 1;
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_TOO_FAST, experiment(3, 2, 11, -11));
}

// --- result ---

// An experiment with a relay over `span` counts and a swing of 4 or more.
static void measured(uint16_t span, uint16_t swing, uint16_t high_steps,
                     uint16_t low_steps)
{
    config.output_min = INT16_MIN;
    config.output_max = (int16_t)(INT16_MIN + (int32_t)span);
    config.hysteresis = 1;
    config.timeout_steps = 32767;
    TEST_ASSERT_EQUAL_UINT8(
        FIXPID_RELAY_DONE,
        experiment(high_steps, low_steps, (int16_t)(swing - 2u), -2));
}

// What was on the stack is no gain.
static void dirty_the_stack(void)
{
    volatile uint8_t bytes[256];
    static unsigned at; // not on the stack

    for (at = 0; at < sizeof bytes; at++) {
        bytes[at] = 0xA5;
    }
}

static void gains_are(uint8_t rule, uint16_t kp, uint32_t ki, uint16_t kd,
                      uint8_t filter)
{
    struct fixpid_pid_gains gains = {1, 2, 3, 255}; // all are set

    dirty_the_stack();
    TEST_ASSERT_TRUE(fixpid_relay_result(&relay_controller, rule, &gains));
    TEST_ASSERT_EQUAL_UINT16(kp, gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT32(ki, gains.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(kd, gains.kd_q8);
    TEST_ASSERT_EQUAL_UINT8(filter, gains.derivative_filter);
}

static void no_gains(uint8_t rule)
{
    struct fixpid_pid_gains gains = {1, 2, 3, 4};

    TEST_ASSERT_FALSE(fixpid_relay_result(&relay_controller, rule, &gains));
    TEST_ASSERT_EQUAL_UINT16(1, gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT32(2, gains.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(3, gains.kd_q8);
    TEST_ASSERT_EQUAL_UINT8(4, gains.derivative_filter);
}

// Ku is 4 / pi * 200 / 100 = 2.55, in Q12 326 * 16 * 200 / 100 = 10432; Tu is
// 40 steps, in Q4 16 * 40 = 640.
void test_result_worked_numbers_of_each_rule(void)
{
    measured(200, 100, 20, 20);
    // 10432 * 80 / 16 = 52160, (52160 + 128) / 256 = 204
    // 52160 * 116 / 640 = 9454, 9454 * 16 = 151264, no rest
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 204, 151264, 0, 0);
    // 10432 * 116 / 16 = 75632, (75632 + 128) / 256 = 295
    // 75632 * 116 / 640 = 13708, the rest 192: 13708 * 16 + 4 = 219332
    // 640 * 41 / 256 = 102, 295 * 102 / 16 = 1880
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 219332, 1880, 0);
}

// Periods of 40, 42, 40, 41 and 40 steps: (16 * 203 + 2) / 5 = 650, half up;
// swings of 100, 104, 96, 97 and 103 counts are 100 in the mean.
void test_result_averages_all_cycles(void)
{
    config.cycles = 5;
    begin(-50);
    cycle(20, 20, 50, -50);
    cycle(21, 21, 54, -50);
    cycle(20, 20, 46, -50);
    cycle(20, 21, 47, -50);
    cycle(20, 20, 53, -50);
    is_over(FIXPID_RELAY_DONE);
    // 75632 * 116 / 650 = 13497, the rest 262: 13497 * 16 + 6 = 215958
    // 650 * 41 / 256 = 104, 295 * 104 / 16 = 1917
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 215958, 1917, 0);
}

// Of 80 steps, then twice of 40.
void test_result_averages_only_the_last_cycles_which_are_alike(void)
{
    config.cycles = 2;
    begin(-50);
    cycle(40, 40, 50, -50);
    cycle(20, 20, 50, -50);
    cycle(20, 20, 50, -50);
    is_over(FIXPID_RELAY_DONE);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 204, 151264, 0, 0);
}

// Wherever in the cycle the extremes are, and not those of the cycle before.
void test_result_swing_is_from_the_lowest_to_the_highest(void)
{
    TEST_ASSERT_TRUE(init());
    step(0, -900);
    cycle(20, 20, 900, -300);
    step(0, -700);
    step(0, 0);
    half(18, 20);
    step(0, 300);
    step(0, 0);
    half(18, -20);
    is_over(FIXPID_RELAY_DONE);
    // 326 * 16 * 200 / 1000 = 1043, 1043 * 80 / 16 = 5215
    // (5215 + 128) / 256 = 20, 5215 * 116 / 640 = 945
    // the rest 140: 945 * 16 + 3 = 15123
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 20, 15123, 0, 0);
}

void test_result_unknown_rule_is_refused(void)
{
    measured(200, 100, 20, 20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PID + 1);
    no_gains(UINT8_MAX);
}

void test_result_unless_done_is_refused(void)
{
    TEST_ASSERT_TRUE(init());
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // running
    step(0, INT16_MAX);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // saturated
    experiment(20, 20, 19, -20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // too small
    experiment(3, 2, 50, -50);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // too fast
    experiment(44, 10, 50, -50);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // irregular
    config.timeout_steps = 15;
    experiment(16, 10, 50, -50);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // no oscillation
    config.cycles = 0;
    TEST_ASSERT_FALSE(init());
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI); // refused
}

// 5216 * 4 / 163 = 128, 5 * 128 = 640; 5216 * 8 / 233 = 179, 5 * 179 = 895.
void test_result_kp_is_rounded_half_up(void)
{
    measured(4, 163, 20, 20); // (640 + 128) / 256 = 3, just
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 3, 1856, 0, 0);
    measured(8, 233, 20, 20); // (895 + 128) / 256 = 3, just below 4
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 3, 2595, 0, 0);
}

// 5216 / 200 = 26, 5 * 26 + 128 = 258; 5216 / 208 = 25, 5 * 25 + 128 = 253.
void test_result_kp_that_would_be_zero_is_refused(void)
{
    measured(1, 200, 20, 20);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 1, 377, 0, 0);
    measured(1, 208, 20, 20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI);
}

// 5216 * 18977 / 59 = 1677695 and 5216 * 33451 / 104 = 1677696;
// (5 * 1677695 + 128) / 256 = 32767.
void test_result_kp_beyond_its_range_is_refused(void)
{
    measured(18977, 59, 20, 20);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 32767, 24326577, 0, 0);
    measured(33451, 104, 20, 20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI);
}

// 5216 * 41173 / 4 * 80 would be 200064 in 32 bits, and kp 49.
void test_result_kp_far_beyond_its_range_is_refused(void)
{
    measured(41173u, 4, 20, 20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI);
    measured(UINT16_MAX, 4, 20, 20);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PID);
}

// 130 * 116 * 16 / 30160 = 8, and less for the period of one step more.
void test_result_ki_below_its_range_is_refused(void)
{
    measured(1, 200, 943, 942);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 1, 8, 0, 0);
    measured(1, 200, 943, 943);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI);
}

// The largest kp with the shortest period.
void test_result_ki_is_never_above_its_range(void)
{
    measured(18977, 59, 3, 3);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 32767, 162177183, 0, 0);
    TEST_ASSERT_TRUE(UINT32_C(162177280) < FIXPID_PID_KI_MAX);
}

// Td is 41 / 256 of the period, and the filter lags at most an eighth of it.
void test_result_filter_is_the_largest_that_lags_an_eighth_of_td(void)
{
    measured(200, 100, 50, 49);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 88619, 4664, 0);
    measured(200, 100, 50, 50);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 87733, 2360, 1);
    measured(200, 100, 100, 99);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 44086, 4692, 1);
    measured(200, 100, 100, 100);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 43866, 2360, 2);
    measured(200, 100, 3197, 3196);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 1372, 4719, 6);
    measured(200, 100, 3197, 3197);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 1372, 2360, 7);
}

void test_result_filter_is_at_most_7(void)
{
    measured(200, 100, 6394, 6394); // 8 would lag an eighth of Td
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 686, 4720, 7);
}

// 16 * 51150 * 41 / 256 = 131071.
void test_result_td_beyond_its_range_is_refused(void)
{
    measured(200, 100, 25575, 25575);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 295, 171, 18879, 7);
    measured(200, 100, 25576, 25575);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PID);
    // One step more in four cycles: (16 * 204601 + 2) / 4 = 818404,
    // 818404 * 41 / 256 = 131072.
    config.cycles = 4;
    begin(-50);
    for (unsigned i = 0; i < 4; i++) {
        cycle(i == 0 ? 25576 : 25575, 25575, 50, -50);
    }
    is_over(FIXPID_RELAY_DONE);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PID);
}

void test_result_kd_beyond_its_range_is_refused(void)
{
    measured(1604, 61, 208, 207);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PID, 3884, 277945, 32255, 3);
    measured(1092, 60, 150, 150);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PID);
}

void test_result_may_be_asked_again_by_another_rule(void)
{
    measured(200, 100, 20, 20);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 204, 151264, 0, 0);
    step(0, 500);
    gains_are(FIXPID_RELAY_TYREUS_LUYBEN_PI, 204, 151264, 0, 0);
    fixpid_relay_reset(&relay_controller);
    no_gains(FIXPID_RELAY_TYREUS_LUYBEN_PI);
}

// --- which rule serves ---

// A half of a cycle from -50 to 50 about 0, after its extreme: errors that add
// up to `sum`, and then the switch.
static void round_half(uint16_t count, int16_t side, uint16_t turning,
                       uint16_t sum)
{
    if (turning != 0u) {
        sum = (uint16_t)(sum - 50u);
    }
    for (uint16_t i = 1; i < count; i++) {
        const uint16_t error = (sum < 49u) ? sum : 49u;

        if (i == turning) {
            step(0, (int16_t)(side * 50));
        } else {
            step(0, (int16_t)(side * (int16_t)error));
            sum = (uint16_t)(sum - error);
        }
    }
    TEST_ASSERT_EQUAL_UINT16(0, sum);
    step(0, (int16_t)(-side * ((turning == 0u) ? 50 : 49)));
}

// An experiment whose averaged cycle has such halves, with errors that add up
// to `sum`. Where the plant turns after a switch it does so by a swing of 100,
// else the switches are the extremes.
static void formed(uint16_t high_steps, uint16_t low_steps, uint16_t turning,
                   uint16_t sum)
{
    const uint16_t high_turning = (uint16_t)(turning / 2u);
    const uint16_t low_turning = (uint16_t)(turning - high_turning);
    const uint16_t switches = (turning == 0u) ? 100u : 98u;
    const uint16_t low_sum = (uint16_t)((sum - switches) / 2u);
    const int16_t way = (config.options == 0u) ? 1 : -1;

    TEST_ASSERT_TRUE(init());
    step(0, 0);
    half(3, (int16_t)(way * 300));
    half(3, (int16_t)(way * ((turning == 0u) ? -50 : -49)));
    round_half(high_steps, (int16_t)-way, high_turning,
               (uint16_t)(sum - switches - low_sum));
    round_half(low_steps, way, low_turning, low_sum);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, status());
}

static bool served(uint8_t rule)
{
    struct fixpid_pid_gains gains;

    return fixpid_relay_result(&relay_controller, rule, &gains);
}

static bool pi(uint16_t high_steps, uint16_t low_steps, uint16_t turning,
               uint16_t sum)
{
    formed(high_steps, low_steps, turning, sum);
    return served(FIXPID_RELAY_TYREUS_LUYBEN_PI);
}

static bool pid(uint16_t high_steps, uint16_t low_steps, uint16_t turning)
{
    formed(high_steps, low_steps, turning, 1000);
    return served(FIXPID_RELAY_TYREUS_LUYBEN_PID);
}

// With a swing of 100 and a hysteresis of 10, 8 E / 85 < 2 + (T + D) / P.
void test_result_pi_is_for_errors_below_a_bound(void)
{
    TEST_ASSERT_TRUE(pi(20, 20, 0, 849)); // 8 * 850 / 40 / 85 = 2
    TEST_ASSERT_FALSE(pi(20, 20, 0, 850));
    config.hysteresis = 12; // 8 * 820 / 40 / 82 = 2
    TEST_ASSERT_TRUE(pi(20, 20, 0, 819));
    TEST_ASSERT_FALSE(pi(20, 20, 0, 820));
}

void test_result_pi_more_error_is_served_where_the_plant_turns_later(void)
{
    TEST_ASSERT_TRUE(pi(20, 20, 19, 1051)); // 2 + 19 / 40: 1051.875
    TEST_ASSERT_FALSE(pi(20, 20, 19, 1052));
    config.options = FIXPID_RELAY_REVERSE;
    TEST_ASSERT_TRUE(pi(20, 20, 19, 1051));
    TEST_ASSERT_FALSE(pi(20, 20, 19, 1052));
    TEST_ASSERT_TRUE(pi(20, 20, 0, 849));
    TEST_ASSERT_FALSE(pi(20, 20, 0, 850));
}

void test_result_pi_more_error_is_served_where_halves_are_uneven(void)
{
    TEST_ASSERT_TRUE(pi(15, 25, 0, 956)); // 2 + 10 / 40: 956.25
    TEST_ASSERT_FALSE(pi(15, 25, 0, 957));
    TEST_ASSERT_TRUE(pi(25, 15, 0, 956));
    TEST_ASSERT_FALSE(pi(25, 15, 0, 957));
}

void test_result_pi_any_error_is_served_where_the_plant_turns_late(void)
{
    TEST_ASSERT_TRUE(pi(20, 20, 23, 1900)); // 20 + 2
    TEST_ASSERT_FALSE(pi(20, 20, 22, 1900));
    TEST_ASSERT_TRUE(pi(25, 24, 28, 1900)); // 24 + 3
    TEST_ASSERT_FALSE(pi(25, 24, 27, 1900));
    TEST_ASSERT_TRUE(pi(24, 23, 26, 1900)); // 23 + 2
    TEST_ASSERT_FALSE(pi(24, 23, 25, 1900));
}

void test_result_pid_needs_twenty_steps(void)
{
    TEST_ASSERT_TRUE(pid(12, 12, 0));
    formed(10, 10, 0, 500);
    TEST_ASSERT_TRUE(served(FIXPID_RELAY_TYREUS_LUYBEN_PID));
    formed(10, 9, 0, 500);
    TEST_ASSERT_FALSE(served(FIXPID_RELAY_TYREUS_LUYBEN_PID));
}

void test_result_pid_needs_halves_within_two_of_each_other(void)
{
    TEST_ASSERT_TRUE(pid(26, 14, 0)); // 40 / 3 = 13
    TEST_ASSERT_FALSE(pid(27, 14, 0));
    TEST_ASSERT_TRUE(pid(14, 26, 0));
    TEST_ASSERT_FALSE(pid(14, 27, 0));
}

void test_result_pid_is_for_plants_that_turn_early(void)
{
    TEST_ASSERT_TRUE(pid(20, 20, 17)); // 20 - 2
    TEST_ASSERT_FALSE(pid(20, 20, 18));
    TEST_ASSERT_TRUE(pid(29, 30, 26)); // 29 - 2
    TEST_ASSERT_FALSE(pid(29, 30, 27));
    TEST_ASSERT_TRUE(pid(30, 30, 26)); // 30 - 3
    TEST_ASSERT_FALSE(pid(30, 30, 27));
    config.options = FIXPID_RELAY_REVERSE;
    TEST_ASSERT_TRUE(pid(20, 20, 17));
    TEST_ASSERT_FALSE(pid(20, 20, 18));
}

// The highest measurement is where the cycle began: 0 + 3 - 20 steps, in 16
// bits. The setpoint was far above it then.
void test_result_a_setpoint_that_moved_may_turn_before_the_switch(void)
{
    TEST_ASSERT_TRUE(init());
    step(0, 0);
    half(3, 300);
    for (unsigned i = 0; i < 2; i++) {
        step(0, 0);
    }
    step(2000, 1000); // to high: the cycle begins
    step(0, 0);
    step(0, 0);
    step(0, -50);
    for (unsigned i = 3; i < 19; i++) {
        step(0, 0);
    }
    step(0, 11); // to low
    half(20, -11);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, status());
    TEST_ASSERT_TRUE(served(FIXPID_RELAY_TYREUS_LUYBEN_PI));
    TEST_ASSERT_FALSE(served(FIXPID_RELAY_TYREUS_LUYBEN_PID));
}

// Errors of 65534 over 65532 steps: 2^32 is 4294967296, and the sum with the
// switches 4294574088.
void test_result_pi_the_largest_errors_add_up(void)
{
    config.timeout_steps = 32767;
    TEST_ASSERT_TRUE(init());
    step(0, 0);
    half(3, 300);
    half(3, -300);
    for (unsigned i = 1; i < 32766u; i++) {
        step(INT16_MAX, -32767);
    }
    step(INT16_MIN, 32766);
    for (unsigned i = 1; i < 32766u; i++) {
        step(INT16_MIN, 32766);
    }
    step(INT16_MAX, -32767);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, status());
    TEST_ASSERT_EQUAL_UINT32(UINT32_C(65534) * 65532u,
                             relay_controller.error_sum);
    TEST_ASSERT_FALSE(served(FIXPID_RELAY_TYREUS_LUYBEN_PI));
}

// ---- Memory ----

static void init_good(void)
{
    (void)fixpid_relay_init(&relay_controller, &config);
}

static void init_bad(void)
{
    struct fixpid_relay_config bad = config;
    bad.cycles = 0;
    (void)fixpid_relay_init(&relay_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_relay, averaged);

    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&relay_controller, sizeof(relay_controller), init_good));
    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&relay_controller, sizeof(relay_controller), init_bad));
}

// ---- Flipped bits ----

static void refuses_sums(void)
{
    TEST_ASSERT_FALSE(served(FIXPID_RELAY_TYREUS_LUYBEN_PI));
    measured(200, 100, 20, 20);
    TEST_ASSERT_TRUE(served(FIXPID_RELAY_TYREUS_LUYBEN_PI));
}

void test_result_sums_that_no_cycles_have_are_refused(void)
{
    measured(200, 100, 20, 20);
    relay_controller.averaged = 0;
    refuses_sums();
    relay_controller.period_sum = (6u * config.cycles) - 1u;
    refuses_sums();
    relay_controller.period_sum = UINT32_C(65532) * config.cycles;
    TEST_ASSERT_TRUE(served(FIXPID_RELAY_TYREUS_LUYBEN_PI));
    relay_controller.period_sum++;
    refuses_sums();
    relay_controller.swing_sum = 0;
    refuses_sums();
    relay_controller.last_period = 0;
    relay_controller.high_steps = 0;
    relay_controller.highest_at = 0;
    relay_controller.lowest_at = 0;
    refuses_sums();
}

// Nothing undefined comes of any bytes, which the sanitizers see.
void test_result_of_any_bytes_is_legal(void)
{
    numbers_seed(6);
    for (unsigned turn = 0; turn < 20000u; turn++) {
        struct fixpid_pid_gains gains = {0};

        numbers_fill(&relay_controller, sizeof relay_controller);
        relay_controller.status = FIXPID_RELAY_DONE;
        relay_controller.averaged &= 7u;
        relay_controller.period_sum >>= 14;
        relay_controller.error_sum >>= 4u + (turn & 15u);
        if (fixpid_relay_result(&relay_controller, (uint8_t)(turn & 1u),
                                &gains)) {
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(FIXPID_PID_KP_MAX, gains.kp_q8);
            TEST_ASSERT_LESS_OR_EQUAL_UINT32(FIXPID_PID_KI_MAX, gains.ki_q24);
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(FIXPID_PID_KD_MAX, gains.kd_q8);
            TEST_ASSERT_LESS_OR_EQUAL_UINT8(FIXPID_PID_FILTER_MAX,
                                            gains.derivative_filter);
        }
    }
}
