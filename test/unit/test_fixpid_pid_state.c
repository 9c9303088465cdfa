// SPDX-License-Identifier: MIT
// The state as bytes, and a controller that goes on from it.
#include <stddef.h>
#include <string.h>

#include "fixpid_pid.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "pid_both.h"
#include "reference_pid.h"
#include "unity.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_check.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_error.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("test/support/reference.c")

#define SIZE FIXPID_PID_STATE_SIZE

// Where each number begins, as the header says.
#define OUTPUT 0
#define FLAGS 2
#define INTEGRAL 3
#define FRACTION 7
#define DERIVATIVE 8
#define FEEDFORWARD 12
#define PREVIOUS 14
#define ERROR 16

FIXPID_DATA struct fixpid_pid pid_controller;

static uint8_t state[SIZE];

void setUp(void)
{
    numbers_seed(964937);
    config = valve;
    TEST_ASSERT_TRUE(init());
}

void tearDown(void)
{
}

static void write(uint8_t at, int32_t value, uint8_t bytes)
{
    for (uint8_t i = 0; i < bytes; i++) {
        state[at + i] = (uint8_t)((uint32_t)value >> (8 * i));
    }
}

// The configuration that makes a controller with these gains, limits and
// options; what init rounds is rounded already.
static void configuration_of(const struct reference_pid *defined)
{
    config.gains.kp_q8 = (uint16_t)defined->kp;
    config.gains.ki_q24 =
        (uint32_t)(defined->ki * ((INT64_C(1) << 24) / defined->ki_divisor));
    config.gains.kd_q8 = (uint16_t)defined->kd;
    config.gains.derivative_filter = (uint8_t)defined->filter;
    config.output_min = (int16_t)defined->output_min;
    config.output_max = (int16_t)defined->output_max;
    config.integral_min = (int16_t)defined->integral_min;
    config.integral_max = (int16_t)defined->integral_max;
    config.setpoint_weight_q8 = (uint16_t)defined->weight;
    config.proportional_on_measurement = defined->weight == 0;
    config.reverse = defined->reverse;
    config.derivative_on_error = defined->on_error;
}

// Another controller, which knows only the configuration and the bytes, goes on
// beside the definition.
static void pass_on(void)
{
    uint8_t again[SIZE];

    fixpid_pid_state(&pid_controller, state);
    configuration_of(&reference);
    memset(&pid_controller, 0xA5, sizeof pid_controller);
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    TEST_ASSERT_TRUE(fixpid_pid_restore(&pid_controller, state));
    compare();
    fixpid_pid_state(&pid_controller, again);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(state, again, SIZE);
}

// Nothing of the object changes.
static void refuses(void)
{
    static FIXPID_DATA struct fixpid_pid before;

    memcpy(&before, &pid_controller, sizeof before);
    TEST_ASSERT_FALSE(fixpid_pid_restore(&pid_controller, state));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid_controller, sizeof before);
}

static void accepts(void)
{
    TEST_ASSERT_TRUE(fixpid_pid_restore(&pid_controller, state));
}

// ---- The bytes ----

// What the definition says of each of them, but for what the derivative saw
// last, whose sign is the controller's own. While the output is held, the
// integral's next eight bits mean nothing, and so does an error without gains.
static void as_defined(void)
{
    const bool held = reference.manual || reference.seeded;
    uint8_t found[SIZE];

    fixpid_pid_state(&pid_controller, found);
    memcpy(state, found, SIZE);
    write(OUTPUT, (int32_t)reference.output, 2);
    write(FLAGS, reference_pid_flags(&reference), 1);
    write(INTEGRAL, (int32_t)reference_pid_integral(&reference), 4);
    if (!held) {
        write(FRACTION, (int32_t)(reference.integral & 0xFF), 1);
    }
    write(DERIVATIVE, (int32_t)reference.derivative, 4);
    write(FEEDFORWARD, (int32_t)reference.feedforward, 2);
    if (!reference.seen) {
        write(PREVIOUS, 0, 2);
    }
    if (reference.accepted) {
        write(ERROR, (int32_t)reference.proportional_error, 2);
    }
    TEST_ASSERT_EQUAL_HEX8_ARRAY(state, found, SIZE);
}

void test_state_bytes_are_as_defined(void)
{
    int16_t setpoint = 0;
    int16_t measurement = 0;

    for (uint32_t n = 0; n < TEST_RANDOM_STEPS / 10; n++) {
        if (numbers_below(8) == 0) {
            any_setting();
            as_defined();
        }
        numbers_pid_inputs(&setpoint, &measurement);
        step(setpoint, measurement);
        as_defined();
    }
}

// The errors are 124, 121 and so on to 82, and the last one twice: together
// 1627.
void test_state_bytes_are_the_same_on_every_machine(void)
{
    static const uint8_t first[SIZE] = {0, 0, FIXPID_PID_FIRST};
    static const uint8_t later[SIZE] = {
        0x84, 0x00, 0x00,             // output 132, no flag
        0x79, 0x2D, 0x03, 0x00, 0xA5, // integral 32767 * 1627 / 2^24
        0xD6, 0xE7, 0xFF, 0xFF,       // derivative -6186 / 256
        0xF5, 0xFF,                   // feed-forward -11
        0xAA, 0x02,                   // the measurement 682
        0x52, 0x00,                   // P's error 82
    };

    config.gains.ki_q24 = 32767;
    config.gains.kd_q8 = 700;
    config.gains.derivative_filter = 2;
    TEST_ASSERT_TRUE(init());
    fixpid_pid_state(&pid_controller, state);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(first, state, SIZE);
    step(764, 640);
    set_feedforward(-11);
    for (int16_t n = 1; n < 15; n++) {
        step(764, (int16_t)(640 + 3 * n));
    }
    step(764, 682);
    as_defined();
    TEST_ASSERT_EQUAL_HEX8_ARRAY(later, state, SIZE);
}

// ---- Going on ----

static void any_step(int16_t *setpoint, int16_t *measurement)
{
    int32_t error;
    int32_t rise;

    numbers_pid_inputs(setpoint, measurement);
    if (numbers_below(3) != 0) {
        step(*setpoint, *measurement);
        return;
    }
    error = any_difference();
    rise = any_difference();
    TEST_ASSERT_EQUAL_INT16(
        reference_pid_step_error(&reference, error, rise),
        fixpid_pid_step_error(&pid_controller, error, rise));
    compare();
}

// In every mode, between all calls.
void test_restore_random_operations_go_on_as_defined(void)
{
    int16_t setpoint = 0;
    int16_t measurement = 0;

    for (uint32_t n = 0; n < TEST_RANDOM_STEPS / 2; n++) {
        if (numbers_below(8) == 0) {
            any_setting();
            if (reference.accepted) {
                pass_on();
            }
        }
        any_step(&setpoint, &measurement);
        if (reference.accepted) {
            pass_on();
        }
    }
}

// The integral may exceed the new limit by what a negative P takes away again,
// so P's error is a part of the state.
void test_restore_set_limits_keeps_what_the_last_error_takes_away(void)
{
    int32_t before;

    for (int n = 0; n < 100; n++) {
        step(700, 690);
    }
    step(700, 720);
    before = integral();
    TEST_ASSERT_GREATER_THAN_INT32(INT32_C(30) * 65536, before);
    pass_on();
    TEST_ASSERT_TRUE(set_limits(0, 30));
    TEST_ASSERT_EQUAL_INT32(before, integral());
}

void test_restore_by_hand_goes_on_by_hand(void)
{
    step(700, 640);
    set_manual(77);
    pass_on();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL, flags());
    TEST_ASSERT_EQUAL_INT16(77, step(700, 640));
    set_auto();
    pass_on();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_SEEDED, flags());
    TEST_ASSERT_EQUAL_INT16(77, step(700, 650));
    pass_on();
    TEST_ASSERT_EQUAL_HEX8(0, flags());
}

// No derivative, whatever the measurement is.
void test_restore_before_the_first_step_is_before_it(void)
{
    config.gains.kd_q8 = 256;
    TEST_ASSERT_TRUE(init());
    pass_on();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, flags());
    step(700, 640);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
    pass_on();
    step(700, 641);
    TEST_ASSERT_EQUAL_INT32(-256, fixpid_pid_derivative(&pid_controller));
    reset();
    fixpid_pid_state(&pid_controller, state);
    write(PREVIOUS, 0x1234, 2); // which is ignored
    accepts();
    step(700, 640);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_pid_derivative(&pid_controller));
}

void test_restore_track_goes_on_from_the_same_output(void)
{
    step(700, 640);
    pass_on();
    track(100, 2);
    pass_on();
    track(90, 2);
    step(700, 640);
}

// ---- Refusals ----

// The ends of what is possible, and what is just beyond them.
void test_restore_integral_beyond_its_limits_is_refused(void)
{
    TEST_ASSERT_TRUE(set_integral_limits(-100, 200));
    step(700, 700);
    fixpid_pid_state(&pid_controller, state);
    write(INTEGRAL, INT32_C(-100) * 65536, 4);
    accepts();
    write(INTEGRAL, INT32_C(-100) * 65536 + 1, 4);
    accepts();
    write(INTEGRAL, INT32_C(-100) * 65536 - 1, 4);
    refuses();
    write(INTEGRAL, INT32_C(200) * 65536, 4);
    accepts();
    write(FRACTION, 1, 1);
    refuses();
    write(INTEGRAL, INT32_C(200) * 65536 - 1, 4);
    accepts();
    write(FRACTION, 0, 1);
    write(INTEGRAL, INT32_C(200) * 65536 + 1, 4);
    refuses();
    write(INTEGRAL, INT32_C(201) * 65536, 4);
    refuses();
    write(INTEGRAL, INT32_MIN, 4);
    refuses();
    write(INTEGRAL, INT32_MAX, 4);
    refuses();
}

static void held_beyond_its_limits(uint8_t how)
{
    write(FLAGS, how, 1);
    write(INTEGRAL, INT32_C(0), 4);
    accepts();
    write(INTEGRAL, INT32_C(1), 4);
    refuses();
    write(INTEGRAL, INT32_C(100) * 65536 + 32768, 4);
    refuses();
    write(INTEGRAL, INT32_C(255) * 65536, 4);
    accepts();
    write(INTEGRAL, INT32_C(256) * 65536, 4);
    refuses();
    write(INTEGRAL, INT32_C(-65536), 4);
    refuses();
}

// What is held is whole counts, and the integral's limits do not count.
void test_restore_held_output_beyond_its_limits_is_refused(void)
{
    TEST_ASSERT_TRUE(set_integral_limits(10, 20));
    step(700, 700);
    fixpid_pid_state(&pid_controller, state);
    write(FRACTION, 0x99, 1); // it means nothing
    held_beyond_its_limits(FIXPID_PID_MANUAL);
    held_beyond_its_limits(FIXPID_PID_SEEDED);
}

void test_restore_derivative_beyond_its_limits_is_refused(void)
{
    static const int32_t most = (INT32_C(1) << 30) - (INT32_C(1) << 24);

    step(700, 700);
    fixpid_pid_state(&pid_controller, state);
    write(DERIVATIVE, most, 4);
    accepts();
    write(DERIVATIVE, most + 1, 4);
    refuses();
    write(DERIVATIVE, -most, 4);
    accepts();
    write(DERIVATIVE, -most - 1, 4);
    refuses();
    write(DERIVATIVE, INT32_MIN, 4);
    refuses();
}

void test_restore_unknown_flags_are_refused(void)
{
    step(700, 640);
    fixpid_pid_state(&pid_controller, state);
    write(INTEGRAL, 0, 4);
    write(FRACTION, 0, 1);
    for (uint8_t bit = 1; bit != 0u; bit = (uint8_t)(bit << 1)) {
        write(FLAGS, bit, 1);
        if ((bit & (0x08u | FIXPID_PID_REFUSED)) != 0u) {
            refuses();
        } else {
            accepts();
            TEST_ASSERT_EQUAL_HEX8(bit, flags());
        }
    }
}

void test_restore_refused_or_all_zero_controller_refuses(void)
{
    step(700, 640);
    fixpid_pid_state(&pid_controller, state);
    memset(&pid_controller, 0, sizeof pid_controller);
    refuses();
    write(INTEGRAL, 0, 4);
    write(FRACTION, 0, 1);
    refuses();
    config.output_max = config.output_min;
    TEST_ASSERT_FALSE(init());
    refuses();
}

// And its state is no other controller's.
void test_state_of_a_refused_controller_is_refused(void)
{
    config.output_max = config.output_min;
    TEST_ASSERT_FALSE(init());
    step(700, 640);
    fixpid_pid_state(&pid_controller, state);
    TEST_ASSERT_EQUAL_HEX8(flags(), state[FLAGS]);
    refuses();
    config = valve;
    TEST_ASSERT_TRUE(init());
    refuses();
}

// ---- Any bytes ----

// A controller goes on within its limits, or as if nothing had been.
void test_restore_of_any_bytes_stays_within_its_limits(void)
{
    unsigned taken = 0;

    config.gains.kd_q8 = 700;
    TEST_ASSERT_TRUE(init());
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        fixpid_pid_state(&pid_controller, state);
        if (numbers_below(4) == 0u) {
            numbers_fill(state, SIZE);
        }
        state[numbers_below(SIZE)] ^= (uint8_t)(1u << numbers_below(8));
        if (fixpid_pid_restore(&pid_controller, state)) {
            taken++;
        }
        for (unsigned i = 0; i < 3u; i++) {
            const int16_t setpoint = numbers_int16();
            const int16_t output =
                fixpid_pid_step(&pid_controller, setpoint, numbers_int16());

            TEST_ASSERT_GREATER_OR_EQUAL_INT16(0, output);
            TEST_ASSERT_LESS_OR_EQUAL_INT16(255, output);
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT(TEST_MEMORIES / 10u, taken);
    TEST_ASSERT_LESS_THAN_UINT(TEST_MEMORIES / 10u * 9u, taken);
}
