// SPDX-License-Identifier: MIT
// The logic of examples/motor/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an937/fixpid_an937.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937_more.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/motor")

int application_main(void);
#define main application_main
#include "motor.c"
#undef main

static int16_t duty;
static uint16_t setpoint_counts, speed_counts;

static void drive(int16_t value, int calls)
{
    (void)calls;
    duty = value;
}

static uint16_t convert(uint8_t channel, int calls)
{
    (void)calls;
    return channel == PORT_SETPOINT ? setpoint_counts : speed_counts;
}

void setUp(void)
{
    port_init_Ignore();
    port_running_IgnoreAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main()); // good configurations
    port_init_StopIgnore();
    port_running_StopIgnore();
    port_drive_Stub(drive);
    port_read_Stub(convert);
}

void tearDown(void)
{
}

static void pass(uint8_t ticks, uint16_t setpoint, uint16_t speed)
{
    setpoint_counts = setpoint;
    speed_counts = speed;
    control(ticks);
}

void test_main_runs_until_the_port_stops_it(void)
{
    setpoint_counts = 500;
    speed_counts = 499;
    port_init_Expect();
    for (int i = 0; i < 3; i++) {
        port_running_ExpectAndReturn(true);
        port_ticks_ExpectAndReturn(1);
    }
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    // P 24, I 5 * 12, D 4 of the first tick
    TEST_ASSERT_EQUAL_INT16(24 + 60 + 4, duty);
}

void test_control_proportional_acts_without_a_tick_integral_does_not(void)
{
    pass(0, 500, 499);
    TEST_ASSERT_EQUAL_INT16(24, duty);
    pass(0, 500, 498);
    TEST_ASSERT_EQUAL_INT16(48, duty);
    TEST_ASSERT_EQUAL_INT32(0, fixpid_an937_accumulated_error(&motor));
    pass(1, 500, 499);
    TEST_ASSERT_EQUAL_INT32(4, fixpid_an937_accumulated_error(&motor));
}

void test_control_drive_is_limited_on_both_sides(void)
{
    pass(1, 1023, 0);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(1, 0, 1023);
    TEST_ASSERT_EQUAL_INT16(-PORT_DRIVE_FULL, duty);
}

void test_control_ticks_that_came_together_are_reported_as_lost(void)
{
    pass(2, 500, 499);
    TEST_ASSERT_EQUAL_INT32(4, fixpid_an937_accumulated_error(&motor));
    TEST_ASSERT_BITS_HIGH(FIXPID_AN937_TICK_OVERRUN,
                          fixpid_an937_flags(&motor));
}

static void passes(unsigned count, uint16_t setpoint, uint16_t speed)
{
    for (unsigned i = 0; i < count; i++) {
        pass(1, setpoint, speed);
    }
}

void test_control_tachometer_without_pulses_drive_is_off_after_20_ticks(void)
{
    passes(GUARD_PATIENCE - 1u, 500, 0);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(0, 500, 0); // between two ticks
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(1, 500, 0);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_tachometer_at_full_scale_drive_is_off_after_20_ticks(void)
{
    passes(GUARD_PATIENCE - 1u, 500, 1023);
    TEST_ASSERT_EQUAL_INT16(-PORT_DRIVE_FULL, duty);
    pass(1, 500, 1023);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_tachometer_stuck_between_its_ends_drive_is_off(void)
{
    passes(GUARD_PATIENCE, 500, 300);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_drive_that_is_off_stays_off_whatever_is_read(void)
{
    passes(GUARD_PATIENCE, 500, 0);
    passes(2, 500, 499);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    pass(0, 500, 1023);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_alarm_is_acknowledged_by_turning_down_and_up_again(void)
{
    passes(GUARD_PATIENCE, 500, 0);
    pass(1, TURNED_DOWN + 1, 0);
    pass(1, 500, 499);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    passes(2u * GUARD_PATIENCE, TURNED_DOWN, 0);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    pass(1, 500, 499); // begins anew: P 24, I 5 * 4, D 4
    TEST_ASSERT_EQUAL_INT16(24 + 20 + 4, duty);
}

void test_control_motor_that_gains_a_band_in_20_ticks_is_believed(void)
{
    for (uint16_t speed = 0; speed < 400u; speed += GUARD_BAND) {
        passes(GUARD_PATIENCE - 1u, 500, speed);
        TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    }
}

// P alone makes 24 for each count: 42 of them are less than the full drive.
void test_control_an_end_is_believed_where_the_drive_does_not_push(void)
{
    (void)fixpid_an937_set_gains(&motor, KP_Q4, 0, 0);
    passes(3u * GUARD_PATIENCE, 42, 0);
    TEST_ASSERT_EQUAL_INT16(42 * 24, duty);
    passes(GUARD_PATIENCE, 43, 0);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

// A pass of a motor that the guard believes, though it does not follow.
static void believed_pass(uint16_t setpoint, uint16_t speed)
{
    fixpid_guard_reset(&guard);
    pass(1, setpoint, speed);
}

// The schedule's counter cannot be cleared: one test tells its whole story.
void test_control_integral_gain_goes_from_80_to_144_once_the_motor_runs(void)
{
    for (unsigned i = 0; i < 300u; i++) {
        believed_pass(0, 0); // standing still is not running
    }
    for (unsigned i = 0; i < RUNNING_TICKS - 1u; i++) {
        believed_pass(500, 480); // 80: just close enough
    }
    believed_pass(500, 479); // not close: the count starts again
    for (unsigned i = 0; i < RUNNING_TICKS - 1u; i++) {
        believed_pass(500, 520);
    }
    TEST_ASSERT_EQUAL_INT32(80 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
    believed_pass(500, 520);
    TEST_ASSERT_EQUAL_INT32(144 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
    TEST_ASSERT_EQUAL_INT32(-4000, fixpid_an937_accumulated_error(&motor));
    believed_pass(500, 0); // and stays
    TEST_ASSERT_EQUAL_INT32(144 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
}
