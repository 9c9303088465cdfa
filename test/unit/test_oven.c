// SPDX-License-Identifier: MIT
// The logic of examples/oven/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/an937/fixpid_an937.c")
TEST_SOURCE_FILE("src/an937/fixpid_an937_more.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard.c")
TEST_SOURCE_FILE("src/guard/fixpid_guard_more.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/oven")

int application_main(void);
#define main application_main
#define OVEN_KP_Q4 16
#define OVEN_KI_Q4 16
#define OVEN_KD_Q4 0
#include "oven.c"
#undef main

void setUp(void)
{
}

void tearDown(void)
{
}

// A pass that sees these ticks and temperatures and must lead to this duty.
static void expect_pass(uint8_t ticks, uint16_t setpoint, uint16_t temperature,
                        int16_t duty)
{
    port_running_ExpectAndReturn(true);
    port_wait_tick_ExpectAndReturn(ticks);
    port_read_ExpectAndReturn(PORT_SETPOINT, setpoint);
    for (int i = 0; i < 4; i++) {
        port_read_ExpectAndReturn(PORT_TEMPERATURE, temperature);
    }
    port_drive_Expect(duty);
}

// To the end of a slow tick.
static void reach_slow_tick(void)
{
    oven.tick_pending = 0;
    do {
        count_milliseconds(1);
    } while (oven.tick_pending == 0);
}

static void run(void)
{
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
}

void test_main_heater_gets_half_a_duty_count_per_count_of_error(void)
{
    port_init_Expect();
    expect_pass(1, 500, 400, 400 / 8);
    expect_pass(1, 500, 499, 0);
    run();
}

void test_main_heater_never_cools(void)
{
    port_init_Expect();
    expect_pass(1, 400, 500, 0);
    expect_pass(1, 0, 1015, 0);
    run();
}

void test_main_temperatures_are_averaged_over_four_conversions(void)
{
    port_init_Expect();
    port_running_ExpectAndReturn(true);
    port_wait_tick_ExpectAndReturn(1);
    port_read_ExpectAndReturn(PORT_SETPOINT, 500);
    for (uint16_t i = 0; i < 4; i++) {
        port_read_ExpectAndReturn(PORT_TEMPERATURE, (uint16_t)(400 + 8 * i));
    }
    port_drive_Expect((100 + 92 + 84 + 76) / 8);
    run();
}

void test_main_integral_moves_once_in_the_slow_tick(void)
{
    reach_slow_tick();
    port_init_Expect();
    expect_pass(200, 500, 498, 1);
    expect_pass(199, 500, 498, 1);
    expect_pass(1, 500, 498, 2);
    expect_pass(255, 500, 498, 2);
    expect_pass(144, 500, 498, 2);
    expect_pass(2, 500, 498, 3);
    run();
}

void test_main_drive_is_limited_to_full(void)
{
    port_init_Expect();
    expect_pass(255, 1023, 8, 4060 / 8);
    expect_pass(255, 1023, 8, 2 * 4060 / 8);
    expect_pass(255, 1023, 8, 2 * 4060 / 8);
    expect_pass(255, 1023, 8, PORT_DRIVE_FULL);
    run();
}

static void expect_passes(unsigned count, uint16_t setpoint,
                          uint16_t temperature, int16_t duty)
{
    for (unsigned i = 0; i < count; i++) {
        expect_pass(1, setpoint, temperature, duty);
    }
}

void test_main_three_readings_of_a_broken_wire_are_no_alarm(void)
{
    port_init_Expect();
    expect_passes(3, 500, 1016, 0);
    expect_passes(1, 500, 400, 400 / 8);
    expect_passes(3, 500, 7, 0);
    expect_passes(1, 500, 400, 400 / 8);
    run();
}

void test_main_heater_stays_off_from_the_fourth_reading_of_an_open_wire(void)
{
    port_init_Expect();
    expect_passes(4, 500, 1016, 0);
    expect_passes(5, 500, 400, 0);
    run();
}

void test_main_heater_stays_off_from_the_fourth_reading_of_a_shorted_wire(void)
{
    port_init_Expect();
    expect_passes(4, 500, 7, 0);
    expect_passes(5, 500, 400, 0);
    run();
}

void test_main_alarm_is_acknowledged_by_turning_down_and_up_again(void)
{
    port_init_Expect();
    expect_passes(4, 500, 1023, 0);
    expect_passes(2, 2, 400, 0);
    expect_passes(2, 500, 400, 400 / 8);
    expect_passes(4, 500, 1023, 0);
    expect_passes(1, 500, 400, 0); // turned down once is not for ever
    run();
}

void test_main_heater_that_does_not_warm_is_an_alarm_after_its_patience(void)
{
    port_init_Expect();
    run();
    for (unsigned i = 1; i < GUARD_PATIENCE_MS; i++) {
        TEST_ASSERT_EQUAL_HEX8(
            0, fixpid_guard_step(&guard, 1280, 700, PORT_DRIVE_FULL) & ALARMS);
    }
    TEST_ASSERT_EQUAL_HEX8(
        FIXPID_GUARD_NOT_RISING,
        fixpid_guard_step(&guard, 1280, 700, PORT_DRIVE_FULL) & ALARMS);
}

void test_main_swings_do_not_switch_off(void)
{
    port_init_Expect();
    for (unsigned i = 0; i < 7; i++) {
        expect_passes(1, 500, 510, 0);
        expect_passes(1, 500, 490, 40 / 8);
    }
    run();
    TEST_ASSERT_BITS_HIGH(FIXPID_GUARD_OSCILLATING, fixpid_guard_flags(&guard));
}

void test_main_controller_begins_anew_after_an_alarm(void)
{
    reach_slow_tick();
    port_init_Expect();
    expect_pass(255, 500, 498, 1);
    expect_pass(145, 500, 498, 2); // with 1 of the integral
    expect_passes(4, 500, 1023, 0);
    expect_passes(1, 0, 498, 0);
    expect_passes(1, 500, 498, 1);
    run();
}

void test_flipped_bits_in_the_settings_last_until_the_next_slow_tick(void)
{
    static const struct fixpid_an937_config config = {
        OVEN_KP_Q4, OVEN_KI_Q4, OVEN_KD_Q4, ACCUMULATED_ERROR_LIMIT, 1};

    (void)fixpid_an937_init(&oven, &config);
    oven.kp_q4 ^= 0x80u;
    oven.ki_q4 ^= 0x40u;
    oven.kd_q4 ^= 0x01u;
    oven.accumulated_error_limit ^= 0x4000u;
    oven.derivative_period_ticks ^= 0x08u;
    reach_slow_tick();
    TEST_ASSERT_EQUAL_UINT8(OVEN_KP_Q4, oven.kp_q4);
    TEST_ASSERT_EQUAL_UINT8(OVEN_KI_Q4, oven.ki_q4);
    TEST_ASSERT_EQUAL_UINT8(OVEN_KD_Q4, oven.kd_q4);
    TEST_ASSERT_EQUAL_UINT16(ACCUMULATED_ERROR_LIMIT,
                             oven.accumulated_error_limit);
    TEST_ASSERT_EQUAL_UINT8(1, oven.derivative_period_ticks);
}

// The plant in steps of a millisecond: full power of 1023 counts raises 6400
// counts in the end and 1.067 in a step, 1350 steps late.
void test_oven_guard_is_the_rules(void)
{
    static const struct fixpid_guard_model model = {.slope_q24 = 17499,
                                                    .dead_q4 = 1350 * 16,
                                                    .noise_q4 = 13,
                                                    .gain_q8 = 1602};
    struct fixpid_guard_config config = OVEN_GUARD(GUARD_PATIENCE_MS);

    TEST_ASSERT_TRUE(fixpid_guard_from_model(&config, &model));
    TEST_ASSERT_EQUAL_UINT16(config.band, GUARD_BAND);
    TEST_ASSERT_EQUAL_UINT16(2944, config.patience);
    TEST_ASSERT_UINT16_WITHIN(60, config.patience, GUARD_PATIENCE_MS);
    TEST_ASSERT_FALSE(config.noisy);
}
