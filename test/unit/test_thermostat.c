// SPDX-License-Identifier: MIT
// The logic of examples/thermostat/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/thermostat")

int application_main(void);
#define main application_main
#include "thermostat.c"
#undef main

#define COLD 80  // 20 degrees, in counts of one conversion
#define SET 320u // 80 degrees

// What a position of the selector reads, in the middle of its quarter.
static const uint16_t reading_of[] = {128, 384, 640, 896};

static int16_t driven;
static uint16_t selector_reading;
static uint16_t temperature_reading;

static void keep_drive(int16_t duty, int calls)
{
    (void)calls;
    driven = duty;
}

static uint16_t reading(uint8_t channel, int calls)
{
    (void)calls;
    switch (channel) {
    case PORT_SELECTOR:
        return selector_reading;
    case PORT_SETPOINT:
        return SET;
    default:
        return temperature_reading;
    }
}

void setUp(void)
{
    driven = -1;
    port_drive_Stub(keep_drive);
    port_read_Stub(reading);
    port_init_Ignore();
    port_running_IgnoreAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main()); // a good configuration
    position = SELECTOR_OFF;
}

void tearDown(void)
{
}

// One control period; returns the drive it led to.
static int16_t period(uint8_t selector, uint16_t counts)
{
    selector_reading = reading_of[selector];
    temperature_reading = counts;
    control();
    return driven;
}

// Turned to a position, and read twice there.
static int16_t turned_to(uint8_t selector, uint16_t counts)
{
    (void)period(selector, counts);
    return period(selector, counts);
}

static void run(uint8_t selector, uint16_t counts, int periods)
{
    for (int i = 0; i < periods; i++) {
        (void)period(selector, counts);
    }
}

void test_main_heater_is_off_at_power_on(void)
{
    TEST_ASSERT_EQUAL_INT16(0, turned_to(SELECTOR_OFF, COLD));
}

void test_main_control_runs_once_in_100_ticks(void)
{
    selector_reading = reading_of[SELECTOR_OFF];
    for (int i = 0; i < 3; i++) {
        port_running_ExpectAndReturn(true);
        port_wait_ticks_ExpectAndReturn(100, 100);
    }
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_INT16(0, driven);
}

void test_selector_counts_when_it_is_read_twice(void)
{
    (void)turned_to(SELECTOR_OFF, COLD);
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, COLD));
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_LOW_POWER, COLD));
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, COLD));
    TEST_ASSERT_GREATER_THAN_INT16(0, period(SELECTOR_AUTOMATIC, COLD));
}

// The first step begins at 0.6 times P, whose error is 960 quarter counts.
void test_off_to_automatic_starts_anew(void)
{
    (void)turned_to(SELECTOR_OFF, COLD);
    const int16_t first = turned_to(SELECTOR_AUTOMATIC, COLD);
    TEST_ASSERT_INT16_WITHIN(1, (int16_t)(1.3 * 154 / 256 * 960 + 0.035 * 960),
                             first);
}

void test_temperature_is_the_sum_of_four_conversions(void)
{
    port_read_Stub(NULL);
    for (uint16_t i = 0; i < 4; i++) {
        port_read_ExpectAndReturn(PORT_TEMPERATURE, (uint16_t)(1020 + i));
    }
    TEST_ASSERT_EQUAL_INT16(4086, temperature());
}

void test_manual_keeps_warm_whatever_the_temperature(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    TEST_ASSERT_EQUAL_INT16(102, turned_to(SELECTOR_MANUAL, SET));
    TEST_ASSERT_EQUAL_INT16(102, period(SELECTOR_MANUAL, COLD));
    TEST_ASSERT_EQUAL_INT16(102, period(SELECTOR_MANUAL, 1015));
}

void test_manual_to_automatic_goes_on_from_the_same_drive(void)
{
    (void)turned_to(SELECTOR_MANUAL, 240);
    run(SELECTOR_MANUAL, 240, 5);
    TEST_ASSERT_EQUAL_INT16(102, turned_to(SELECTOR_AUTOMATIC, 240));
    // Then ki of an error of 20 degrees, 320 counts: 0.035 * 320.
    TEST_ASSERT_INT16_WITHIN(1, 102 + 11, period(SELECTOR_AUTOMATIC, 240));
}

void test_low_power_limits_the_drive_at_once_and_gives_it_back(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, COLD);
    TEST_ASSERT_GREATER_THAN_INT16(127, period(SELECTOR_AUTOMATIC, COLD));
    TEST_ASSERT_EQUAL_INT16(127, turned_to(SELECTOR_LOW_POWER, COLD));
    run(SELECTOR_LOW_POWER, COLD, 100);
    TEST_ASSERT_EQUAL_INT16(127, period(SELECTOR_LOW_POWER, COLD));
    TEST_ASSERT_GREATER_THAN_INT16(127, turned_to(SELECTOR_AUTOMATIC, COLD));
}

void test_low_power_does_not_wind_up(void)
{
    (void)turned_to(SELECTOR_LOW_POWER, COLD);
    run(SELECTOR_LOW_POWER, COLD, 1000);
    // Above the setpoint at once by 1 degree, 16 counts, P falls by more than
    // the limit and D by more still.
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_LOW_POWER, SET + 4));
}

void test_drive_never_cools_and_is_limited_to_full(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, 1015));
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, period(SELECTOR_AUTOMATIC, 8));
}

void test_drive_never_cools_with_a_flipped_bit_in_the_limit(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    thermostat.output_min = INT16_MIN; // 0 with its highest bit flipped
    thermostat.integral_min = INT16_MIN + 1;
    run(SELECTOR_AUTOMATIC, 1015, 10);
    TEST_ASSERT_LESS_THAN_INT16(0, fixpid_pid_output(&thermostat));
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, 1015));
}

void test_flipped_bits_in_gains_and_limits_last_100_periods_at_most(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    const struct fixpid_pid good = thermostat;
    thermostat.kp ^= 0x4000u;
    thermostat.ki ^= 0x0100u;
    thermostat.kd ^= 0x0800u;
    thermostat.output_max = 255; // full drive with two bits flipped
    thermostat.setpoint_weight ^= 0x40u;
    thermostat.options ^= 0x04u;
    run(SELECTOR_AUTOMATIC, SET, 100);
    TEST_ASSERT_EQUAL_UINT16(good.kp, thermostat.kp);
    TEST_ASSERT_EQUAL_UINT16(good.ki, thermostat.ki);
    TEST_ASSERT_EQUAL_UINT16(good.kd, thermostat.kd);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, thermostat.output_max);
    TEST_ASSERT_EQUAL_UINT8(good.setpoint_weight, thermostat.setpoint_weight);
    TEST_ASSERT_EQUAL_UINT8(good.options, thermostat.options);
}

// Only a flipped bit makes such a derivative of a calm oven.
static int16_t renewed_with_derivative(int32_t derivative)
{
    (void)turned_to(SELECTOR_MANUAL, SET);
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    thermostat.output_max = 0; // until the controller is renewed
    for (int i = 0; (i < 100) && (thermostat.output_max == 0); i++) {
        thermostat.derivative = derivative;
        (void)period(SELECTOR_AUTOMATIC, SET);
    }
    return period(SELECTOR_AUTOMATIC, SET);
}

void test_renewed_controller_goes_on_from_a_drive_within_its_limits(void)
{
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL,
                            renewed_with_derivative(-0x3F000000));
    TEST_ASSERT_EQUAL_INT16(0, renewed_with_derivative(0x3F000000));
}

void test_renewed_controller_of_a_calm_oven_goes_on_from_the_same_drive(void)
{
    (void)turned_to(SELECTOR_MANUAL, SET);
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    const int16_t calm = period(SELECTOR_AUTOMATIC, SET);
    for (int i = 0; i < 250; i++) {
        TEST_ASSERT_EQUAL_INT16(calm, period(SELECTOR_AUTOMATIC, SET));
    }
}

void test_broken_wire_of_the_sensor_switches_off_at_once(void)
{
    static const uint16_t broken[] = {0, 7, 1016, 1023};

    (void)turned_to(SELECTOR_AUTOMATIC, COLD);
    for (int i = 0; i < 4; i++) {
        TEST_ASSERT_GREATER_THAN_INT16(0, period(SELECTOR_AUTOMATIC, COLD));
        TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, broken[i]));
    }
    (void)turned_to(SELECTOR_MANUAL, SET);
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_MANUAL, 1023));
}

void test_three_readings_of_a_broken_wire_do_not_move_the_controller(void)
{
    (void)turned_to(SELECTOR_MANUAL, SET);
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    const int16_t before = period(SELECTOR_AUTOMATIC, SET);
    TEST_ASSERT_EQUAL_INT16(102, before);
    run(SELECTOR_AUTOMATIC, 0, 3);
    TEST_ASSERT_EQUAL_INT16(before, period(SELECTOR_AUTOMATIC, SET));
}

void test_fourth_reading_of_a_broken_wire_is_an_alarm(void)
{
    static const uint16_t broken[] = {0, 7, 1016, 1023};

    for (int i = 0; i < 4; i++) {
        (void)turned_to(SELECTOR_OFF, COLD);
        (void)turned_to(SELECTOR_MANUAL, COLD);
        run(SELECTOR_MANUAL, broken[i], 3);
        TEST_ASSERT_EQUAL_INT16(102, period(SELECTOR_MANUAL, COLD));
        run(SELECTOR_MANUAL, broken[i], 4);
        TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_MANUAL, COLD));
    }
}

void test_alarm_keeps_the_heater_off_until_the_selector_was_at_off(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, COLD);
    run(SELECTOR_AUTOMATIC, 1023, 4);
    run(SELECTOR_AUTOMATIC, COLD, 250); // the controller is renewed meanwhile
    TEST_ASSERT_EQUAL_INT16(0, driven);
    TEST_ASSERT_EQUAL_INT16(0, turned_to(SELECTOR_MANUAL, COLD));
    TEST_ASSERT_EQUAL_INT16(0, turned_to(SELECTOR_LOW_POWER, COLD));
    TEST_ASSERT_EQUAL_INT16(0, turned_to(SELECTOR_OFF, COLD));
    TEST_ASSERT_EQUAL_INT16(102, turned_to(SELECTOR_MANUAL, COLD));
}

void test_heater_that_does_not_warm_is_an_alarm_after_30_periods(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, 8);
    run(SELECTOR_AUTOMATIC, 8, 1); // to full power
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, driven);
    run(SELECTOR_AUTOMATIC, 8, 27);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, period(SELECTOR_AUTOMATIC, 8));
    TEST_ASSERT_EQUAL_INT16(0, period(SELECTOR_AUTOMATIC, 8));
}

void test_low_power_that_does_not_warm_is_no_alarm(void)
{
    (void)turned_to(SELECTOR_LOW_POWER, COLD);
    run(SELECTOR_LOW_POWER, COLD, 1000);
    TEST_ASSERT_EQUAL_INT16(127, driven);
}

void test_swings_do_not_switch_off(void)
{
    (void)turned_to(SELECTOR_MANUAL, SET);
    (void)turned_to(SELECTOR_AUTOMATIC, SET);
    for (int i = 0; i < 20; i++) {
        (void)period(SELECTOR_AUTOMATIC, SET + 10);
        (void)period(SELECTOR_AUTOMATIC, SET - 10);
    }
    TEST_ASSERT_BITS_HIGH(FIXPID_GUARD_OSCILLATING, fixpid_guard_flags(&guard));
    TEST_ASSERT_GREATER_THAN_INT16(0, driven);
}

void test_broken_wire_of_the_selector_switches_off(void)
{
    (void)turned_to(SELECTOR_AUTOMATIC, COLD);
    selector_reading = 0;
    control();
    control();
    TEST_ASSERT_EQUAL_INT16(0, driven);
}
