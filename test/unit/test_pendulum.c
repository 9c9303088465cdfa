// SPDX-License-Identifier: MIT
// The logic of examples/pendulum/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an964/fixpid_an964.c")
TEST_SOURCE_FILE("src/an964/fixpid_an964_more.c")
TEST_INCLUDE_PATH("port/pic/pic16f684")
TEST_INCLUDE_PATH("examples/pendulum")

int application_main(void);
#define main application_main
#include "pendulum.c"
#undef main

static uint16_t kp, ki, kd;

void setUp(void)
{
    static const struct fixpid_an964_gains none = {0, 0, 0};

    (void)fixpid_an964_init(&pendulum, &none);
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

void test_main_pushes_toward_the_side_the_pendulum_falls_to(void)
{
    port_init_Expect();
    expect_tick(612, 99);
    expect_tick(412, -99);
    run();
}

void test_main_potentiometers_are_read_at_every_tick(void)
{
    port_init_Expect();
    kp = 512;
    expect_tick(612, 50);
    kp = 256;
    expect_tick(612, 25);
    kd = 32;
    expect_tick(613, 50); // P 101, D 101: the error of three ticks ago was 0
    kd = 0;
    ki = 1023;
    expect_tick(612, 40); // sum 401: I = 1 * 1023 / 16 = 63
    run();
}

void test_main_angle_of_twenty_degrees_still_drives(void)
{
    port_init_Expect();
    expect_tick(512 + 341, 340);
    expect_tick(512 - 341, -340);
    run();
}

void test_main_angle_beyond_twenty_degrees_stops_and_clears(void)
{
    port_init_Expect();
    ki = 1023;
    expect_tick(512 + 341, 403);
    expect_tick(512 + 342, 0);
    expect_tick(512, 0); // no integral is left, and no drift offset
    expect_tick(512 - 341, -403);
    expect_tick(512 - 342, 0);
    run();
    TEST_ASSERT_EQUAL_INT8(0, drift_offset);
    TEST_ASSERT_EQUAL_INT16(0, fixpid_an964_integral(&pendulum));
}

void test_balance_drift_offset_counts_to_55_and_adds_an_eighth_to_the_error(
    void)
{
    (void)fixpid_an964_set_gains(&pendulum, 1023, 0, 0);
    for (int16_t i = 0; i < 60; i++) {
        const int16_t offset = i < 55 ? i : 55;
        port_drive_Expect((int16_t)((100 + offset / 8) * INT32_C(1023) / 1024));
        balance(512 + 100);
    }
    TEST_ASSERT_EQUAL_INT8(55, drift_offset);
}

void test_balance_drift_offset_counts_down_to_minus_55(void)
{
    (void)fixpid_an964_set_gains(&pendulum, 1023, 0, 0);
    for (int16_t i = 0; i < 60; i++) {
        const int16_t offset = i < 55 ? i : 55;
        port_drive_Expect(
            (int16_t)(-(100 + offset / 8) * INT32_C(1023) / 1024));
        balance(512 - 100);
    }
    TEST_ASSERT_EQUAL_INT8(-55, drift_offset);
}

void test_main_output_of_zero_leaves_the_drift_offset(void)
{
    port_init_Expect();
    drift_offset = 7;
    expect_tick(512, 0);
    expect_tick(513, 0); // 1 * 1023 / 1024
    run();
    TEST_ASSERT_EQUAL_INT8(7, drift_offset);
}
