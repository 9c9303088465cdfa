// SPDX-License-Identifier: MIT
// The logic of examples/pendulum_8bit/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit.c")
TEST_SOURCE_FILE("src/an964_8bit/fixpid_an964_8bit_more.c")
TEST_INCLUDE_PATH("port/pic/pic16f684")
TEST_INCLUDE_PATH("examples/pendulum_8bit")

int application_main(void);
#define main application_main
#include "pendulum_8bit.c"
#undef main

static uint16_t kp, ki, kd;

void setUp(void)
{
    static const struct fixpid_an964_8bit_gains none = {0, 0, 0};

    (void)fixpid_an964_8bit_init(&pendulum, &none);
    drift_offset = 0;
    kp = 1023;
    ki = 0;
    kd = 0;
}

void tearDown(void)
{
}

// A tick that reads this angle and must lead to this duty.
static void expect_tick(uint16_t angle, int16_t duty)
{
    port_running_ExpectAndReturn(true);
    port_wait_tick_ExpectAndReturn(1);
    port_read_ExpectAndReturn(PORT_KP, kp);
    port_read_ExpectAndReturn(PORT_KI, ki);
    port_read_ExpectAndReturn(PORT_KD, kd);
    port_read_ExpectAndReturn(PORT_ANGLE, angle);
    port_drive_Expect(duty);
}

static void run(void)
{
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
}

void test_main_potentiometers_at_zero_drive_nothing(void)
{
    port_init_Expect();
    kp = 0;
    expect_tick(600, 0);
    expect_tick(400, 0);
    run();
}

// Counts 612 and 412 are 153 - 128 = 25 and 103 - 128 = -25; kp 1023 is 127.
void test_main_pushes_toward_the_side_the_pendulum_falls_to(void)
{
    port_init_Expect();
    expect_tick(612, 25 * 127 / 32);
    expect_tick(412, -25 * 127 / 32);
    run();
}

void test_main_gains_are_an_eighth_of_the_potentiometers_at_every_tick(void)
{
    port_init_Expect();
    kp = 263; // 32
    expect_tick(612, 25);
    kp = 256;
    expect_tick(612, 25);
    kd = 39; // 4
    expect_tick(612, 50);
    kd = 0;
    ki = 71; // 8: the sum of four errors is 100, so I is 1
    expect_tick(612, 26);
    run();
}

void test_main_whole_conversion_is_a_signed_byte(void)
{
    port_init_Expect();
    kp = 256;
    expect_tick(512 - 341, (171 >> 2) - 128);
    expect_tick(511, -1);
    expect_tick(512, 0);
    expect_tick(515, 0);
    expect_tick(516, 1);
    expect_tick(512 + 341, (853 >> 2) - 128);
    run();
}

void test_main_angle_beyond_twenty_degrees_stops_and_clears(void)
{
    port_init_Expect();
    ki = 1023;
    expect_tick(512 + 341, (85 + 15) * 127 / 32); // I = 1 * 127 / 8
    expect_tick(512 + 342, 0);
    expect_tick(512, 0);
    expect_tick(512 - 342, 0);
    run();
    TEST_ASSERT_EQUAL_INT8(0, drift_offset);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_8bit_integral(&pendulum));
}

// The offset acts in 10-bit counts: 55 / 8 = 6 counts are one of the byte.
void test_balance_drift_offset_joins_before_the_low_bits_are_dropped(void)
{
    (void)fixpid_an964_8bit_set_gains(&pendulum, 32, 0, 0);
    for (int16_t i = 0; i < 60; i++) {
        const int16_t offset = i < 55 ? i : 55;
        port_drive_Expect((int16_t)(((613 + offset / 8) >> 2) - 128));
        balance(613);
    }
    for (int16_t i = 0; i < 120; i++) {
        const int16_t offset = i < 110 ? 55 - i : -55;
        port_drive_Expect((int16_t)(((413 + offset / 8) >> 2) - 128));
        balance(413);
    }
    TEST_ASSERT_EQUAL_INT8(-55, drift_offset);
}

void test_error_byte_saturates_at_both_ends_of_the_conversion(void)
{
    drift_offset = 55;
    TEST_ASSERT_EQUAL_INT8(127, error_byte(1023));
    TEST_ASSERT_EQUAL_INT8(-127, error_byte(0));
    drift_offset = -55;
    TEST_ASSERT_EQUAL_INT8(-128, error_byte(0));
    TEST_ASSERT_EQUAL_INT8(126, error_byte(1023));
}

void test_main_output_of_zero_leaves_the_drift_offset(void)
{
    port_init_Expect();
    drift_offset = 7;
    expect_tick(512, 0);
    run();
    TEST_ASSERT_EQUAL_INT8(7, drift_offset);
}
