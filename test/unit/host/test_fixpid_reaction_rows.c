// SPDX-License-Identifier: MIT
// The recorded experiments of test/support/vectors/reaction.csv, which
// test/chips/modules plays on any machine.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_reaction.h"
#include "unity.h"

TEST_SOURCE_FILE("src/reaction/fixpid_reaction.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_block.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_more.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_result.c")

#define ROWS 64
#define LINE_SIZE 4096
#define REVERSE 0x80 // of the options
#define UNWRITTEN 0xA5

// FNV-1a of 32 bits
#define TOLD_BASIS UINT32_C(2166136261)
#define TOLD_PRIME UINT32_C(16777619)

FIXPID_DATA struct fixpid_reaction reaction_controller;

static char *rest;   // of the line
static char row[16]; // its name, for a failure

void setUp(void)
{
}

void tearDown(void)
{
}

// The next field, as text.
static char *field(void)
{
    char *const text = rest;

    rest += strcspn(rest, ",\n");
    if (*rest != '\0') {
        *rest++ = '\0';
    }
    return text;
}

static int64_t number(void)
{
    return strtoll(field(), NULL, 10);
}

// A piece, as value*times or value alone.
struct piece {
    int64_t value;
    int64_t times; // 0: it is the letter R
};

static bool take_piece(char **from, struct piece *piece)
{
    *from += strspn(*from, " ");
    piece->times = 0;
    if (**from == 'R') {
        ++*from;
        return true;
    }
    if (**from == '\0') {
        return false;
    }
    piece->times = 1;
    piece->value = strtoll(*from, from, 10);
    if (**from == '*') {
        piece->times = strtoll(*from + 1, from, 10);
    }
    return true;
}

static uint32_t told_more(uint32_t told, uint8_t byte)
{
    return (uint32_t)((uint64_t)(told ^ byte) * TOLD_PRIME & UINT32_MAX);
}

// Each reading of the row, and each output as recorded. What was told.
static uint32_t play(char *outputs, char *readings)
{
    struct piece output = {0, 0};
    struct piece change;
    int64_t reading = 0;
    uint32_t told = TOLD_BASIS;

    while (take_piece(&readings, &change)) {
        if (change.times == 0) {
            fixpid_reaction_reset(&reaction_controller);
        }
        for (; change.times > 0; change.times--) {
            reading += change.value;
            if (output.times == 0) {
                TEST_ASSERT_TRUE_MESSAGE(take_piece(&outputs, &output), row);
            }
            output.times--;
            TEST_ASSERT_EQUAL_INT64_MESSAGE(
                output.value,
                fixpid_reaction_step(&reaction_controller, (int16_t)reading),
                row);
            told =
                told_more(told, fixpid_reaction_status(&reaction_controller));
            told =
                told_more(told, fixpid_reaction_progress(&reaction_controller));
        }
    }
    TEST_ASSERT_FALSE_MESSAGE(take_piece(&outputs, &output), row);
    return told;
}

static void has_model(char *slope, char *dead, char *noise)
{
    struct fixpid_reaction_process process;

    if (*slope == '\0') {
        TEST_ASSERT_FALSE_MESSAGE(
            fixpid_reaction_model(&reaction_controller, &process), row);
        return;
    }
    TEST_ASSERT_TRUE_MESSAGE(
        fixpid_reaction_model(&reaction_controller, &process), row);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(strtoll(slope, NULL, 10),
                                     process.slope_q24, row);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(strtoll(dead, NULL, 10), process.dead_q4,
                                     row);
    TEST_ASSERT_EQUAL_UINT16_MESSAGE(strtoll(noise, NULL, 10), process.noise_q4,
                                     row);
}

static void has_gains(const char *recorded, uint8_t rule, uint8_t robustness_q4)
{
    struct fixpid_pid_gains gains;
    char given[64] = "-";

    memset(&gains, UNWRITTEN, sizeof gains);
    if (fixpid_reaction_result(&reaction_controller, rule, robustness_q4,
                               &gains)) {
        (void)snprintf(given, sizeof given, "%u %lu %u %u", gains.kp_q8,
                       (unsigned long)gains.ki_q24, gains.kd_q8,
                       gains.derivative_filter);
    } else {
        TEST_ASSERT_EQUAL_HEX16_MESSAGE(UNWRITTEN << 8 | UNWRITTEN, gains.kp_q8,
                                        row);
    }
    TEST_ASSERT_EQUAL_STRING_MESSAGE(recorded, given, row);
}

static void replay_row(void)
{
    struct fixpid_reaction_config config;
    bool accepted;
    uint8_t status;
    uint32_t told;
    char *model[3];
    char *gains[8];
    uint8_t robustness_q4[4] = {FIXPID_REACTION_QUICK, FIXPID_REACTION_SAFE,
                                FIXPID_REACTION_CALM, 0};
    char *outputs;

    config.output_rest = (int16_t)number();
    config.output_drive = (int16_t)number();
    config.measurement_stop = (int16_t)number();
    config.timeout_steps = (uint16_t)number();
    config.reverse = (number() & REVERSE) != 0;
    accepted = number() != 0;
    status = (uint8_t)number();
    told = (uint32_t)number();
    for (unsigned i = 0; i < 3; i++) {
        model[i] = field();
    }
    for (unsigned i = 0; i < 8; i++) {
        gains[i] = field();
    }
    robustness_q4[3] = (uint8_t)number();
    outputs = field();
    TEST_ASSERT_EQUAL_MESSAGE(
        accepted, fixpid_reaction_init(&reaction_controller, &config), row);
    TEST_ASSERT_EQUAL_HEX32_MESSAGE(told, play(outputs, field()), row);
    TEST_ASSERT_EQUAL_UINT8_MESSAGE(
        status, fixpid_reaction_status(&reaction_controller), row);
    has_model(model[0], model[1], model[2]);
    for (unsigned i = 0; i < 8; i++) {
        has_gains(gains[i], (uint8_t)(i / 4u), robustness_q4[i % 4u]);
    }
}

void test_recorded_experiments_are_bit_for_bit_the_same(void)
{
    static char line[LINE_SIZE];
    FILE *const file = fopen("test/support/vectors/reaction.csv", "r");
    int rows = 0;

    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_NOT_NULL(fgets(line, sizeof line, file)); // the header
    while (fgets(line, sizeof line, file) != NULL) {
        rows++;
        rest = line;
        TEST_ASSERT_EQUAL_INT64(rows, number());
        (void)snprintf(row, sizeof row, "row %d", rows);
        replay_row();
    }
    (void)fclose(file);
    TEST_ASSERT_EQUAL_INT(ROWS, rows);
}
