// SPDX-License-Identifier: MIT
// The logic of examples/experiment/ with the port mocked.
#include "mock_port.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/experiment")

int application_main(void);
#define main application_main
#include "experiment.c"
#undef main

#define SET 320u // 80 degrees, in counts of one conversion

static int16_t driven;
static uint16_t temperature_reading;

static void keep_drive(int16_t duty, int calls)
{
    (void)calls;
    driven = duty;
}

static uint16_t reading(uint8_t channel, int calls)
{
    (void)calls;
    return (channel == PORT_SETPOINT) ? SET : temperature_reading;
}

void setUp(void)
{
    static const struct fixpid_autotune_record none = {{0}};

    driven = -1;
    measured = none;
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

static void period(uint16_t counts)
{
    temperature_reading = counts;
    control();
}

// A wave of 20 conversions to each side of the setpoint, until the experiment
// is over; 20 periods each.
static void swing(void)
{
    int periods = 0;

    for (int i = 0; i < 33; i++) {
        period(SET);
    }
    while ((fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING) &&
           (periods < 2000)) {
        const bool above = ((periods / 20) % 2) != 0;
        period((uint16_t)(above ? SET + 20 : SET - 20));
        periods++;
    }
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

void test_main_there_is_no_record_while_the_experiment_runs(void)
{
    for (int i = 0; i < 100; i++) {
        period(80);
        TEST_ASSERT_EACH_EQUAL_UINT8(0, measured.bytes,
                                     FIXPID_AUTOTUNE_RECORD_SIZE);
    }
}

void test_main_record_has_the_gains_of_the_experiment(void)
{
    struct fixpid_autotune before;
    struct fixpid_pid_config here = {.output_max = 1};
    struct fixpid_pid_config there = {.output_max = 1};

    swing();
    TEST_ASSERT_TRUE(fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                            FIXPID_AUTOTUNE_SAFE, &here));
    before = tuner;
    TEST_ASSERT_TRUE(fixpid_autotune_unpack(&tuner, &measured));
    TEST_ASSERT_TRUE(fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                            FIXPID_AUTOTUNE_SAFE, &there));
    tuner = before;
    TEST_ASSERT_EQUAL_UINT16(here.gains.kp_q8, there.gains.kp_q8);
    TEST_ASSERT_EQUAL_UINT32(here.gains.ki_q24, there.gains.ki_q24);
    TEST_ASSERT_GREATER_THAN_UINT16(0, there.gains.kp_q8);
}

void test_main_heater_is_off_when_the_experiment_is_over(void)
{
    swing();
    for (int i = 0; i < 100; i++) {
        period(80);
        TEST_ASSERT_EQUAL_INT16(0, driven);
    }
}

void test_main_record_stays_when_the_experiment_is_over(void)
{
    struct fixpid_autotune_record kept;

    swing();
    kept = measured;
    for (int i = 0; i < 100; i++) {
        period(80);
    }
    TEST_ASSERT_EQUAL_MEMORY(kept.bytes, measured.bytes,
                             FIXPID_AUTOTUNE_RECORD_SIZE);
}

void test_main_failed_experiment_has_a_record_that_says_so(void)
{
    period(80);
    period(1000); // 4000 counts: the sensor's end
    TEST_ASSERT_EQUAL_INT16(0, driven);
    TEST_ASSERT_TRUE(fixpid_autotune_unpack(&tuner, &measured));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_SATURATED,
                            fixpid_autotune_status(&tuner));
}
