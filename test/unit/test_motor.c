// SPDX-License-Identifier: MIT
// The logic of examples/motor/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an937/fixpid_an937.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937_more.c")
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
    static const struct fixpid_an937_config config = {
        KP_Q4, KI_START_Q4, KD_Q4, MOTOR_ACCUMULATED_ERROR_LIMIT,
        DERIVATIVE_PERIOD_TICKS};

    fixpid_an937_init(&motor, &config);
    deaf_ticks = 0;
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
    passes(DEAF_TICKS - 1u, 500, LOW_END);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(0, 500, LOW_END); // between two ticks
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(1, 500, LOW_END);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_tachometer_at_full_scale_drive_is_off_after_20_ticks(void)
{
    passes(DEAF_TICKS - 1u, 500, HIGH_END);
    TEST_ASSERT_EQUAL_INT16(-PORT_DRIVE_FULL, duty);
    pass(1, 500, HIGH_END);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_drive_that_is_off_stays_off_whatever_is_read(void)
{
    passes(DEAF_TICKS, 500, 0);
    passes(2, 500, 499);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    pass(0, 500, 1023);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

void test_control_tachometer_that_answers_once_is_believed(void)
{
    passes(DEAF_TICKS - 1u, 500, 0);
    pass(1, 500, LOW_END + 1);
    passes(DEAF_TICKS - 1u, 500, 0);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(1, 600, HIGH_END - 1);
    passes(DEAF_TICKS - 1u, 500, 1023);
    TEST_ASSERT_EQUAL_INT16(-PORT_DRIVE_FULL, duty);
}

void test_control_ticks_that_came_together_count_for_the_tachometer(void)
{
    pass(DEAF_TICKS - 1u, 500, 0);
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, duty);
    pass(255, 500, 0);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

// Of PORT_DRIVE_FULL / 2, with P alone: 24 for each count.
void test_control_an_end_is_believed_where_less_than_half_the_drive_pushes(void)
{
    (void)fixpid_an937_set_gains(&motor, KP_Q4, 0, 0);
    passes(2u * DEAF_TICKS, 21, 0);
    TEST_ASSERT_EQUAL_INT16(21 * 24, duty);
    passes(2u * DEAF_TICKS, 1002, 1023);
    TEST_ASSERT_EQUAL_INT16(-21 * 24, duty);
    passes(DEAF_TICKS, 22, 0);
    TEST_ASSERT_EQUAL_INT16(0, duty);
}

// The schedule's counter cannot be cleared: one test tells its whole story.
void test_control_integral_gain_goes_from_80_to_144_once_the_motor_runs(void)
{
    for (unsigned i = 0; i < 300u; i++) {
        pass(1, 0, 0); // standing still is not running
    }
    for (unsigned i = 0; i < RUNNING_TICKS - 1u; i++) {
        pass(1, 500, 480); // 80: just close enough
    }
    pass(1, 500, 479); // not close: the count starts again
    for (unsigned i = 0; i < RUNNING_TICKS - 1u; i++) {
        pass(1, 500, 520);
    }
    TEST_ASSERT_EQUAL_INT32(80 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
    pass(1, 500, 520);
    TEST_ASSERT_EQUAL_INT32(144 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
    TEST_ASSERT_EQUAL_INT32(-4000, fixpid_an937_accumulated_error(&motor));
    pass(1, 500, 0); // and stays
    TEST_ASSERT_EQUAL_INT32(144 * fixpid_an937_accumulated_error(&motor),
                            fixpid_an937_integral(&motor));
}
