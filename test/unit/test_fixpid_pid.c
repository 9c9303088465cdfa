// SPDX-License-Identifier: MIT
#include <stddef.h>
#include <string.h>

#include "fixpid_pid.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "pid_both.h"
#include "poison.h"
#include "reference_pid.h"
#include "unity.h"
#include "vectors_pid.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_check.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_error.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("test/support/reference.c")

FIXPID_DATA struct fixpid_pid pid_controller;

void setUp(void)
{
    numbers_seed(964937);
    config = valve;
    TEST_ASSERT_TRUE(init());
}

void tearDown(void)
{
}

void test_step_worked_example_gives_the_table(void)
{
    static const struct {
        int16_t measurement;
        int32_t p, i, d;
        int16_t output;
        uint8_t status;
    } rows[] = {
        {0, 358400, 0, 0, 255, 0x01},
        {0, 358400, 0, 0, 255, 0x01},
        {40, 337920, 0, -10240, 255, 0x01},
        {120, 296960, 0, -25600, 255, 0x01},
        {260, 225280, 0, -48640, 255, 0x01},
        {400, 153600, 7864320, -60160, 120, 0x40}, // set_manual(120)
        {690, 5120, 33259520, -104320, 120, 0x00}, // set_auto
        {712, -6144, 33220196, -57792, 255, 0x01},
    };

    config.gains.kd_q8 = 256;
    config.gains.derivative_filter = 1;
    TEST_ASSERT_TRUE(init());
    for (unsigned n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        if (n == 5) {
            set_manual(120);
        }
        if (n == 6) {
            set_auto();
        }
        TEST_ASSERT_EQUAL_INT16(rows[n].output, step(700, rows[n].measurement));
        TEST_ASSERT_EQUAL_INT32(rows[n].p,
                                fixpid_pid_proportional(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(rows[n].i, integral());
        TEST_ASSERT_EQUAL_INT32(rows[n].d,
                                fixpid_pid_derivative(&pid_controller));
        TEST_ASSERT_EQUAL_HEX8(rows[n].status, flags());
    }
}

void test_step_nasty_inputs_crossed_match_the_definition(void)
{
    static const struct fixpid_pid_gains gains[] = {
        {512, 838861, 256, 0},
        {32767, 32767, 32255, 0},
        {32767, FIXPID_PID_KI_MAX, 32255, 7},
        {1, 8388608, 1, 1},
    };

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            config.gains = gains[(i + j) % 4];
            vectors_pid_set_options(&config, (i % 8) << 5);
            config.setpoint_weight_q8 =
                (uint16_t)(i % 2 != 0 ? 0u : j % 3 * 128);
            config.output_min = j % 2 != 0 ? INT16_MIN : -100;
            config.output_max = j % 2 != 0 ? INT16_MAX : 100;
            TEST_ASSERT_TRUE(init());
            step(nasty[i], nasty[j]);
            step(nasty[j], nasty[i]);
            step(nasty[i], nasty[j]);
            step(nasty[i], nasty[j]);
        }
    }
}

void test_random_operations_match_the_definition(void)
{
    int16_t setpoint = 0;
    int16_t measurement;

    for (uint32_t n = 0; n < TEST_RANDOM_STEPS; n++) {
        if (numbers_below(8) == 0) {
            any_setting();
        }
        numbers_pid_inputs(&setpoint, &measurement);
        step(setpoint, measurement);
        if (numbers_below(4) == 0) {
            track(numbers_int16(), (uint8_t)numbers_below(256));
        }
        if (numbers_below(4) == 0) {
            track((int16_t)(numbers_int16() / 256), (uint8_t)numbers_below(16));
        }
    }
}

// ---- init, and what it refuses ----

// What is in `config` is refused, and a refused controller does nothing.
static void is_refused(void)
{
    const struct fixpid_pid_gains gains = valve.gains;

    TEST_ASSERT_FALSE(fixpid_pid_init(&pid_controller, &config));
    TEST_ASSERT_FALSE(fixpid_pid_set_gains(&pid_controller, &gains));
    TEST_ASSERT_FALSE(fixpid_pid_set_limits(&pid_controller, 0, 255));
    TEST_ASSERT_FALSE(fixpid_pid_set_integral_limits(&pid_controller, 0, 255));
    fixpid_pid_set_feedforward(&pid_controller, 100);
    for (int16_t n = 0; n < 5; n++) {
        TEST_ASSERT_EQUAL_INT16(
            0, fixpid_pid_step(&pid_controller, 1000, (int16_t)(-100 * n)));
        fixpid_pid_track(&pid_controller, 70, 0);
        TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    }
    fixpid_pid_set_manual(&pid_controller, 50);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 1000, 0));
    fixpid_pid_set_auto(&pid_controller);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 1000, 0));
    fixpid_pid_seed(&pid_controller, -50);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 1000, 0));
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    config = valve;
    TEST_ASSERT_TRUE(init());
}

void test_init_proportional_gain_beyond_its_range_is_refused(void)
{
    config.gains.kp_q8 = 32767;
    TEST_ASSERT_TRUE(init());
    config.gains.kp_q8 = 32768;
    is_refused();
    config.gains.kp_q8 = 65535;
    is_refused();
}

void test_init_integral_gain_beyond_its_range_is_refused(void)
{
    config.gains.ki_q24 = UINT32_C(0x7FFF0000);
    TEST_ASSERT_TRUE(init());
    config.gains.ki_q24 = UINT32_C(0x7FFF0001);
    is_refused();
    config.gains.ki_q24 = UINT32_C(0xFFFFFFFF);
    is_refused();
}

void test_init_derivative_gain_beyond_its_range_is_refused(void)
{
    config.gains.kd_q8 = 32255;
    TEST_ASSERT_TRUE(init());
    config.gains.kd_q8 = 32256;
    is_refused();
    config.gains.kd_q8 = 65535;
    is_refused();
}

void test_init_derivative_filter_beyond_its_range_is_refused(void)
{
    config.gains.derivative_filter = 7;
    TEST_ASSERT_TRUE(init());
    config.gains.derivative_filter = 8;
    is_refused();
    config.gains.derivative_filter = 255;
    is_refused();
}

void test_init_output_limits_without_room_are_refused(void)
{
    config.output_min = 254;
    TEST_ASSERT_TRUE(init());
    config.output_min = 255;
    is_refused();
    config.output_min = 256;
    is_refused();
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    TEST_ASSERT_TRUE(init());
    config.output_min = INT16_MAX;
    config.output_max = INT16_MIN;
    is_refused();
}

void test_init_integral_limits_outside_their_range_are_refused(void)
{
    config.integral_min = 255;
    config.integral_max = 255;
    TEST_ASSERT_TRUE(init());
    config.integral_min = 256;
    config.integral_max = 255;
    is_refused();
    config.integral_min = INT16_MIN;
    is_refused();
    config.integral_min = INT16_MIN;
    config.integral_max = INT16_MIN;
    is_refused();
}

void test_init_setpoint_weight_above_one_is_refused(void)
{
    config.setpoint_weight_q8 = 256;
    TEST_ASSERT_TRUE(init());
    config.setpoint_weight_q8 = 257;
    is_refused();
    config.setpoint_weight_q8 = 65535;
    is_refused();
}

void test_init_every_option_beside_every_other_is_accepted(void)
{
    for (unsigned options = 0; options <= 0xE0u; options += 0x20u) {
        vectors_pid_set_options(&config, options);
        TEST_ASSERT_TRUE(init());
        step(100, 40);
        step(110, 20);
    }
}

void test_all_zero_object_is_a_refused_controller(void)
{
    memset(&pid_controller, 0, sizeof pid_controller);
    TEST_ASSERT_FALSE(fixpid_pid_set_gains(&pid_controller, &valve.gains));
    TEST_ASSERT_FALSE(fixpid_pid_set_limits(&pid_controller, 0, 255));
    TEST_ASSERT_FALSE(fixpid_pid_set_integral_limits(&pid_controller, 0, 1));
    fixpid_pid_set_feedforward(&pid_controller, 5);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED, flags());
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 100, -100));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED, flags());
}

// ---- Which field init refuses ----

static void problem_is(enum fixpid_pid_problem problem)
{
    TEST_ASSERT_EQUAL(problem, fixpid_pid_check(&config));
    TEST_ASSERT_EQUAL(problem == FIXPID_PID_OK, init());
}

// Every field is wrong, and then one after the other is right.
void test_check_names_the_first_wrong_field(void)
{
    config.gains.kp_q8 = 32768;
    config.gains.ki_q24 = 0x7FFF0001;
    config.gains.kd_q8 = 32256;
    config.gains.derivative_filter = 8;
    config.output_min = 5;
    config.output_max = 5;
    config.integral_min = INT16_MIN;
    config.integral_max = INT16_MIN;
    config.setpoint_weight_q8 = 257;
    problem_is(FIXPID_PID_BAD_KP_Q8);
    config.gains.kp_q8 = 32767;
    problem_is(FIXPID_PID_BAD_KI_Q24);
    config.gains.ki_q24 = 0x7FFF0000;
    problem_is(FIXPID_PID_BAD_KD_Q8);
    config.gains.kd_q8 = 32255;
    problem_is(FIXPID_PID_BAD_DERIVATIVE_FILTER);
    config.gains.derivative_filter = 7;
    problem_is(FIXPID_PID_BAD_OUTPUT_MAX);
    config.output_max = 6;
    problem_is(FIXPID_PID_BAD_INTEGRAL_MIN);
    config.integral_min = -32767;
    problem_is(FIXPID_PID_BAD_INTEGRAL_MAX);
    config.integral_max = -32767;
    problem_is(FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8);
    config.setpoint_weight_q8 = 256;
    problem_is(FIXPID_PID_OK);
}

void test_check_weight_beside_proportional_on_measurement_is_wrong(void)
{
    config.proportional_on_measurement = true;
    problem_is(FIXPID_PID_OK);
    config.setpoint_weight_q8 = 1;
    problem_is(FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8);
    config.setpoint_weight_q8 = 256;
    problem_is(FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8);
}

// ---- What an initialiser leaves out ----

void test_init_weight_0_is_the_plain_pid(void)
{
    config.setpoint_weight_q8 = 0;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(205, step(100, 0));
    config.setpoint_weight_q8 = 256;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(205, step(100, 0));
}

void test_init_weight_beside_proportional_on_measurement_is_refused(void)
{
    config.proportional_on_measurement = true;
    config.setpoint_weight_q8 = 0;
    TEST_ASSERT_TRUE(init());
    config.setpoint_weight_q8 = 1;
    is_refused();
    config.proportional_on_measurement = true;
    config.setpoint_weight_q8 = 256;
    is_refused();
}

void test_init_integral_limits_both_0_are_none(void)
{
    config.integral_min = 0;
    config.integral_max = 0;
    TEST_ASSERT_TRUE(init());
    for (unsigned n = 0; n < 100; n++) {
        step(30, 0);
    }
    TEST_ASSERT_TRUE(integral() > 0);
}

void test_init_one_integral_limit_of_0_is_a_range(void)
{
    config.integral_max = 500;
    TEST_ASSERT_TRUE(init());
    step(-30, 0);
    step(-30, 0);
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN | FIXPID_PID_INTEGRAL_AT_LIMIT,
                           flags());
}

void test_set_integral_limits_both_0_are_none(void)
{
    TEST_ASSERT_TRUE(set_integral_limits(0, 1));
    TEST_ASSERT_TRUE(set_integral_limits(0, 0));
    for (unsigned n = 0; n < 100; n++) {
        step(30, 0);
    }
    TEST_ASSERT_TRUE(integral() > INT32_C(65536));
}

void test_init_refused_is_a_flag_beside_the_others(void)
{
    config.output_max = config.output_min;
    TEST_ASSERT_FALSE(init());
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED | FIXPID_PID_FIRST, flags());
    step(1, 2);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED, flags());
}

void test_init_starts_from_rest_in_automatic(void)
{
    step(700, 0);
    set_feedforward(20);
    set_manual(10);
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, flags());
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_INT16(0, step(0, 0));
    TEST_ASSERT_EQUAL_HEX8(0, flags());
}

void test_reset_integral_is_0_or_the_limit_next_to_it(void)
{
    reset();
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_TRUE(set_integral_limits(20, 30));
    reset();
    TEST_ASSERT_EQUAL_INT32(20 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(-30, -20));
    reset();
    TEST_ASSERT_EQUAL_INT32(-20 * INT32_C(65536), integral());
}

void test_reset_forgets_derivative_and_feedforward_and_keeps_the_gains(void)
{
    config.gains.kd_q8 = 256;
    config.gains.derivative_filter = 3;
    TEST_ASSERT_TRUE(init());
    step(100, 50);
    set_feedforward(100);
    step(100, 40);
    reset();
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, flags());
    TEST_ASSERT_EQUAL_INT16(21, step(110, 100)); // 20 + 0.5, half up
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
}

// ---- The step ----

void test_struct_has_34_bytes_or_36_with_words_of_32_bits(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_pid, output);

    TEST_ASSERT_EQUAL_UINT(UINT_MAX > 65535u ? 36u : 34u,
                           sizeof(struct fixpid_pid) - padding);
    TEST_ASSERT_LESS_OR_EQUAL_UINT(36, sizeof(struct fixpid_pid));
}

void test_step_same_error_both_ways_leaves_the_integral_as_it_was(void)
{
    static const uint32_t gains[] = {1, 8, 127, 32767, 838861, 9000000};

    for (unsigned g = 0; g < sizeof gains / sizeof gains[0]; g++) {
        int32_t before;

        config.gains.ki_q24 = gains[g];
        config.gains.kp_q8 = 0;
        config.output_min = -32767;
        config.output_max = 32767;
        TEST_ASSERT_TRUE(init());
        step(1000, 993);
        before = integral();
        for (int n = 0; n < 1000; n++) {
            step(0, -1);
        }
        for (int n = 0; n < 1000; n++) {
            step(0, 1);
        }
        TEST_ASSERT_EQUAL_INT32(before, integral());
    }
}

void test_step_integral_gain_is_kept_to_15_bits_to_the_nearest(void)
{
    static const struct {
        uint32_t ki_q24;
        int64_t kept;
    } rows[] = {
        {32767, 32767},
        {32768, INT32_C(128) * 256},
        {32895, INT32_C(128) * 256},
        {32896, INT32_C(129) * 256},
        {8388479, 32767 * 256L},
        {8388480, 128 * 65536L},
        {8421375, 128 * 65536L},
        {8421376, 129 * 65536L},
    };

    config.gains.kp_q8 = 0;
    config.output_min = -32767;
    for (unsigned n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        config.gains.ki_q24 = rows[n].ki_q24;
        TEST_ASSERT_TRUE(init());
        step(256, 0);
        TEST_ASSERT_EQUAL_INT32(rows[n].kept, integral());
    }
}

void test_step_output_is_rounded_half_up(void)
{
    config.gains.ki_q24 = 0;
    config.gains.kp_q8 = 128;
    config.output_min = -100;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(2, step(3, 0));
    TEST_ASSERT_EQUAL_INT16(-1, step(-3, 0));
    TEST_ASSERT_EQUAL_INT16(0, step(-1, 0));
}

void test_step_reverse_output_falls_to_raise_the_measurement(void)
{
    config.reverse = true;
    config.gains.kd_q8 = 256;
    config.output_min = -255;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(-21, step(10, 0)); // -20 - 0.5, half up
    TEST_ASSERT_EQUAL_INT32(-20 * 256,
                            fixpid_pid_proportional(&pid_controller));
    step(10, 3);
    TEST_ASSERT_EQUAL_INT32(3 * 256, fixpid_pid_derivative(&pid_controller));
}

void test_step_derivative_ignores_the_setpoint_unless_it_is_on_the_error(void)
{
    config.gains.kd_q8 = 512;
    TEST_ASSERT_TRUE(init());
    step(100, 100);
    step(120, 100);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    step(120, 105);
    TEST_ASSERT_EQUAL_INT32(-5 * 512, fixpid_pid_derivative(&pid_controller));
    config.derivative_on_error = true;
    TEST_ASSERT_TRUE(init());
    step(100, 100);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    step(120, 105);
    TEST_ASSERT_EQUAL_INT32(15 * 512, fixpid_pid_derivative(&pid_controller));
}

void test_step_first_one_has_no_derivative(void)
{
    config.gains.kd_q8 = 32255;
    TEST_ASSERT_TRUE(init());
    step(0, INT16_MIN);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    step(0, INT16_MAX);
    TEST_ASSERT_EQUAL_INT32(INT32_C(-32255) * 32768,
                            fixpid_pid_derivative(&pid_controller));
}

// 65024 + 32255 * 32767 is one beyond 2^30 - 2^24.
void test_step_filtered_derivative_is_limited_on_both_sides(void)
{
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        config.gains.kd_q8 = 16256;
        config.gains.derivative_filter = 1;
        TEST_ASSERT_TRUE(init());
        step(0, (int16_t)(sign * 32000));
        step(0, (int16_t)(sign * 31992));
        TEST_ASSERT_EQUAL_INT32(sign * 130048,
                                fixpid_pid_derivative(&pid_controller));
        config.gains.kd_q8 = 32255;
        TEST_ASSERT_TRUE(set_gains());
        step(0, (int16_t)(sign * -775));
        TEST_ASSERT_EQUAL_INT32(sign * 0x3F000000,
                                fixpid_pid_derivative(&pid_controller));
    }
}

void test_step_setpoint_weight_softens_the_proportional_term_only(void)
{
    config.setpoint_weight_q8 = 128;
    TEST_ASSERT_TRUE(init());
    step(0, 0); // starts from rest
    step(101, 20);
    TEST_ASSERT_EQUAL_INT32(512 * (51 - 20),
                            fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(INT32_C(3277) * (101 - 20), integral());
}

void test_step_proportional_on_measurement_has_no_setpoint(void)
{
    config.proportional_on_measurement = true;
    TEST_ASSERT_TRUE(init());
    step(0, 0); // starts from rest
    step(100, 20);
    TEST_ASSERT_EQUAL_INT32(512 * -20,
                            fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(INT32_C(3277) * (100 - 20), integral());
}

// The error is added to the integral, which stays within 10 counts.
static void start_as_a_sum_within_10(void)
{
    config.gains.ki_q24 = UINT32_C(1) << 24;
    config.integral_min = -10;
    config.integral_max = 10;
    TEST_ASSERT_TRUE(init());
}

void test_step_integral_at_its_limit_is_flagged_once_it_is_beyond(void)
{
    config.output_min = -255;
    start_as_a_sum_within_10();
    step(10, 0);
    TEST_ASSERT_EQUAL_HEX8(0, flags()); // at the limit, not beyond it
    step(0, 0);
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    step(1, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_INTEGRAL_AT_LIMIT, flags());
    step(-1, 0);
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    step(-19, 0);
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    step(0, 0);
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    step(-1, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_INTEGRAL_AT_LIMIT, flags());
}

// A 2^24th of a count beyond the limit is beyond it.
void test_step_integral_beyond_its_limit_by_a_fraction_is_flagged(void)
{
    config.output_min = -255;
    start_as_a_sum_within_10();
    step(10, 0);
    config.gains.ki_q24 = 1;
    TEST_ASSERT_TRUE(set_gains());
    step(1, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_INTEGRAL_AT_LIMIT, flags());
    TEST_ASSERT_EQUAL_INT32(10 * INT32_C(65536), integral());
}

void test_step_integral_at_its_limit_is_flagged_though_the_output_is(void)
{
    start_as_a_sum_within_10();
    step(300, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX | FIXPID_PID_INTEGRAL_AT_LIMIT,
                           flags());
    TEST_ASSERT_EQUAL_INT32(0, integral()); // forgotten, as it wound up
    set_manual(5);
    TEST_ASSERT_BITS_HIGH(FIXPID_PID_INTEGRAL_AT_LIMIT, flags());
    step(300, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL, flags());
    set_auto();
    step(300, 0);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_INTEGRAL_AT_LIMIT | FIXPID_PID_AT_MAX,
                           flags());
    reset();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, flags());
}

void test_step_feedforward_is_added_to_the_output(void)
{
    step(10, 10);
    set_feedforward(77);
    TEST_ASSERT_EQUAL_INT16(77, step(10, 10));
    set_feedforward(INT16_MIN);
    TEST_ASSERT_EQUAL_INT16(0, step(10, 10));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN, flags());
}

void test_step_output_at_its_limit_is_not_flagged_and_beyond_it_is(void)
{
    config.gains.ki_q24 = 0;
    config.gains.kp_q8 = 256;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(255, step(255, 0));
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    TEST_ASSERT_EQUAL_INT16(255, step(256, 0));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, flags());
    TEST_ASSERT_EQUAL_INT16(0, step(0, 0));
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    TEST_ASSERT_EQUAL_INT16(0, step(-1, 0));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN, flags());
}

void test_step_limited_output_stops_the_integral_until_the_error_turns(void)
{
    int32_t wound;

    for (int n = 0; n < 200; n++) {
        step(700, 600);
    }
    wound = integral();
    step(700, 600);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, flags());
    TEST_ASSERT_EQUAL_INT32(wound, integral());
    set_feedforward(500); // still at its limit
    step(700, 701);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, flags());
    TEST_ASSERT_EQUAL_INT32(wound - 3277, integral());
    step(700, 700); // and without an error
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, flags());
    set_feedforward(-1000);
    step(700, 701);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN, flags());
    TEST_ASSERT_EQUAL_INT32(wound - 3277, integral());
    step(700, 699);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN, flags());
    TEST_ASSERT_EQUAL_INT32(wound, integral());
}

void test_step_integral_stays_within_its_limits(void)
{
    static const uint32_t gains[] = {32767, 838861, FIXPID_PID_KI_MAX};

    for (unsigned g = 0; g < 3; g++) {
        config.gains.ki_q24 = gains[g];
        config.gains.kp_q8 = 0;
        config.output_min = -1000;
        config.output_max = 1000;
        config.integral_min = -50;
        config.integral_max = 60;
        TEST_ASSERT_TRUE(init());
        for (int n = 0; n < 30; n++) {
            step(10000, 0);
        }
        TEST_ASSERT_EQUAL_INT32(60 * INT32_C(65536), integral());
        step(-1, 0);
        TEST_ASSERT_LESS_THAN_INT32(60 * INT32_C(65536), integral());
        for (int n = 0; n < 30; n++) {
            step(-10000, 0);
        }
        TEST_ASSERT_EQUAL_INT32(-50 * INT32_C(65536), integral());
        step(1, 0);
        TEST_ASSERT_GREATER_THAN_INT32(-50 * INT32_C(65536), integral());
    }
}

// A controller whose integral is a little above `counts`, by less than can be
// read.
static void start_with_a_fraction(int16_t counts)
{
    config.gains.ki_q24 = 1;
    config.gains.kp_q8 = 0;
    config.output_min = -1000;
    config.output_max = 1000;
    TEST_ASSERT_TRUE(init());
    seed(counts);
    step(0, 0);
    step(200, 0);
    TEST_ASSERT_EQUAL_INT32(counts * INT32_C(65536), integral());
}

// 1 / 2^24 less is less than the integral that has no fraction.
static void has_no_fraction(void)
{
    const int32_t before = integral();

    config.gains.ki_q24 = 1;
    config.gains.kp_q8 = 0;
    TEST_ASSERT_TRUE(set_gains());
    step(0, 1);
    TEST_ASSERT_EQUAL_INT32(before - 1, integral());
}

// 255 / 2^24 more cannot be read yet if the integral has no fraction.
static void has_no_fraction_above(void)
{
    const int32_t before = integral();

    config.gains.ki_q24 = 1;
    config.gains.kp_q8 = 0;
    TEST_ASSERT_TRUE(set_gains());
    step(255, 0);
    TEST_ASSERT_EQUAL_INT32(before, integral());
    step(1, 0);
    TEST_ASSERT_EQUAL_INT32(before + 1, integral());
}

void test_step_integral_at_its_limit_has_no_fraction(void)
{
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_integral_limits(-60, 60));
    config.gains.ki_q24 = 838861;
    TEST_ASSERT_TRUE(set_gains());
    step(10000, 0);
    TEST_ASSERT_EQUAL_INT32(60 * INT32_C(65536), integral());
    has_no_fraction();
    start_with_a_fraction(-50);
    TEST_ASSERT_TRUE(set_integral_limits(-60, 60));
    config.gains.ki_q24 = 838861;
    TEST_ASSERT_TRUE(set_gains());
    step(-10000, 0);
    TEST_ASSERT_EQUAL_INT32(-60 * INT32_C(65536), integral());
    has_no_fraction_above();
}

void test_seed_integral_taken_over_has_no_fraction(void)
{
    start_with_a_fraction(50);
    seed(10);
    step(0, 0);
    TEST_ASSERT_EQUAL_INT32(10 * INT32_C(65536), integral());
    has_no_fraction();
}

void test_set_integral_limits_leave_no_fraction_at_a_limit(void)
{
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_integral_limits(-60, 50));
    has_no_fraction();
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_integral_limits(51, 60));
    TEST_ASSERT_EQUAL_INT32(51 * INT32_C(65536), integral());
    has_no_fraction_above();
}

void test_set_integral_limits_keep_the_fraction_inside(void)
{
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_integral_limits(50, 60));
    step(55, 0); // 200 + 55
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536), integral());
    step(1, 0);
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536) + 1, integral());
}

void test_set_limits_leave_no_fraction_at_a_limit(void)
{
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_limits(-60, 50));
    has_no_fraction();
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_limits(51, 60));
    TEST_ASSERT_EQUAL_INT32(51 * INT32_C(65536), integral());
    has_no_fraction();
}

void test_set_limits_keep_the_fraction_inside(void)
{
    start_with_a_fraction(50);
    TEST_ASSERT_TRUE(set_limits(50, 60));
    step(55, 0); // 200 + 55
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536), integral());
    step(1, 0);
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536) + 1, integral());
}

// A proportional term of 1/256 takes away nothing at the upper limit.
void test_set_limits_smallest_term_counts_on_its_side_only(void)
{
    config.gains.kp_q8 = 1;
    config.gains.ki_q24 = 0;
    TEST_ASSERT_TRUE(init());
    seed(100);
    step(0, 0);
    step(1, 0);
    TEST_ASSERT_TRUE(set_limits(0, 50));
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_limits(60, 70));
    TEST_ASSERT_EQUAL_INT32(60 * INT32_C(65536) - 256, integral());
}

// The widest integral, the largest change: every exponent of ki.
void test_step_integral_from_end_to_end_does_not_overflow(void)
{
    static const uint32_t gains[] = {32767, 8388479, FIXPID_PID_KI_MAX};

    for (unsigned g = 0; g < 3; g++) {
        config.gains.ki_q24 = gains[g];
        config.gains.kp_q8 = 0;
        config.output_min = INT16_MIN;
        config.output_max = INT16_MAX;
        TEST_ASSERT_TRUE(init());
        for (int n = 0; n < 6; n++) {
            step(INT16_MAX, INT16_MIN);
        }
        for (int n = 0; n < 6; n++) {
            step(INT16_MIN, INT16_MAX);
        }
        seed(INT16_MAX);
        step(0, 0);
        TEST_ASSERT_EQUAL_INT32(32767 * INT32_C(65536), integral());
        step(INT16_MAX, INT16_MIN);
        TEST_ASSERT_EQUAL_INT32(32767 * INT32_C(65536), integral());
        seed(-32767);
        step(0, 0);
        step(INT16_MIN, INT16_MAX);
        TEST_ASSERT_EQUAL_INT32(-32767 * INT32_C(65536), integral());
        step(INT16_MAX, INT16_MIN);
    }
}

// 32767 + 1 counts, the first sum that 24 bits do not hold, is above the limit
// of the integral and not below it.
void test_step_integral_of_32768_counts_is_at_its_upper_limit(void)
{
    config.gains = (struct fixpid_pid_gains){0, UINT32_C(1) << 24, 0, 0};
    config.output_min = -32767;
    config.output_max = 32767;
    TEST_ASSERT_TRUE(init());
    seed(32767);
    step(0, 0);
    TEST_ASSERT_EQUAL_INT16(32767, step(1, 0));
    TEST_ASSERT_EQUAL_INT32(INT32_C(32767) * 65536, integral());
}

void test_step_every_term_at_its_end_gives_the_limit(void)
{
    config.gains.ki_q24 = FIXPID_PID_KI_MAX;
    config.gains.kp_q8 = 32767;
    config.gains.kd_q8 = 32255;
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    TEST_ASSERT_TRUE(init());
    step(INT16_MAX, INT16_MAX);
    set_feedforward(INT16_MAX);
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, step(INT16_MAX, INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, step(INT16_MAX, INT16_MIN));
    set_feedforward(INT16_MIN);
    TEST_ASSERT_EQUAL_INT16(INT16_MIN, step(INT16_MIN, INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(INT16_MIN, step(INT16_MIN, INT16_MAX));
}

// ---- Modes and live changes ----

// Each product takes a ki of 15 bits at most, also where an exponent ends and
// the next one has the same number.
void test_set_gains_ki_is_kept_in_15_bits_with_the_finest_exponent(void)
{
    static const struct {
        uint32_t ki_q24;
        uint16_t kept;
    } rows[] = {{32767, 32767},
                {32768, 128},
                {8388479, 32767},
                {8388480, 128},
                {FIXPID_PID_KI_MAX, 32767}};

    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        config.gains.ki_q24 = rows[n].ki_q24;
        TEST_ASSERT_TRUE(set_gains());
        TEST_ASSERT_EQUAL_UINT16(rows[n].kept, pid_controller.ki);
    }
}

void test_set_gains_refuses_field_by_field_and_changes_nothing(void)
{
    static const struct fixpid_pid_gains others = {300, 70000, 200, 2};
    int16_t before;

    step(100, 50);
    before = step(100, 100);
    config.gains = others;
    config.gains.kp_q8 = 32768;
    TEST_ASSERT_FALSE(set_gains());
    config.gains = others;
    config.gains.ki_q24 = UINT32_C(0x7FFF0001);
    TEST_ASSERT_FALSE(set_gains());
    config.gains = others;
    config.gains.kd_q8 = 32256;
    TEST_ASSERT_FALSE(set_gains());
    config.gains = others;
    config.gains.derivative_filter = 8;
    TEST_ASSERT_FALSE(set_gains());
    TEST_ASSERT_EQUAL_INT16(before, step(100, 100));
    step(100, 60);
}

void test_set_gains_without_error_does_not_move_the_output(void)
{
    int16_t before;

    for (int n = 0; n < 50; n++) {
        step(700, 680);
    }
    before = step(700, 700);
    config.gains.ki_q24 *= 4;
    config.gains.kp_q8 *= 3;
    config.gains.kd_q8 = 999;
    TEST_ASSERT_TRUE(set_gains());
    TEST_ASSERT_EQUAL_INT16(before, step(700, 700));
}

void test_set_gains_keeps_options_and_weight(void)
{
    config.reverse = true;
    config.derivative_on_error = true;
    config.setpoint_weight_q8 = 100;
    config.output_min = -255;
    TEST_ASSERT_TRUE(init());
    step(100, 50);
    config.gains.derivative_filter = 5;
    TEST_ASSERT_TRUE(set_gains());
    config.gains.ki_q24 = 5;
    TEST_ASSERT_TRUE(set_gains());
    step(100, 60);
    config.gains.ki_q24 = FIXPID_PID_KI_MAX;
    TEST_ASSERT_TRUE(set_gains());
    step(100, 55);
}

void test_set_limits_without_room_changes_nothing(void)
{
    TEST_ASSERT_FALSE(set_limits(5, 5));
    TEST_ASSERT_FALSE(set_limits(6, 5));
    TEST_ASSERT_EQUAL_INT16(255, step(1000, 0));
}

void test_set_limits_drops_what_would_be_windup(void)
{
    for (int n = 0; n < 600; n++) {
        step(700, 690);
    }
    TEST_ASSERT_EQUAL_INT16(235, step(700, 700));
    TEST_ASSERT_TRUE(set_limits(0, 100));
    TEST_ASSERT_EQUAL_INT32(100 * INT32_C(65536), integral());
    TEST_ASSERT_EQUAL_INT16(100, step(700, 700));
    TEST_ASSERT_EQUAL_INT16(98, step(700, 701)); // 100 - 2 - 0.05
}

void test_set_limits_keeps_what_other_terms_take_away_again(void)
{
    config.proportional_on_measurement = true;
    config.output_max = 10000;
    TEST_ASSERT_TRUE(init());
    for (int n = 0; n < 2000; n++) {
        step(100, 99);
    }
    for (int n = 0; n < 1000; n++) {
        step(100, (int16_t)(n % 2 == 0 ? 100 : 101));
    }
    set_feedforward(-20);
    TEST_ASSERT_TRUE(set_limits(0, 20));
    TEST_ASSERT_LESS_OR_EQUAL_INT32((20 + 20 + 202) * INT32_C(65536),
                                    integral());
    step(100, 101);
    TEST_ASSERT_TRUE(set_limits(9000, 9001));
    step(100, 101);
}

void test_set_limits_raises_the_integral_to_the_lower_one(void)
{
    step(100, 100);
    TEST_ASSERT_TRUE(set_limits(50, 100));
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536), integral());
    set_feedforward(20);
    TEST_ASSERT_TRUE(set_limits(60, 100));
    TEST_ASSERT_EQUAL_INT32(50 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_limits(80, 100));
    TEST_ASSERT_EQUAL_INT32(60 * INT32_C(65536), integral());
}

void test_set_limits_integral_just_below_the_lower_one_is_raised(void)
{
    config.gains.kp_q8 = 0;
    config.gains.ki_q24 = 65536; // 1/256 per step and count
    TEST_ASSERT_TRUE(init());
    seed(10);
    step(0, 0);
    step(0, 1);
    TEST_ASSERT_EQUAL_INT32(10 * 65536 - 256, integral());
    TEST_ASSERT_TRUE(set_limits(10, 255));
    TEST_ASSERT_EQUAL_INT32(10 * 65536, integral());
}

void test_set_limits_integral_just_below_the_upper_one_stays(void)
{
    config.gains.kp_q8 = 0;
    config.gains.ki_q24 = 65536; // 1/256 per step and count
    TEST_ASSERT_TRUE(init());
    seed(10);
    step(0, 0);
    step(0, 1);
    TEST_ASSERT_TRUE(set_limits(0, 10));
    TEST_ASSERT_EQUAL_INT32(10 * 65536 - 256, integral());
}

void test_set_limits_lower_one_counts_from_the_lowest_feedforward(void)
{
    config.gains.kp_q8 = 0;
    TEST_ASSERT_TRUE(init());
    set_feedforward(-32768);
    TEST_ASSERT_TRUE(set_limits(-32758, 255));
    TEST_ASSERT_EQUAL_INT32(10 * 65536, integral());
}

void test_set_limits_obeys_the_integral_limits(void)
{
    config.integral_min = -10;
    config.integral_max = 10;
    config.output_min = -1000;
    config.output_max = 1000;
    TEST_ASSERT_TRUE(init());
    step(100, 100);
    TEST_ASSERT_TRUE(set_limits(500, 600));
    TEST_ASSERT_EQUAL_INT32(10 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_limits(-600, -500));
    TEST_ASSERT_EQUAL_INT32(-10 * INT32_C(65536), integral());
    set_feedforward(INT16_MAX);
    TEST_ASSERT_TRUE(set_limits(INT16_MIN, -32767));
    TEST_ASSERT_EQUAL_INT32(-10 * INT32_C(65536), integral());
}

void test_set_limits_moves_an_output_held(void)
{
    set_manual(200);
    TEST_ASSERT_TRUE(set_limits(0, 100));
    TEST_ASSERT_EQUAL_INT16(100, step(700, 650));
    TEST_ASSERT_TRUE(set_limits(150, 300));
    TEST_ASSERT_EQUAL_INT16(150, step(700, 650));
    set_auto();
    TEST_ASSERT_TRUE(set_limits(0, 90));
    TEST_ASSERT_EQUAL_INT16(90, step(700, 650));
}

void test_set_integral_limits_refuses_and_changes_nothing(void)
{
    TEST_ASSERT_FALSE(set_integral_limits(INT16_MIN, 5));
    TEST_ASSERT_FALSE(set_integral_limits(6, 5));
    for (int n = 0; n < 100; n++) {
        step(100, 99);
    }
    TEST_ASSERT_EQUAL_INT32(100 * INT32_C(3277), integral());
    TEST_ASSERT_TRUE(set_integral_limits(5, 5));
    TEST_ASSERT_EQUAL_INT32(5 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(-32767, 32767));
    TEST_ASSERT_EQUAL_INT32(5 * INT32_C(65536), integral());
}

void test_set_integral_limits_moves_the_integral_at_once(void)
{
    for (int n = 0; n < 100; n++) {
        step(100, 90);
    }
    TEST_ASSERT_TRUE(set_integral_limits(-5, 30));
    TEST_ASSERT_EQUAL_INT32(30 * INT32_C(65536), integral());
    TEST_ASSERT_TRUE(set_integral_limits(40, 50));
    TEST_ASSERT_EQUAL_INT32(40 * INT32_C(65536), integral());
}

void test_set_integral_limits_waits_while_the_output_is_held(void)
{
    set_manual(200);
    TEST_ASSERT_TRUE(set_integral_limits(-5, 30));
    TEST_ASSERT_EQUAL_INT32(200 * INT32_C(65536), integral());
    TEST_ASSERT_EQUAL_INT16(200, step(100, 100));
    set_auto();
    TEST_ASSERT_TRUE(set_integral_limits(-5, 31));
    TEST_ASSERT_EQUAL_INT32(200 * INT32_C(65536), integral());
    TEST_ASSERT_EQUAL_INT16(31, step(100, 100));
    TEST_ASSERT_EQUAL_INT32(31 * INT32_C(65536), integral());
}

void test_set_manual_holds_the_output_inside_the_limits(void)
{
    step(700, 500);
    set_manual(120);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL | FIXPID_PID_AT_MAX, flags());
    for (int16_t n = 0; n < 10; n++) {
        TEST_ASSERT_EQUAL_INT16(120, step(700, n));
        TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL, flags());
        TEST_ASSERT_EQUAL_INT32(120 * INT32_C(65536), integral());
    }
    set_manual(256);
    TEST_ASSERT_EQUAL_INT16(255, step(700, 0));
    set_manual(-1);
    TEST_ASSERT_EQUAL_INT16(0, step(700, 0));
}

void test_set_manual_proportional_and_derivative_follow_the_process(void)
{
    config.gains.kd_q8 = 256;
    TEST_ASSERT_TRUE(init());
    set_manual(100);
    step(700, 600);
    step(700, 610);
    TEST_ASSERT_EQUAL_INT32(INT32_C(512) * 90,
                            fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(256 * -10, fixpid_pid_derivative(&pid_controller));
}

void test_set_auto_gives_the_output_held_and_integrates_from_the_next(void)
{
    int32_t taken_over;

    set_manual(120);
    step(700, 650);
    set_auto();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT16(120, step(700, 640));
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    taken_over = integral();
    TEST_ASSERT_EQUAL_INT32((120 - 120) * INT32_C(65536), taken_over);
    step(700, 640);
    TEST_ASSERT_EQUAL_INT32(taken_over + INT32_C(60) * 3277, integral());
}

void test_set_auto_in_automatic_has_no_effect(void)
{
    step(700, 650);
    set_auto();
    TEST_ASSERT_BITS_LOW(FIXPID_PID_SEEDED, flags());
    seed(50);
    set_auto();
    TEST_ASSERT_BITS_HIGH(FIXPID_PID_SEEDED, flags());
}

void test_set_auto_before_the_first_step_starts_without_a_bump(void)
{
    set_manual(33);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST | FIXPID_PID_MANUAL, flags());
    set_auto();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST | FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT16(33, step(500, 490));
}

void test_take_over_beyond_the_integral_limits_is_flagged(void)
{
    config.integral_min = -10;
    config.integral_max = 10;
    TEST_ASSERT_TRUE(init());
    set_manual(100);
    set_auto();
    TEST_ASSERT_EQUAL_INT16(255, step(700, 0));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX | FIXPID_PID_INTEGRAL_AT_LIMIT,
                           flags());
    TEST_ASSERT_EQUAL_INT32(-10 * INT32_C(65536), integral());
    set_manual(100);
    set_auto();
    TEST_ASSERT_EQUAL_INT16(0, step(0, 700));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MIN | FIXPID_PID_INTEGRAL_AT_LIMIT,
                           flags());
    TEST_ASSERT_EQUAL_INT32(10 * INT32_C(65536), integral());
}

void test_take_over_from_the_largest_terms_does_not_overflow(void)
{
    config.gains.kp_q8 = 32767;
    config.gains.kd_q8 = 32255;
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    TEST_ASSERT_TRUE(init());
    for (int n = 0; n < 2; n++) {
        step(INT16_MAX, INT16_MAX);
        set_feedforward(INT16_MAX);
        seed(INT16_MIN);
        step(INT16_MAX, INT16_MIN);
        set_feedforward(INT16_MIN);
        seed(INT16_MAX);
        step(INT16_MIN, INT16_MAX);
        TEST_ASSERT_TRUE(set_limits(-1, 0));
        TEST_ASSERT_TRUE(set_limits(INT16_MIN, INT16_MAX));
    }
}

void test_seed_starts_from_a_given_output_inside_the_limits(void)
{
    seed(77);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST | FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT32(77 * INT32_C(65536), integral());
    TEST_ASSERT_EQUAL_INT16(77, step(500, 450));
    seed(300);
    TEST_ASSERT_EQUAL_INT16(255, step(500, 450));
    TEST_ASSERT_EQUAL_HEX8(0, flags());
    seed(-300);
    TEST_ASSERT_EQUAL_INT16(0, step(500, 450));
}

void test_seed_in_manual_moves_the_output_held(void)
{
    set_manual(10);
    seed(99);
    TEST_ASSERT_BITS_HIGH(FIXPID_PID_MANUAL, flags());
    TEST_ASSERT_BITS_LOW(FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT16(99, step(500, 450));
    seed(98);
    set_auto();
    set_manual(97);
    TEST_ASSERT_BITS_LOW(FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT16(97, step(500, 450));
}

// ---- Tracking ----

// The table's rows: automatic, a limit reached each time.
void test_track_worked_example_gives_the_table(void)
{
    static const struct {
        int16_t measurement, output;
        uint8_t shift;
        int32_t integral;
    } rows[] = {
        {600, 205, 0, -3276780}, {640, 73, 2, -1818592}, {660, 54, 2, -114648},
        {660, 80, 15, 16572},    {660, 82, 200, 147788},
    };

    for (unsigned n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        TEST_ASSERT_EQUAL_INT16(rows[n].output, step(700, rows[n].measurement));
        track(150, rows[n].shift);
        TEST_ASSERT_EQUAL_INT32(rows[n].integral, integral());
        TEST_ASSERT_EQUAL_INT16(150, fixpid_pid_output(&pid_controller));
    }
}

// The integral begins at 0, without a fraction, and the output is 0.
static void start_without_gains(void)
{
    memset(&config, 0, sizeof config);
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(0, step(0, 0));
}

void test_track_each_shift_divides_exactly(void)
{
    static const int16_t differences[] = {1, -1, 3, -3, 12345, -12345, 32766};
    const unsigned count = sizeof differences / sizeof differences[0];

    start_without_gains();
    for (int16_t shift = 0; shift <= 255; shift++) {
        const int32_t part = 65536 >> (shift < 15 ? shift : 15);

        for (unsigned n = 0; n < count; n++) {
            reset();
            step(0, 0);
            track(differences[n], (uint8_t)shift);
            TEST_ASSERT_EQUAL_INT32(differences[n] * part, integral());
        }
    }
}

void test_track_the_ends_of_int16_are_kept(void)
{
    start_without_gains();
    track(INT16_MIN, 1);
    TEST_ASSERT_EQUAL_INT32(-INT32_C(32768) * 32768, integral());
    // The difference saturates: 32767 and not 65535.
    track(INT16_MAX, 1);
    TEST_ASSERT_EQUAL_INT32(-INT32_C(32768), integral());
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, fixpid_pid_output(&pid_controller));
    // -32768 and not -65535
    track(INT16_MIN, 15);
    TEST_ASSERT_EQUAL_INT32(-INT32_C(3) * 32768, integral());
}

void test_track_sum_beyond_32_bits_is_the_limit(void)
{
    start_without_gains();
    for (int n = 0; n < 3; n++) { // 0 is behind an int16_t
        track(30000, 0);
        track(0, 15);
    }
    TEST_ASSERT_EQUAL_INT32(INT32_C(32767) * 65536 - 60000, integral());
    for (int n = 0; n < 4; n++) {
        track(-30000, 0);
        track(0, 15);
    }
    TEST_ASSERT_EQUAL_INT32(-INT32_C(32767) * 65536 + 60000, integral());
}

void test_track_keeps_the_integral_within_its_limits(void)
{
    start_without_gains();
    TEST_ASSERT_TRUE(set_integral_limits(-50, 20));
    track(20, 0);
    TEST_ASSERT_EQUAL_INT32(20 * 65536, integral());
    track(21, 0);
    TEST_ASSERT_EQUAL_INT32(20 * 65536, integral());
    track(21 - 70, 0);
    TEST_ASSERT_EQUAL_INT32(-50 * 65536, integral());
    track(21 - 71, 15);
    TEST_ASSERT_EQUAL_INT32(-50 * 65536, integral());
}

void test_track_keeps_the_fraction_inside(void)
{
    start_with_a_fraction(10);
    track((int16_t)(fixpid_pid_output(&pid_controller) + 100), 3);
    track((int16_t)(fixpid_pid_output(&pid_controller) - 100), 3);
    step(55, 0); // with the 200 of before 255 of 256
    TEST_ASSERT_EQUAL_INT32(10 * 65536, integral());
    step(1, 0);
    TEST_ASSERT_EQUAL_INT32(10 * 65536 + 1, integral());
}

void test_track_leaves_no_fraction_at_a_limit(void)
{
    start_with_a_fraction(10);
    TEST_ASSERT_TRUE(set_integral_limits(-20, 20));
    track((int16_t)(fixpid_pid_output(&pid_controller) + 10), 0);
    TEST_ASSERT_EQUAL_INT32(20 * 65536, integral());
    TEST_ASSERT_TRUE(set_integral_limits(-100, 100));
    has_no_fraction();
    start_with_a_fraction(10);
    TEST_ASSERT_TRUE(set_integral_limits(-20, 20));
    track((int16_t)(fixpid_pid_output(&pid_controller) - 31), 0);
    TEST_ASSERT_EQUAL_INT32(-20 * 65536, integral());
    has_no_fraction_above();
}

void test_track_what_the_step_returned_changes_nothing(void)
{
    const int16_t output = step(700, 640);
    const int32_t before = integral();

    for (int16_t shift = 0; shift < 20; shift++) {
        track(output, (uint8_t)shift);
        TEST_ASSERT_EQUAL_INT32(before, integral());
    }
}

void test_track_second_time_changes_nothing(void)
{
    int32_t once;

    step(700, 640);
    track(30, 3);
    once = integral();
    track(30, 3);
    TEST_ASSERT_EQUAL_INT32(once, integral());
}

void test_track_chain_of_limiters_is_the_last_one_alone(void)
{
    int32_t chained;

    step(700, 640);
    track(60, 3);
    track(45, 3);
    track(20, 3);
    chained = integral();
    TEST_ASSERT_TRUE(init());
    step(700, 640);
    track(20, 3);
    TEST_ASSERT_EQUAL_INT32(chained, integral());
}

void test_track_leaves_the_flags_and_the_other_terms(void)
{
    config.gains.kd_q8 = 100;
    TEST_ASSERT_TRUE(init());
    step(700, 0);
    TEST_ASSERT_EQUAL_INT16(255, step(700, 10));
    track(100, 4);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_AT_MAX, flags());
    TEST_ASSERT_EQUAL_INT32(INT32_C(512) * 690,
                            fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(-1000, fixpid_pid_derivative(&pid_controller));
}

void test_track_before_the_first_step_changes_nothing(void)
{
    track(100, 0);
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    seed(50);
    track(100, 0);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    set_manual(60);
    track(100, 0);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(60 * 65536, integral());
    TEST_ASSERT_EQUAL_INT16(60, step(700, 0));
    reset();
    track(100, 0);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(0, integral());
}

void test_track_by_hand_remembers_and_moves_nothing(void)
{
    step(700, 640);
    set_manual(60);
    track(100, 0); // before its first step
    TEST_ASSERT_EQUAL_INT16(100, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(60, step(700, 640));
    TEST_ASSERT_EQUAL_INT16(60, fixpid_pid_output(&pid_controller));
    track(100, 0); // and after it
    TEST_ASSERT_EQUAL_INT16(100, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(60 * 65536, integral());
    set_auto();
    track(90, 0);
    TEST_ASSERT_EQUAL_INT32(60 * 65536, integral());
    TEST_ASSERT_EQUAL_INT16(60, step(700, 640));
}

void test_track_after_a_seed_remembers_until_its_first_step(void)
{
    int32_t before;

    step(700, 640);
    seed(70);
    track(100, 0);
    TEST_ASSERT_EQUAL_INT16(100, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(70 * 65536, integral());
    TEST_ASSERT_EQUAL_INT16(70, step(700, 640));
    before = integral();
    track(72, 0);
    TEST_ASSERT_EQUAL_INT32(before + 2 * 65536, integral());
}

void test_track_settings_since_the_step_change_nothing(void)
{
    int32_t before;

    step(700, 640);
    before = integral();
    config.gains.kp_q8 = 1000;
    TEST_ASSERT_TRUE(set_gains());
    set_feedforward(55);
    TEST_ASSERT_TRUE(set_limits(-1000, 1000));
    track((int16_t)(fixpid_pid_output(&pid_controller) + 16), 4);
    TEST_ASSERT_EQUAL_INT32(before + 65536, integral());
}

void test_track_refused_or_all_zero_controller_ignores_it(void)
{
    memset(&pid_controller, 0, sizeof pid_controller);
    fixpid_pid_track(&pid_controller, 100, 0);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 700, 0));
    fixpid_pid_track(&pid_controller, -100, 15);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(0, integral());
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED, flags());
}

void test_output_is_what_the_last_step_returned(void)
{
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    step(700, 640); // within, above and below the limits
    TEST_ASSERT_EQUAL_INT16(123, fixpid_pid_output(&pid_controller));
    step(700, 0);
    TEST_ASSERT_EQUAL_INT16(255, fixpid_pid_output(&pid_controller));
    step(0, 700);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    set_manual(77);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    step(0, 700);
    TEST_ASSERT_EQUAL_INT16(77, fixpid_pid_output(&pid_controller));
    TEST_ASSERT_FALSE(set_limits(1, 0));
    reset();
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
}

// New gains at any error: a seed of the last output is the start with them.
void test_output_as_a_seed_after_new_gains_is_no_bump(void)
{
    step(700, 640);
    step(700, 640);
    config.gains.kp_q8 = 1300;
    TEST_ASSERT_TRUE(set_gains());
    seed(fixpid_pid_output(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(126, step(700, 640));
}

// ---- Macros ----

void test_macros_fold_real_units(void)
{
    static const struct fixpid_pid_gains gains =
        FIXPID_PID_GAINS(2.5, 0.5, 0.1, 100, 2);
    static const uint32_t kp[] = {
        FIXPID_PID_KP(0),
        FIXPID_PID_KP(0.001953125),
        FIXPID_PID_KP(1.49 / 256),
        FIXPID_PID_KP(127.998),
    };
    static const uint32_t ki[] = {
        FIXPID_PID_KI(0, 100),          FIXPID_PID_KI(8.0 / 16777216, 1),
        FIXPID_PID_KI(127.99609375, 1), FIXPID_PID_TI(2, 30, 10),
        FIXPID_PID_TI(0, 10, 1),
    };
    static const uint32_t kd[] = {
        FIXPID_PID_KD(0, 1, 0),        FIXPID_PID_KD(0.25 / 128, 1, 0),
        FIXPID_PID_KD(125.998, 1, 0),  FIXPID_PID_KD(161, 100, 7),
        FIXPID_PID_TD(1.5, 4, 100, 4),
    };

    TEST_ASSERT_EQUAL_UINT32(83886, gains.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(640, gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT16(640, gains.kd_q8);
    TEST_ASSERT_EQUAL_UINT8(2, gains.derivative_filter);
    TEST_ASSERT_EQUAL_UINT32(0, kp[0]);
    TEST_ASSERT_EQUAL_UINT32(1, kp[1]);
    TEST_ASSERT_EQUAL_UINT32(1, kp[2]);
    TEST_ASSERT_EQUAL_UINT32(32767, kp[3]);
    TEST_ASSERT_EQUAL_UINT32(0, ki[0]);
    TEST_ASSERT_EQUAL_UINT32(8, ki[1]);
    TEST_ASSERT_EQUAL_UINT32(FIXPID_PID_KI_MAX, ki[2]);
    TEST_ASSERT_EQUAL_UINT32(111848, ki[3]);
    TEST_ASSERT_EQUAL_UINT32(0, ki[4]);
    TEST_ASSERT_EQUAL_UINT32(0, kd[0]);
    TEST_ASSERT_EQUAL_UINT32(1, kd[1]);
    TEST_ASSERT_EQUAL_UINT32(32255, kd[2]);
    TEST_ASSERT_EQUAL_UINT32(32200, kd[3]);
    TEST_ASSERT_EQUAL_UINT32(9600, kd[4]);
}

// ---- Memory ----

static void init_good(void)
{
    (void)fixpid_pid_init(&pid_controller, &config);
}

static void init_bad(void)
{
    struct fixpid_pid_config bad = config;
    bad.setpoint_weight_q8 = 257;
    (void)fixpid_pid_init(&pid_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    const size_t padding = POISON_PADDING(struct fixpid_pid, output);

    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&pid_controller, sizeof(pid_controller), init_good));
    TEST_ASSERT_EQUAL_UINT(
        padding,
        poison_left(&pid_controller, sizeof(pid_controller), init_bad));
}

// ---- Flipped bits ----

static int16_t within_limits(int16_t output)
{
    const int16_t low = pid_controller.output_min;
    const int16_t high = pid_controller.output_max;

    if (low <= high) {
        TEST_ASSERT_GREATER_OR_EQUAL_INT16(low, output);
        TEST_ASSERT_LESS_OR_EQUAL_INT16(high, output);
    } else {
        TEST_ASSERT_TRUE((output == low) || (output == high));
    }
    return output;
}

static int16_t plain_step(void)
{
    const int16_t setpoint = numbers_int16();

    return fixpid_pid_step(&pid_controller, setpoint, numbers_int16());
}

void test_step_by_hand_a_flipped_bit_keeps_the_output_within_its_limits(void)
{
    fixpid_pid_init(&pid_controller, &valve);
    fixpid_pid_set_manual(&pid_controller, 50);
    pid_controller.integral ^= INT32_C(0x40000000);
    TEST_ASSERT_EQUAL_INT16(255, fixpid_pid_step(&pid_controller, 0, 0));
    TEST_ASSERT_EQUAL_INT16(255, fixpid_pid_output(&pid_controller));
    pid_controller.integral = -INT32_C(0x40000000);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 0, 0));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_output(&pid_controller));
    pid_controller.integral = INT32_C(256) * 65536; // just beyond
    TEST_ASSERT_EQUAL_INT16(255, fixpid_pid_step(&pid_controller, 0, 0));
    pid_controller.integral = -65536;
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 0, 0));
}

// An integral of -190 counts becomes the output held.
void test_step_a_status_flipped_to_manual_keeps_the_output_within_its_limits(
    void)
{
    fixpid_pid_init(&pid_controller, &valve);
    (void)fixpid_pid_step(&pid_controller, 0, 0);
    pid_controller.integral = INT32_C(-190) * 65536;
    pid_controller.status |= FIXPID_PID_MANUAL;
    for (unsigned i = 0; i < 20u; i++) {
        TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step(&pid_controller, 100, 90));
    }
}

// Each bit of a controller that runs, and the 20 steps that follow.
void test_step_each_flipped_bit_keeps_the_output_within_its_limits(void)
{
    static FIXPID_DATA struct fixpid_pid before;
    unsigned char *const bytes = (unsigned char *)&pid_controller;

    numbers_seed(34);
    for (unsigned turn = 0; turn < 8u; turn++) {
        config = valve;
        config.gains.kd_q8 = FIXPID_PID_KD_MAX;
        config.gains.derivative_filter = (uint8_t)(turn & 3u);
        TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
        for (unsigned i = 0; i < 30u; i++) {
            (void)plain_step();
        }
        if ((turn & 4u) != 0u) {
            fixpid_pid_set_manual(&pid_controller, 100);
        }
        memcpy(&before, &pid_controller, sizeof before);
        for (unsigned bit = 0; bit < 8u * sizeof before; bit++) {
            memcpy(&pid_controller, &before, sizeof before);
            bytes[bit / 8u] ^= (unsigned char)(1u << (bit % 8u));
            for (unsigned i = 0; i < 20u; i++) {
                within_limits(plain_step());
            }
        }
    }
}

// Nothing undefined comes of it either, which the sanitizers see.
void test_step_of_any_bytes_stays_within_its_limits(void)
{
    numbers_seed(35);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        numbers_fill(&pid_controller, sizeof pid_controller);
        within_limits(plain_step());
        numbers_fill(&pid_controller, sizeof pid_controller);
        (void)fixpid_pid_set_limits(&pid_controller, -100, 100);
        (void)fixpid_pid_set_integral_limits(&pid_controller, -90, 90);
        fixpid_pid_track(&pid_controller, numbers_int16(), 3);
        within_limits(plain_step());
        within_limits(fixpid_pid_step_error(&pid_controller, any_difference(),
                                            (int32_t)turn * -7777));
    }
}
