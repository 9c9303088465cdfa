// SPDX-License-Identifier: MIT
// The logic of examples/kept/ with the port and the EEPROM mocked.
#include "mock_port.h"
#include "mock_port_eeprom.h"
#include "unity.h"

#include <string.h>

TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/record/fixpid_record.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/kept")

int application_main(void);
#define main application_main
#include "kept.c"
#undef main

#define GENTLE_CODE 600u
#define BRISK_CODE 800u
#define KEEP_CODE 300u

static uint8_t cells[256];
static unsigned writes;
static int16_t duty;
static uint16_t switch_counts, sensor_counts;
static int passes_left;

static uint8_t read_cell(uint8_t address, int calls)
{
    (void)calls;
    return cells[address];
}

static void write_cell(uint8_t address, uint8_t value, int calls)
{
    (void)calls;
    cells[address] = value;
    writes++;
}

static void drive(int16_t value, int calls)
{
    (void)calls;
    duty = value;
}

static uint16_t convert(uint8_t channel, int calls)
{
    (void)calls;
    if (channel == PORT_SETPOINT) {
        return 500;
    }
    return channel == PORT_SELECTOR ? switch_counts : sensor_counts;
}

static bool running(int calls)
{
    (void)calls;
    passes_left--;
    return passes_left >= 0;
}

void setUp(void)
{
    memset(cells, 0xFF, sizeof cells);
    writes = 0;
    duty = -1;
    switch_counts = 0;
    sensor_counts = 400;
    port_init_Ignore();
    port_wait_ticks_IgnoreAndReturn(CONTROL_PERIOD_TICKS);
    port_running_Stub(running);
    port_drive_Stub(drive);
    port_read_Stub(convert);
    port_eeprom_read_Stub(read_cell);
    port_eeprom_write_Stub(write_cell);
}

void tearDown(void)
{
}

static void power_on(int passes)
{
    written = FIXPID_RECORD_SIZE;
    passes_left = passes;
    TEST_ASSERT_EQUAL_INT(0, application_main());
}

static void store(const struct fixpid_pid_config *config)
{
    struct fixpid_record packed;

    fixpid_record_pack(&packed, config);
    memcpy(&cells[RECORD_AT], packed.bytes, FIXPID_RECORD_SIZE);
}

static void is_tuned(const struct fixpid_pid_config *config)
{
    TEST_ASSERT_EQUAL_UINT16(config->gains.kp_q8, oven.kp);
    TEST_ASSERT_EQUAL_INT16(config->output_max, oven.output_max);
}

void test_main_new_chip_starts_gently(void)
{
    power_on(1);
    is_tuned(GENTLE);
    TEST_ASSERT_EQUAL_INT16(243, duty); // 0.6 * 400, and 0.005 * 400 of I
    TEST_ASSERT_EQUAL_UINT(0, writes);
}

void test_main_good_record_is_taken(void)
{
    struct fixpid_pid_config other = tunings[1];

    other.gains.kp_q8 = 512;
    other.output_max = 700;
    store(&other);
    power_on(0);
    is_tuned(&other);
}

void test_main_record_with_any_wrong_bit_starts_gently(void)
{
    for (unsigned bit = 0; bit < 8u * FIXPID_RECORD_SIZE; bit++) {
        store(&tunings[1]);
        cells[RECORD_AT + bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
        power_on(0);
        is_tuned(GENTLE);
    }
}

void test_main_record_that_the_controller_refuses_starts_gently(void)
{
    struct fixpid_pid_config illegal = tunings[1];

    illegal.output_min = illegal.output_max;
    store(&illegal);
    power_on(0);
    is_tuned(GENTLE);
}

// The switch's memory cannot be cleared: one test tells its whole story.
void test_main_switch_chooses_a_tuning_and_keeps_it(void)
{
    switch_counts = BRISK_CODE;
    power_on(1); // read once: not yet
    is_tuned(GENTLE);
    power_on((int)FIXPID_RECORD_SIZE - 1);
    is_tuned(&tunings[1]);
    TEST_ASSERT_EQUAL_UINT(FIXPID_RECORD_SIZE - 1u, writes);
    power_on(0); // without its last byte
    is_tuned(GENTLE);

    switch_counts = KEEP_CODE;
    power_on(3);
    switch_counts = GENTLE_CODE;
    power_on(1);
    switch_counts = KEEP_CODE;
    power_on(1);
    switch_counts = BRISK_CODE;
    power_on((int)FIXPID_RECORD_SIZE + 9);
    TEST_ASSERT_EQUAL_UINT(2u * FIXPID_RECORD_SIZE - 1u, writes);
    switch_counts = KEEP_CODE;
    power_on(3);
    is_tuned(&tunings[1]);
}

void test_main_controller_goes_on_from_its_output_with_another_tuning(void)
{
    power_on(0);
    oven.output = 123;
    choose(&tunings[1]);
    TEST_ASSERT_EQUAL_INT16(123, fixpid_pid_step(&oven, 100, 100));
    written = FIXPID_RECORD_SIZE;
}

void test_main_heater_is_off_without_a_sensor_and_never_cools(void)
{
    sensor_counts = 1023;
    power_on(1);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    sensor_counts = 600;
    power_on(1);
    TEST_ASSERT_EQUAL_INT16(0, duty);
    power_on(0);
    oven.output_min = -1000; // as a flipped bit makes it
    power_on(0);
    (void)fixpid_pid_set_limits(&oven, -1000, 1000);
    control();
    TEST_ASSERT_EQUAL_INT16(0, duty);
}
