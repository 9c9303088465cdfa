// SPDX-License-Identifier: MIT
// The logic of examples/autotune/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_block.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_more.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_result.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/autotune")

int application_main(void);
#define main application_main
#include "autotune.c"
#undef main

#define SET 320u // 80 degrees, in counts of one conversion
#define COLD 80u
#define DRIVE 255

static int16_t driven;
static uint16_t temperature_reading;
static uint16_t set_reading;

static void keep_drive(int16_t duty, int calls)
{
    (void)calls;
    driven = duty;
}

static uint16_t reading(uint8_t channel, int calls)
{
    (void)calls;
    return (channel == PORT_SETPOINT) ? set_reading : temperature_reading;
}

// From power-on, with so much set.
static void power_on(uint16_t set)
{
    static const struct fixpid_pid_config none = {.output_min = 0};

    driven = -1;
    set_reading = set;
    tuned = none;
    port_drive_Stub(keep_drive);
    port_read_Stub(reading);
    port_init_Ignore();
    port_running_IgnoreAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
}

void setUp(void)
{
    power_on(SET);
}

void tearDown(void)
{
}

static int16_t period(uint16_t counts)
{
    temperature_reading = counts;
    control();
    return driven;
}

static void expect_status(enum fixpid_reaction_state status)
{
    TEST_ASSERT_EQUAL_UINT8(status, fixpid_reaction_status(&tuner));
}

// It listens to the noise first.
static void listen(void)
{
    for (int i = 0; i < 31; i++) {
        TEST_ASSERT_EQUAL_INT16(0, period(COLD));
    }
    TEST_ASSERT_EQUAL_INT16(DRIVE, period(COLD));
}

// A delay of ten periods, and then a rise by two conversions in each until the
// heat-up is over; returns the temperature then.
static uint16_t heat_up(void)
{
    uint16_t counts = COLD;

    listen();
    for (int i = 0; i < 10; i++) {
        TEST_ASSERT_EQUAL_INT16(DRIVE, period(COLD));
    }
    while (is_tuning() && (counts < SET)) {
        counts = (uint16_t)(counts + 2u);
        (void)period(counts);
    }
    expect_status(FIXPID_REACTION_DONE);
    return counts;
}

void test_main_heater_is_off_while_the_noise_is_measured(void)
{
    listen();
}

void test_main_control_runs_once_in_100_ticks(void)
{
    port_running_ExpectAndReturn(true);
    port_wait_ticks_ExpectAndReturn(100, 255);
    temperature_reading = COLD;
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_INT16(0, driven);
}

void test_main_heat_up_over_gains_are_kept(void)
{
    (void)heat_up();
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_GREATER_THAN_UINT32(0, tuned.gains.ki_q24);
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kd_q8);
    TEST_ASSERT_EQUAL_INT16(0, tuned.output_min);
    TEST_ASSERT_EQUAL_INT16(1023, tuned.output_max);
    TEST_ASSERT_EQUAL_UINT16(128, tuned.setpoint_weight_q8);
}

// A delay of ten periods less half of one, half a jump of the sensor and one
// and a half of the hold are 11.5 periods of eight counts. A quarter of full
// power over 2.52 times that, and 5/4 of it as the rule is PID, is 1.37.
void test_main_gains_are_those_of_the_rise(void)
{
    (void)heat_up();
    TEST_ASSERT_UINT16_WITHIN(3, 352, tuned.gains.kp_q8);
}

// The controller takes its first step in the period in which the heat-up ends,
// with half of the setpoint for P.
void test_main_controller_goes_on_in_the_same_period(void)
{
    const uint16_t counts = heat_up();
    const int16_t first = driven;

    TEST_ASSERT_TRUE(fixpid_pid_init(&oven, &tuned));
    TEST_ASSERT_EQUAL_INT16(
        fixpid_pid_step(&oven, 4 * SET, (int16_t)(4 * counts)), first);
    TEST_ASSERT_NOT_EQUAL_INT16(DRIVE, first);
}

void test_main_broken_wire_of_the_sensor_switches_off_at_once(void)
{
    (void)heat_up();
    TEST_ASSERT_GREATER_THAN_INT16(0, period(COLD));
    for (int i = 0; i < 1000; i++) {
        TEST_ASSERT_EQUAL_INT16(0, period(1023));
        TEST_ASSERT_EQUAL_INT16(0, period(0));
    }
    TEST_ASSERT_GREATER_THAN_INT16(0, period(COLD));
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kp_q8);
}

void test_main_wire_broken_in_the_heat_up_begins_it_anew(void)
{
    listen();
    TEST_ASSERT_EQUAL_INT16(DRIVE, period(COLD + 8u));
    TEST_ASSERT_EQUAL_INT16(0, period(1023));
    TEST_ASSERT_EQUAL_INT16(0, period(0));
    (void)heat_up();
}

static int passes;

static bool for_some_passes(int calls)
{
    (void)calls;
    passes++;
    return passes <= 300;
}

static uint8_t as_many_ticks(uint8_t n, int calls)
{
    (void)calls;
    return n;
}

// It warms while the heater is on, and does not cool.
static uint16_t warming(uint8_t channel, int calls)
{
    static uint16_t counts;

    (void)calls;
    if (channel == PORT_SETPOINT) {
        return SET;
    }
    if (passes <= 1) {
        counts = 8 * COLD;
    }
    counts = (uint16_t)(counts + ((driven > 0) ? driven / 64 : 0));
    return (uint16_t)(counts / 8u);
}

void test_main_goes_from_the_heat_up_to_control(void)
{
    passes = 0;
    port_running_Stub(for_some_passes);
    port_wait_ticks_Stub(as_many_ticks);
    port_read_Stub(warming);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    expect_status(FIXPID_REACTION_DONE);
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_NOT_EQUAL_INT16(DRIVE, driven);
}

// What was set at power-on is what the heat-up must not pass.
void test_main_oven_already_warm_stays_off(void)
{
    power_on(COLD);
    for (int i = 0; i < 100; i++) {
        TEST_ASSERT_EQUAL_INT16(0, period(COLD));
    }
    expect_status(FIXPID_REACTION_LIMIT);
    TEST_ASSERT_EQUAL_UINT16(0, tuned.gains.kp_q8);
}

void test_main_setpoint_too_near_leaves_the_heater_off(void)
{
    listen();
    TEST_ASSERT_EQUAL_INT16(0, period(SET));
    expect_status(FIXPID_REACTION_LIMIT);
    TEST_ASSERT_EQUAL_INT16(0, period(COLD));
    TEST_ASSERT_EQUAL_UINT16(0, tuned.gains.kp_q8);
}

void test_main_oven_that_stays_cold_is_given_up(void)
{
    int periods = 0;

    listen();
    while (is_tuning() && (periods < 2000)) {
        (void)period(COLD);
        periods++;
    }
    expect_status(FIXPID_REACTION_NO_MOVEMENT);
    TEST_ASSERT_EQUAL_INT16(0, period(COLD));
    TEST_ASSERT_EQUAL_INT16(0, period(SET));
}
