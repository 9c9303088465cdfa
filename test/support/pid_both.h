// SPDX-License-Identifier: MIT
// A controller and its definition side by side: each call goes to both, and
// whatever can be read of them is compared. For the tests of fixpid_pid.
#ifndef PID_BOTH_H
#define PID_BOTH_H
#include <stddef.h>
#include <string.h>

#include "fixpid_pid.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "reference_pid.h"
#include "unity.h"
#include "vectors_pid.h"

#if defined(TEST_WITHOUT_POINTERS) && !defined(FIXPID_PID_OBJECT)
#error "no object is named: these are the tests of the mode with pointers"
#endif

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif

extern FIXPID_DATA struct fixpid_pid pid_controller; // the test has it
static struct reference_pid reference;

// kp 2, ki 0.05 per step, a valve of 8 bits.
static const struct fixpid_pid_config valve = {
    .gains = {.kp_q8 = 512, .ki_q24 = 838861},
    .output_min = 0,
    .output_max = 255,
};

static struct fixpid_pid_config config; // of the running controller

// Everything that can be read is as the definition says.
static inline void compare(void)
{
    TEST_ASSERT_EQUAL_INT32(reference_pid_proportional(&reference),
                            fixpid_pid_proportional(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(reference_pid_integral(&reference),
                            fixpid_pid_integral(&pid_controller));
    TEST_ASSERT_EQUAL_INT32(reference.derivative,
                            fixpid_pid_derivative(&pid_controller));
    TEST_ASSERT_EQUAL_HEX8(reference_pid_flags(&reference),
                           fixpid_pid_flags(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(reference.output,
                            fixpid_pid_output(&pid_controller));
}

static inline bool init(void)
{
    const bool good = reference_pid_init(&reference, &config);

    TEST_ASSERT_EQUAL(good, fixpid_pid_init(&pid_controller, &config));
    TEST_ASSERT_EQUAL(good, fixpid_pid_check(&config) == FIXPID_PID_OK);
    compare();
    return good;
}

static inline void reset(void)
{
    reference_pid_reset(&reference);
    fixpid_pid_reset(&pid_controller);
    compare();
}

static inline bool set_gains(void)
{
    const bool good = reference_pid_set_gains(&reference, &config.gains);

    TEST_ASSERT_EQUAL(good,
                      fixpid_pid_set_gains(&pid_controller, &config.gains));
    compare();
    return good;
}

static inline bool set_limits(int16_t low, int16_t high)
{
    const bool good = reference_pid_set_limits(&reference, low, high);

    TEST_ASSERT_EQUAL(good, fixpid_pid_set_limits(&pid_controller, low, high));
    compare();
    return good;
}

static inline bool set_integral_limits(int16_t low, int16_t high)
{
    const bool good = reference_pid_set_integral_limits(&reference, low, high);

    TEST_ASSERT_EQUAL(
        good, fixpid_pid_set_integral_limits(&pid_controller, low, high));
    compare();
    return good;
}

static inline void set_feedforward(int16_t value)
{
    reference_pid_set_feedforward(&reference, value);
    fixpid_pid_set_feedforward(&pid_controller, value);
    compare();
}

static inline void set_manual(int16_t output)
{
    reference_pid_set_manual(&reference, output);
    fixpid_pid_set_manual(&pid_controller, output);
    compare();
}

static inline void set_auto(void)
{
    reference_pid_set_auto(&reference);
    fixpid_pid_set_auto(&pid_controller);
    compare();
}

static inline void seed(int16_t output)
{
    reference_pid_seed(&reference, output);
    fixpid_pid_seed(&pid_controller, output);
    compare();
}

static inline int16_t step(int16_t setpoint, int16_t measurement)
{
    const int64_t expected =
        reference_pid_step(&reference, setpoint, measurement);
    const int16_t output =
        fixpid_pid_step(&pid_controller, setpoint, measurement);

    TEST_ASSERT_EQUAL_INT16(expected, output);
    compare();
    return output;
}

static inline void track(int16_t applied, uint8_t shift)
{
    reference_pid_track(&reference, applied, shift);
    fixpid_pid_track(&pid_controller, applied, shift);
    compare();
}

static inline int32_t integral(void)
{
    return fixpid_pid_integral(&pid_controller);
}

static inline uint8_t flags(void)
{
    return fixpid_pid_flags(&pid_controller);
}

// Some of these may be refused, and the limits are arguments.
static inline bool before_the_step(const int32_t row[])
{
    const int16_t value = (int16_t)row[TRACK_VALUE];
    const int16_t value2 = (int16_t)row[TRACK_VALUE2];

    switch (row[TRACK_EVENT]) {
    case PID_NOTHING:
        return true;
    case PID_INIT:
        return init();
    case PID_RESET:
        reset();
        return true;
    case PID_SET_GAINS:
        return set_gains();
    case PID_SET_LIMITS:
        return set_limits(value, value2);
    case PID_SET_INTEGRAL_LIMITS:
        return set_integral_limits(value, value2);
    case PID_SET_FEEDFORWARD:
        set_feedforward(value);
        return true;
    case PID_SET_MANUAL:
        set_manual(value);
        return true;
    case PID_SET_AUTO:
        set_auto();
        return true;
    case PID_SEED:
        seed(value);
        return true;
    case PID_TRACK:
        track(value, (uint8_t)value2);
        return true;
    default:
        TEST_FAIL_MESSAGE("unknown event");
    }
    return false;
}

static inline void any_setting(void)
{
    int16_t low, high;

    switch (numbers_below(15)) {
    case 0:
        numbers_pid_config(&config);
        (void)init();
        break;
    case 1:
        reset();
        break;
    case 2:
    case 3:
        numbers_pid_gains(&config.gains);
        (void)set_gains();
        break;
    case 4:
    case 5:
        numbers_pid_range(&low, &high);
        (void)set_limits(low, high);
        break;
    case 6:
        numbers_pid_range(&low, &high);
        (void)set_integral_limits(low, high);
        break;
    case 7:
        set_feedforward(numbers_int16());
        break;
    case 8:
        set_feedforward(0);
        break;
    case 9:
        set_manual(numbers_int16());
        break;
    case 10:
    case 11:
        set_auto();
        break;
    case 12:
        seed(numbers_int16());
        break;
    case 13:
        track(numbers_int16(), (uint8_t)numbers_below(20));
        break;
    default:
        numbers_pid_config(&config);
        (void)init();
        break;
    }
}

// Any difference, half of them small.
static inline int32_t any_difference(void)
{
    const int16_t small = (int16_t)(numbers_int16() / 64);
    const uint32_t any = (uint32_t)(uint16_t)numbers_int16() << 16;

    return numbers_below(2) == 0u ? small
                                  : (int32_t)(any | (uint16_t)numbers_int16());
}

#endif
