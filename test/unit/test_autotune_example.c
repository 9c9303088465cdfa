// SPDX-License-Identifier: MIT
// The logic of examples/autotune/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")
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
    static const struct fixpid_pid_config none = {.output_min = 0};

    driven = -1;
    higher = 0;
    tuned = none;
    port_drive_Stub(keep_drive);
    port_read_Stub(reading);
    port_init_Ignore();
    port_running_IgnoreAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_RUNNING,
                            fixpid_autotune_status(&tuner));
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

// The experiment listens to the noise first.
static void listen(uint16_t counts)
{
    for (int i = 0; i < 33; i++) {
        TEST_ASSERT_EQUAL_INT16(0, period(counts));
    }
}

// A wave of 20 conversions to each side of the setpoint, until the experiment
// is over; 20 periods each.
static void swing(void)
{
    int periods = 0;

    listen(SET);
    while ((fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING) &&
           (periods < 2000)) {
        const bool above = ((periods / 20) % 2) != 0;
        (void)period((uint16_t)(above ? SET + 20 : SET - 20));
        periods++;
    }
}

void test_main_heater_is_off_while_the_noise_is_measured(void)
{
    listen(80);
    TEST_ASSERT_EQUAL_INT16(1023, period(80));
}

// Of a swing of 160 counts the hysteresis is 30, and a conversion counts 4.
void test_main_relay_switches_beyond_the_hysteresis_only(void)
{
    listen(80);
    TEST_ASSERT_EQUAL_INT16(1023, period(80));
    higher = 2;
    TEST_ASSERT_EQUAL_INT16(1023, period(SET + 7));
    higher = 3;
    TEST_ASSERT_EQUAL_INT16(0, period(SET + 7));
    higher = 2;
    TEST_ASSERT_EQUAL_INT16(0, period(SET - 8));
    higher = 1;
    TEST_ASSERT_EQUAL_INT16(1023, period(SET - 8));
}

void test_main_control_runs_once_in_100_ticks(void)
{
    port_running_ExpectAndReturn(true);
    port_wait_ticks_ExpectAndReturn(100, 255);
    temperature_reading = 80;
    port_running_ExpectAndReturn(false);
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_EQUAL_INT16(0, driven);
}

void test_main_experiment_over_gains_are_kept(void)
{
    swing();
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE,
                            fixpid_autotune_status(&tuner));
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_GREATER_THAN_UINT32(0, tuned.gains.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(0, tuned.gains.kd_q8);
    TEST_ASSERT_EQUAL_INT16(1023, tuned.output_max);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_NO_REASON, no_gains);
}

void test_main_control_starts_from_what_holds_the_temperature(void)
{
    struct fixpid_autotune_process process;

    swing();
    TEST_ASSERT_TRUE(fixpid_autotune_model(&tuner, &process));
    TEST_ASSERT_GREATER_THAN_INT16(0, process.holding);
    TEST_ASSERT_EQUAL_INT16(process.holding, period(SET - 20));
    for (int i = 0; i < 50; i++) {
        (void)period(SET - 20);
    }
    TEST_ASSERT_GREATER_THAN_INT16(process.holding, driven);
}

void test_main_broken_wire_of_the_sensor_switches_off_at_once(void)
{
    swing();
    const int16_t before = period(SET);
    TEST_ASSERT_GREATER_THAN_INT16(0, before);
    for (int i = 0; i < 1000; i++) {
        TEST_ASSERT_EQUAL_INT16(0, period(1023));
        TEST_ASSERT_EQUAL_INT16(0, period(0));
    }
    TEST_ASSERT_EQUAL_INT16(before, period(SET));
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
    passes = 1000;
    TEST_ASSERT_EQUAL_INT(0, application_main());
    TEST_ASSERT_GREATER_THAN_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_NOT_EQUAL_INT16(0, driven);
    TEST_ASSERT_NOT_EQUAL_INT16(1023, driven);
}

void test_main_failed_experiment_leaves_the_heater_off(void)
{
    listen(80);
    TEST_ASSERT_EQUAL_INT16(1023, period(80));
    TEST_ASSERT_EQUAL_INT16(0, period(1000)); // 4000 counts: the sensor's end
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_SATURATED,
                            fixpid_autotune_status(&tuner));
    TEST_ASSERT_EQUAL_INT16(0, period(80));
    TEST_ASSERT_EQUAL_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_NOT_DONE, no_gains);
}

// The temperature swings farther where the relay drives more: the experiment
// measures, but finds two processes and no gains.
void test_main_measured_without_gains_leaves_the_heater_off(void)
{
    int periods = 0;

    listen(SET);
    while ((fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING) &&
           (periods < 2000)) {
        const bool above = ((periods / 20) % 2) != 0;
        const uint16_t far = (driven > 700) ? 30 : 12;
        (void)period((uint16_t)(above ? SET + 12 : SET - far));
        periods++;
    }
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE,
                            fixpid_autotune_status(&tuner));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TWO_PROCESSES, no_gains);
    TEST_ASSERT_EQUAL_UINT16(0, tuned.gains.kp_q8);
    TEST_ASSERT_EQUAL_INT16(0, period(80));
}

void test_main_oven_that_stays_cold_is_given_up_after_a_minute(void)
{
    listen(80);
    for (int i = 0; i < 601; i++) {
        TEST_ASSERT_EQUAL_INT16(1023, period(80));
    }
    TEST_ASSERT_EQUAL_INT16(0, period(80));
    TEST_ASSERT_EQUAL_INT16(0, period(SET));
}
