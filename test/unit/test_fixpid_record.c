// SPDX-License-Identifier: MIT
#include <string.h>

#include "crc16.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "unity.h"

TEST_SOURCE_FILE("src/record/fixpid_record.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 200000
#endif
#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every bit for the first of three
#endif

#define BITS (8u * FIXPID_RECORD_SIZE)
#define CHECK_AT (FIXPID_RECORD_SIZE - 2u)
#define OPTIONS_AT 20u
#define OPTIONS 0xE0u

static const struct fixpid_pid_config oven = {
    .gains = {.kp_q8 = 512,
              .ki_q24 = UINT32_C(838861),
              .kd_q8 = 640,
              .derivative_filter = 2},
    .output_min = -100,
    .output_max = 1000,
    .integral_min = -1000,
    .integral_max = 999,
    .setpoint_weight_q8 = 128,
    .reverse = true};

// Every number of it in another byte, and the check by hand.
static const uint8_t oven_bytes[FIXPID_RECORD_SIZE] = {
    0x01, 0x00, 0x02, 0xCD, 0xCC, 0x0C, 0x00, 0x80, 0x02, 0x02, 0x9C, 0xFF,
    0xE8, 0x03, 0x18, 0xFC, 0xE7, 0x03, 0x80, 0x00, 0x80, 0xC0, 0x12};

static struct fixpid_record record;
static struct fixpid_pid_config config;

void setUp(void)
{
    fixpid_record_pack(&record, &oven);
    memset(&config, 0xA5, sizeof config);
}

void tearDown(void)
{
}

static bool same_gains(const struct fixpid_pid_gains *a,
                       const struct fixpid_pid_gains *b)
{
    return a->kp_q8 == b->kp_q8 && a->ki_q24 == b->ki_q24 &&
           a->kd_q8 == b->kd_q8 && a->derivative_filter == b->derivative_filter;
}

static bool same(const struct fixpid_pid_config *a,
                 const struct fixpid_pid_config *b)
{
    return same_gains(&a->gains, &b->gains) && a->output_min == b->output_min &&
           a->output_max == b->output_max &&
           a->integral_min == b->integral_min &&
           a->integral_max == b->integral_max &&
           a->setpoint_weight_q8 == b->setpoint_weight_q8 &&
           a->reverse == b->reverse &&
           a->derivative_on_error == b->derivative_on_error &&
           a->proportional_on_measurement == b->proportional_on_measurement;
}

// And has written nothing.
static void is_refused(void)
{
    struct fixpid_pid_config before;

    memset(&before, 0xA5, sizeof before);
    TEST_ASSERT_FALSE(fixpid_record_unpack(&record, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &config, sizeof before);
}

// So that only the version or nothing is wrong.
static void make_check(void)
{
    const uint16_t check = crc16(record.bytes, CHECK_AT, 0xFFFF);

    record.bytes[CHECK_AT] = (uint8_t)(check & 0xFFu);
    record.bytes[CHECK_AT + 1u] = (uint8_t)(check >> 8);
}

void test_pack_worked_example_gives_these_bytes(void)
{
    TEST_ASSERT_EQUAL_UINT(23, sizeof record);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(oven_bytes, record.bytes, FIXPID_RECORD_SIZE);
    TEST_ASSERT_EQUAL_HEX16(0x12C0, crc16(oven_bytes, CHECK_AT, 0xFFFF));
}

void test_unpack_gives_what_was_packed(void)
{
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
    TEST_ASSERT_TRUE(same(&oven, &config));
}

void test_unpack_gives_illegal_configurations_as_packed(void)
{
    numbers_seed(44);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        struct fixpid_pid_config any;

        numbers_pid_config(&any);
        fixpid_record_pack(&record, &any);
        if (!fixpid_record_unpack(&record, &config) || !same(&any, &config)) {
            TEST_FAIL_MESSAGE("not as packed");
        }
    }
}

void test_pack_random_bytes_of_a_good_check_come_back(void)
{
    numbers_seed(45);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 10u; i++) {
        struct fixpid_record any;

        for (unsigned at = 1; at < CHECK_AT; at++) {
            record.bytes[at] = (uint8_t)numbers_next();
        }
        record.bytes[OPTIONS_AT] &= OPTIONS;
        make_check();
        TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
        fixpid_record_pack(&any, &config);
        TEST_ASSERT_EQUAL_MEMORY(&record, &any, sizeof any);
    }
}

void test_unpack_other_versions_are_refused(void)
{
    for (unsigned version = 0; version <= 255u; version++) {
        if (version != FIXPID_RECORD_VERSION) {
            record.bytes[0] = (uint8_t)version;
            make_check();
            is_refused();
        }
    }
}

void test_unpack_each_bit_of_the_options_is_a_field(void)
{
    record.bytes[OPTIONS_AT] = FIXPID_RECORD_REVERSE;
    make_check();
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
    TEST_ASSERT_TRUE(config.reverse);
    TEST_ASSERT_FALSE(config.derivative_on_error);
    TEST_ASSERT_FALSE(config.proportional_on_measurement);
    record.bytes[OPTIONS_AT] = FIXPID_RECORD_DERIVATIVE_ON_ERROR;
    make_check();
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
    TEST_ASSERT_FALSE(config.reverse);
    TEST_ASSERT_TRUE(config.derivative_on_error);
    TEST_ASSERT_FALSE(config.proportional_on_measurement);
    record.bytes[OPTIONS_AT] = FIXPID_RECORD_PROPORTIONAL_ON_MEASUREMENT;
    make_check();
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
    TEST_ASSERT_FALSE(config.reverse);
    TEST_ASSERT_FALSE(config.derivative_on_error);
    TEST_ASSERT_TRUE(config.proportional_on_measurement);
}

void test_unpack_other_options_are_refused(void)
{
    for (unsigned options = 0; options <= 255u; options++) {
        if ((options & ~OPTIONS) != 0u) {
            record.bytes[OPTIONS_AT] = (uint8_t)options;
            make_check();
            is_refused();
        }
    }
}

static void fill(uint8_t version, uint8_t value)
{
    memset(&record, value, sizeof record);
    record.bytes[0] = version;
    is_refused();
}

void test_unpack_erased_memory_is_refused(void)
{
    fill(0xFF, 0xFF);
    fill(FIXPID_RECORD_VERSION, 0xFF);
    fill(0x00, 0x00);
    fill(FIXPID_RECORD_VERSION, 0x00);
}

static void flip(unsigned bit)
{
    record.bytes[bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
}

static void is_noticed(void)
{
    if (fixpid_record_unpack(&record, &config)) {
        TEST_FAIL_MESSAGE("wrong bits are accepted");
    }
}

void test_unpack_every_1_2_and_3_wrong_bits_are_refused(void)
{
    for (unsigned alone = 0; alone < BITS; alone++) {
        flip(alone);
        is_noticed();
        flip(alone);
    }
    for (unsigned first = 0; first < BITS; first += TEST_STRIDE) {
        flip(first);
        for (unsigned second = first + 1u; second < BITS; second++) {
            flip(second);
            is_noticed();
            for (unsigned third = second + 1u; third < BITS; third++) {
                flip(third);
                is_noticed();
                flip(third);
            }
            flip(second);
        }
        flip(first);
    }
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
}

// ---- As an application does it ----

static uint8_t eeprom[2 * FIXPID_RECORD_SIZE];

static void save(const struct fixpid_pid_config *tuning)
{
    struct fixpid_record kept;

    fixpid_record_pack(&kept, tuning);
    for (unsigned at = 0; at < FIXPID_RECORD_SIZE; at++) {
        eeprom[at] = kept.bytes[at];
    }
}

// Starts with the EEPROM's tuning, or with the program's own if there is none.
static bool start(FIXPID_DATA struct fixpid_pid *pid)
{
    struct fixpid_record kept;
    struct fixpid_pid_config tuning;

    for (unsigned at = 0; at < FIXPID_RECORD_SIZE; at++) {
        kept.bytes[at] = eeprom[at];
    }
    if (fixpid_record_unpack(&kept, &tuning) && fixpid_pid_init(pid, &tuning)) {
        return true;
    }
    (void)fixpid_pid_init(pid, &oven);
    return false;
}

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_pid pid_controller;

void test_application_without_a_record_starts_with_its_own_tuning(void)
{
    memset(eeprom, 0xFF, sizeof eeprom);
    TEST_ASSERT_FALSE(start(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(-11, fixpid_pid_step(&pid_controller, 0, -10));
}

void test_application_with_a_record_starts_with_that(void)
{
    struct fixpid_pid_config better = oven;

    better.gains.kp_q8 = 1024;
    better.reverse = false;
    save(&better);
    TEST_ASSERT_TRUE(start(&pid_controller));
    TEST_ASSERT_EQUAL_INT16(21, fixpid_pid_step(&pid_controller, 0, -10));
}

void test_application_with_an_illegal_record_starts_with_its_own(void)
{
    struct fixpid_pid_config illegal = oven;

    illegal.output_max = illegal.output_min;
    save(&illegal);
    TEST_ASSERT_FALSE(start(&pid_controller));
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FIRST, fixpid_pid_flags(&pid_controller));
}
