// SPDX-License-Identifier: MIT
// The step by the error, beside the plain one: in a program of its own, because
// an AVR has no room for both with their names.
#include <stddef.h>
#include <string.h>

#include "fixpid_pid.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "pid_both.h"
#include "reference_pid.h"
#include "unity.h"
#include "vectors.h"
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

static int16_t step_error(int32_t error, int32_t rise)
{
    const int64_t expected = reference_pid_step_error(&reference, error, rise);
    const int16_t output = fixpid_pid_step_error(&pid_controller, error, rise);

    TEST_ASSERT_EQUAL_INT16(expected, output);
    compare();
    return output;
}

static int16_t either_step(const int32_t row[])
{
    const int32_t first = row[BY_ERROR_FIRST];
    const int32_t second = row[BY_ERROR_SECOND];

    return (row[BY_ERROR] != 0) ? step_error(first, second)
                                : step((int16_t)first, (int16_t)second);
}

void test_step_error_recorded_rows_match_the_definition(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(step_error);
    while (vectors_next(row)) {
        vectors_pid_config(&config, row);
        TEST_ASSERT_EQUAL(row[TRACK_ACCEPTED] != 0, before_the_step(row));
        TEST_ASSERT_EQUAL_INT16(row[BY_ERROR_OUTPUT], either_step(row));
        if (row[BY_ERROR_TRACKED] != 0) {
            track((int16_t)row[BY_ERROR_APPLIED], (uint8_t)row[BY_ERROR_SHIFT]);
        }
        TEST_ASSERT_EQUAL_INT16(row[BY_ERROR_LAST_OUTPUT],
                                fixpid_pid_output(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(row[BY_ERROR_P],
                                fixpid_pid_proportional(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(row[BY_ERROR_I], integral());
        TEST_ASSERT_EQUAL_INT32(row[BY_ERROR_D],
                                fixpid_pid_derivative(&pid_controller));
        TEST_ASSERT_EQUAL_HEX8(row[BY_ERROR_STATUS], flags());
        rows++;
    }
    TEST_ASSERT_EQUAL_UINT(500, rows);
}

void test_step_error_random_mixtures_match_the_definition(void)
{
    int16_t setpoint = 0;
    int16_t measurement;

    for (uint32_t n = 0; n < TEST_RANDOM_STEPS; n++) {
        if (numbers_below(16) == 0) {
            any_setting();
        }
        if (numbers_below(4) == 0) {
            numbers_pid_inputs(&setpoint, &measurement);
            step(setpoint, measurement);
        } else {
            const int32_t error = any_difference();

            step_error(error, any_difference());
        }
        if (numbers_below(8) == 0) {
            track((int16_t)(numbers_int16() / 256), (uint8_t)numbers_below(16));
        }
    }
}

// The differences are exact, and there is no weight. Each step is made twice,
// from the same object.
static void both_steps_leave_the_same(int16_t setpoint, int16_t measurement,
                                      int16_t last)
{
    static FIXPID_DATA struct fixpid_pid before;
    static FIXPID_DATA struct fixpid_pid after;
    int16_t output;

    memcpy(&before, &pid_controller, sizeof before);
    output = fixpid_pid_step(&pid_controller, setpoint, measurement);
    memcpy(&after, &pid_controller, sizeof after);
    memcpy(&pid_controller, &before, sizeof before);
    TEST_ASSERT_EQUAL_INT16(
        output,
        fixpid_pid_step_error(&pid_controller, (int32_t)setpoint - measurement,
                              (int32_t)measurement - last));
    TEST_ASSERT_EQUAL_MEMORY(&after, &pid_controller, sizeof after);
}

static void any_change(void)
{
    const int16_t value = numbers_int16();

    switch (numbers_below(6)) {
    case 0:
        numbers_pid_config(&config);
        config.setpoint_weight_q8 = 0;
        config.proportional_on_measurement = false;
        (void)fixpid_pid_init(&pid_controller, &config);
        break;
    case 1:
        fixpid_pid_reset(&pid_controller);
        break;
    case 2:
        fixpid_pid_set_manual(&pid_controller, value);
        break;
    case 3:
        fixpid_pid_seed(&pid_controller, value);
        break;
    case 4:
        fixpid_pid_track(&pid_controller, value, 3);
        break;
    default:
        fixpid_pid_set_auto(&pid_controller);
        break;
    }
}

void test_step_error_exact_differences_leave_the_object_that_step_leaves(void)
{
    int16_t setpoint = 0;
    int16_t measurement = 0;

    for (uint32_t n = 0; n < TEST_RANDOM_STEPS; n++) {
        int16_t last = measurement;

        if (numbers_below(16) == 0) {
            any_change();
        }
        if ((flags() & FIXPID_PID_FIRST) != 0u) {
            last = 0;
        }
        numbers_pid_inputs(&setpoint, &measurement);
        both_steps_leave_the_same(setpoint, measurement, last);
    }
}

// sat16(error) and sat16(-rise), in reverse sat16(-error) and sat16(rise).
void test_step_error_differences_beyond_16_bits_saturate(void)
{
    static const struct {
        int32_t difference;
        int16_t kept;
        int16_t negated;
    } rows[] = {
        {INT32_MAX, INT16_MAX, INT16_MIN},
        {40000, INT16_MAX, INT16_MIN},
        {32769, INT16_MAX, INT16_MIN},
        {32768, INT16_MAX, INT16_MIN},
        {32767, INT16_MAX, -32767},
        {1, 1, -1},
        {0, 0, 0},
        {-1, -1, 1},
        {-32767, -32767, INT16_MAX},
        {-32768, INT16_MIN, INT16_MAX},
        {-32769, INT16_MIN, INT16_MAX},
        {-40000, INT16_MIN, INT16_MAX},
        {INT32_MIN, INT16_MIN, INT16_MAX},
    };

    config.gains.kp_q8 = 256;
    config.gains.kd_q8 = 256;
    for (unsigned n = 0; n < 2u * (sizeof rows / sizeof rows[0]); n++) {
        const int32_t difference = rows[n / 2u].difference;
        const int16_t kept = rows[n / 2u].kept;
        const int16_t negated = rows[n / 2u].negated;

        config.reverse = n % 2u != 0u;
        TEST_ASSERT_TRUE(init());
        step_error(0, 0);
        step_error(difference, difference);
        TEST_ASSERT_EQUAL_INT32(INT32_C(256) *
                                    (config.reverse ? negated : kept),
                                fixpid_pid_proportional(&pid_controller));
        TEST_ASSERT_EQUAL_INT32(INT32_C(256) *
                                    (config.reverse ? kept : negated),
                                fixpid_pid_derivative(&pid_controller));
    }
}

void test_step_error_first_one_has_no_derivative(void)
{
    config.gains.kd_q8 = 256;
    for (unsigned options = 0; options < 4u; options++) {
        config.reverse = (options & 1u) != 0u;
        config.derivative_on_error = (options & 2u) != 0u;
        TEST_ASSERT_TRUE(init());
        step_error(1000, 32767);
        TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
        reset();
        step_error(-1000, INT32_MIN);
        TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    }
}

void test_step_error_proportional_takes_the_whole_error_at_any_weight(void)
{
    for (unsigned options = 0; options < 4u; options++) {
        config.reverse = (options & 1u) != 0u;
        config.proportional_on_measurement = (options & 2u) != 0u;
        config.setpoint_weight_q8 =
            config.proportional_on_measurement ? 0u : 64u;
        TEST_ASSERT_TRUE(init());
        step_error(100, 0);
        TEST_ASSERT_EQUAL_INT32(INT32_C(512) * (config.reverse ? -100 : 100),
                                fixpid_pid_proportional(&pid_controller));
        step(400, 0); // weighs it again
        TEST_ASSERT_EQUAL_INT32(config.proportional_on_measurement
                                    ? 0
                                    : INT32_C(512) *
                                          (config.reverse ? -100 : 100),
                                fixpid_pid_proportional(&pid_controller));
    }
}

void test_step_error_with_the_derivative_on_the_error_ignores_the_rise(void)
{
    config.gains.kd_q8 = 256;
    config.derivative_on_error = true;
    TEST_ASSERT_TRUE(init());
    step_error(10, 5);
    step_error(17, 30000);
    TEST_ASSERT_EQUAL_INT32(256 * 7, fixpid_pid_derivative(&pid_controller));
    step_error(17, INT32_MIN);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
}

// A gyro's rises, and then the measurement itself.
void test_step_error_step_after_other_rises_sees_one_jump(void)
{
    config.gains.kd_q8 = 256;
    TEST_ASSERT_TRUE(init());
    step_error(0, 100);
    step_error(0, 100);
    step(0, 30);
    TEST_ASSERT_EQUAL_INT32(INT32_C(256) * (200 - 30),
                            fixpid_pid_derivative(&pid_controller));
    step(0, 30);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    step_error(0, 100);
    reset();
    step(0, 30);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
}

void test_step_error_rising_measurement_lowers_the_output(void)
{
    config.gains.kp_q8 = 0;
    config.gains.ki_q24 = 0;
    config.gains.kd_q8 = 256;
    config.output_min = -100;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(0, step_error(0, 0));
    TEST_ASSERT_EQUAL_INT16(-20, step_error(0, 20));
    config.reverse = true;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(0, step_error(0, 0));
    TEST_ASSERT_EQUAL_INT16(20, step_error(0, 20));
}

void test_step_error_refused_or_all_zero_controller_returns_0(void)
{
    memset(&pid_controller, 0, sizeof pid_controller);
    TEST_ASSERT_EQUAL_INT16(
        0, fixpid_pid_step_error(&pid_controller, INT32_MAX, INT32_MIN));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_pid_step_error(&pid_controller, -70, 5));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_REFUSED, flags());
    config.gains.kp_q8 = 65535;
    TEST_ASSERT_FALSE(init());
    TEST_ASSERT_EQUAL_INT16(0, step_error(70000, 70000));
    TEST_ASSERT_EQUAL_INT16(0, step_error(-70000, 3));
}

void test_step_error_by_hand_and_after_a_seed_is_as_step(void)
{
    seed(70);
    TEST_ASSERT_EQUAL_INT16(70, step_error(60, 0));
    set_manual(100);
    TEST_ASSERT_EQUAL_INT16(100, step_error(60, 0));
    set_auto();
    TEST_ASSERT_EQUAL_INT16(100, step_error(-60, 0));
}

// The lines of the header's table.
static int16_t of_12_bits(uint16_t a, uint16_t b)
{
    return (int16_t)((int16_t)((uint16_t)(a - b) << 4) / 16);
}

static int32_t of_a_circle(uint16_t a, uint16_t b)
{
    int32_t d = (int32_t)a - b;

    if (d >= 18000) {
        d -= 36000;
    }
    if (d < -18000) {
        d += 36000;
    }
    return d;
}

void test_step_error_lines_of_the_header_give_the_difference(void)
{
    const int16_t high = 30000;
    const uint16_t ten = 10;
    const uint16_t eleven = 11;
    const uint16_t r = (uint16_t)-32700;
    const int32_t top = INT32_MAX;

    TEST_ASSERT_EQUAL_INT32(60000, (int32_t)high - -30000);
    TEST_ASSERT_EQUAL_INT32(-1, (int32_t)ten - (int32_t)eleven);
    TEST_ASSERT_EQUAL_INT16(136, (int16_t)((uint16_t)r - (uint16_t)32700));
    TEST_ASSERT_EQUAL_INT16(-32767, (int16_t)((uint16_t)0 - (uint16_t)32767));
    TEST_ASSERT_EQUAL_INT16(INT16_MIN,
                            (int16_t)((uint16_t)0 - (uint16_t)32768u));
    TEST_ASSERT_EQUAL_INT16(11, of_12_bits(5, 4090));
    TEST_ASSERT_EQUAL_INT16(-11, of_12_bits(4090, 5));
    TEST_ASSERT_EQUAL_INT16(-2048, of_12_bits(2048, 0));
    TEST_ASSERT_EQUAL_INT32(200, of_a_circle(100, 35900));
    TEST_ASSERT_EQUAL_INT32(-200, of_a_circle(35900, 100));
    TEST_ASSERT_EQUAL_INT32(
        2, (int32_t)((uint32_t)INT32_MIN + 1u - (uint32_t)top));
}

// A wheel under a torque, its angle in 1/16 counts: from any origin around the
// circle the outputs are those without a wrap.
#define WHEEL_STEPS 60u

static void outputs_from(uint16_t origin, int16_t outputs[WHEEL_STEPS])
{
    int32_t angle_q4 = 0;
    int32_t speed = 0;
    uint16_t last = origin;

    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    for (uint16_t n = 0; n < WHEEL_STEPS; n++) {
        const uint16_t goal = (uint16_t)(origin + ((n < 30u) ? 400u : 0u));
        const uint16_t angle = (uint16_t)(origin + (uint16_t)(angle_q4 / 16));
        const int16_t error = (int16_t)(uint16_t)(goal - angle);
        const int16_t rise = (int16_t)(uint16_t)(angle - last);
        const int16_t torque =
            fixpid_pid_step_error(&pid_controller, error, rise);

        last = angle;
        speed += torque / 4;
        angle_q4 += speed;
        outputs[n] = torque;
    }
}

static void is_as_unwrapped(const int16_t unwrapped[WHEEL_STEPS],
                            uint16_t origin)
{
    int16_t outputs[WHEEL_STEPS];

    outputs_from(origin, outputs);
    TEST_ASSERT_EQUAL_INT16_ARRAY(unwrapped, outputs, WHEEL_STEPS);
}

void test_step_error_wrapped_runs_are_those_without_a_wrap(void)
{
    int16_t unwrapped[WHEEL_STEPS];

    config.gains.kp_q8 = 100;
    config.gains.ki_q24 = 20000;
    config.gains.kd_q8 = 2000;
    config.output_min = -1000;
    config.output_max = 1000;
    outputs_from(1000, unwrapped);
    for (uint32_t origin = 0; origin < 65536u; origin += 16u * 61u) {
        is_as_unwrapped(unwrapped, (uint16_t)origin);
    }
    for (uint32_t origin = 65536u - 420u; origin < 65536u + 20u; origin++) {
        is_as_unwrapped(unwrapped, (uint16_t)origin);
    }
}

// 4 counts of a gyro are a count of the measurement per second. With 10 steps
// per second 200 counts are 5 counts per step.
void test_step_error_gain_of_a_gyro_is_that_of_the_differences(void)
{
    config.output_min = -1000;
    config.gains.kp_q8 = 0;
    config.gains.ki_q24 = 0;
    config.gains.kd_q8 = FIXPID_PID_KD(0.8, 10, 0);
    TEST_ASSERT_TRUE(init());
    step_error(0, 0);
    TEST_ASSERT_EQUAL_INT16(-40, step_error(0, 5));
    config.gains.kd_q8 = FIXPID_PID_KD(0.8, 1.0 / 4, 0);
    TEST_ASSERT_TRUE(init());
    step_error(0, 0);
    TEST_ASSERT_EQUAL_INT16(-40, step_error(0, 200));
}
