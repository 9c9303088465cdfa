// SPDX-License-Identifier: MIT
// The logic of examples/autotune/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/fixpid_pid.c")
TEST_SOURCE_FILE("src/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/fixpid_relay.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/autotune")

int application_main(void);
#define main application_main
#include "autotune.c"
#undef main

#define SET 320u // 80 degrees, in counts of one conversion

static int16_t driven;
static uint16_t temperature_reading;
static int higher; // conversions of a period that read one count more
static int conversions;

static void keep_drive(int16_t duty, int calls)
{
    (void)calls;
    driven = duty;
}

static uint16_t reading(uint8_t channel, int calls)
{
    (void)calls;
    if (channel == PORT_SETPOINT) {
        conversions = 0;
        return SET;
    }
    conversions++;
    return (uint16_t)(temperature_reading + ((conversions <= higher) ? 1 : 0));
}

void setUp(void)
{
    static const struct fixpid_pid_gains none = {0, 0, 0, 0};

    driven = -1;
    higher = 0;
    tuned_gains = none;
    port_drive_Stub(keep_drive);
    port_read_Stub(reading);
    port_init_Ignore();
    port_running_IgnoreAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_RUNNING, fixpid_relay_status(&tuner));
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

// A wave of this height around the setpoint, `half` periods to each side.
static void swing(uint16_t counts, int half, int cycles)
{
    for (int i = 0; i < 2 * half * cycles; i++) {
        const bool above = ((i / half) % 2) != 0;
        (void)period((uint16_t)(above ? SET + counts : SET - counts));
    }
}

void test_main_experiment_starts_with_the_relay_high(void)
{
    TEST_ASSERT_EQUAL_INT16(306, period(80));
    TEST_ASSERT_EQUAL_INT16(306, period(SET));
}

void test_main_relay_switches_beyond_the_hysteresis_only(void)
{
    TEST_ASSERT_EQUAL_INT16(306, period(80));
    TEST_ASSERT_EQUAL_INT16(306, period(SET + 2)); // 8 counts of a sum of 4
    higher = 1;
    TEST_ASSERT_EQUAL_INT16(0, period(SET + 2)); // 9
    higher = 0;
    TEST_ASSERT_EQUAL_INT16(0, period(SET - 2)); // -8
    higher = 3;
    TEST_ASSERT_EQUAL_INT16(306, period(SET - 3)); // -9
}

void test_main_control_runs_once_in_100_ticks(void)
{
    port_running_ExpectAndReturn(true);
    port_wait_ticks_ExpectAndReturn(100, 255);
    temperature_reading = 80;
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_INT16(306, driven);
}

// A swing of 160 counts by a relay of 306 has Ku 4 / pi * 306 / 160, and the
// rule divides it by 2.2.
void test_main_experiment_over_gains_are_kept_and_control_starts(void)
{
    swing(20, 20, 8);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, fixpid_relay_status(&tuner));
    TEST_ASSERT_UINT16_WITHIN(2, (uint16_t)(256 * 1.2732 * 306 / 160 / 2.2),
                              tuned_gains.kp_q8);
    TEST_ASSERT_GREATER_THAN_UINT32(0, tuned_gains.ki_q24);
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned_gains.kd_q8);
}

void test_main_control_starts_from_the_middle_of_the_relay(void)
{
    int periods = 0;
    while ((fixpid_relay_status(&tuner) == FIXPID_RELAY_RUNNING) &&
           (periods < 1000)) {
        const bool above = ((periods / 20) % 2) != 0;
        (void)period((uint16_t)(above ? SET + 20 : SET - 20));
        periods++;
    }
    TEST_ASSERT_EQUAL_INT16(153, period(SET - 20));
    TEST_ASSERT_GREATER_THAN_INT16(153, period(SET - 20));
}

static int passes;

static bool for_some_passes(int calls)
{
    (void)calls;
    passes--;
    return passes >= 0;
}

static uint8_t as_many_ticks(uint8_t n, int calls)
{
    (void)calls;
    return n;
}

// Twenty passes on each side of the setpoint.
static uint16_t slow_wave(uint8_t channel, int calls)
{
    (void)calls;
    const bool above = ((passes / 20) % 2) != 0;
    const uint16_t now = (uint16_t)(above ? SET + 20 : SET - 20);
    return (channel == PORT_SETPOINT) ? SET : now;
}

void test_main_goes_from_the_experiment_to_control(void)
{
    port_running_Stub(for_some_passes);
    port_wait_ticks_Stub(as_many_ticks);
    port_read_Stub(slow_wave);
    passes = 329;
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned_gains.kp_q8);
    TEST_ASSERT_NOT_EQUAL_INT16(0, driven);
    TEST_ASSERT_NOT_EQUAL_INT16(RELAY_HIGH, driven);
}

void test_main_failed_experiment_leaves_the_heater_off(void)
{
    (void)period(80);
    TEST_ASSERT_EQUAL_INT16(0, period(1000)); // 4000 counts: the sensor's end
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_SATURATED,
                            fixpid_relay_status(&tuner));
    TEST_ASSERT_EQUAL_INT16(0, period(80));
    TEST_ASSERT_EQUAL_UINT16(0, tuned_gains.kp_q8);
}

void test_main_oven_that_stays_cold_is_given_up_after_a_minute(void)
{
    for (int i = 0; i < 600; i++) {
        TEST_ASSERT_EQUAL_INT16(306, period(80));
    }
    TEST_ASSERT_EQUAL_INT16(0, period(80));
    TEST_ASSERT_EQUAL_INT16(0, period(SET));
}
