// SPDX-License-Identifier: MIT
// The recorded experiments of test/support/vectors/autotune.csv, which
// test/model/autotune/run plays on any machine, and the records of experiments
// of autotune_records.csv. The last 13 of those are the project's own: sums
// that no plant was seen to make, each of which notices it if a constant of the
// result is by a 64th another, where no experiment does.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "autotune_plant.h"
#include "player.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")

#define ROWS 311
#define RECORDS 41
#define LINE_SIZE 1024

#define REVERSE 0x80 // of the options

// In object mode the library is built for the object of this name.
extern FIXPID_DATA struct fixpid_autotune autotune_controller;

// Where the reader stands in a line.
static char *rest;

void setUp(void)
{
}

void tearDown(void)
{
}

// The next field as a number; 0 if it is empty.
static int64_t number(int base)
{
    const int64_t value = strtoll(rest, &rest, base);

    TEST_ASSERT_TRUE(*rest == ',' || *rest == ' ' || *rest == '\n');
    rest++;
    return value;
}

// An option that there is not is refused; the library has no place for one, and
// refuses no cycles likewise.
static void read_config(struct fixpid_autotune_config *config)
{
    int64_t options;

    config->output_min = (int16_t)number(10);
    config->output_max = (int16_t)number(10);
    config->output_rest = (int16_t)number(10);
    config->measurement_min = (int16_t)number(10);
    config->measurement_max = (int16_t)number(10);
    config->swing = (uint16_t)number(10);
    config->timeout_steps = (uint16_t)number(10);
    config->cycles = (uint8_t)number(10);
    options = number(10);
    config->reverse = (options & REVERSE) != 0;
    if ((options & ~REVERSE) != 0) {
        config->cycles = 0;
    }
}

static void read_stages(struct plant_config *plant)
{
    plant->integrating = number(10) != 0;
    plant->growth_q16 = (int32_t)number(10);
    plant->delay = (uint8_t)number(10);
    plant->lags = (uint8_t)number(10);
    plant->pole_q16 = (int32_t)number(10);
    plant->ratio_q8 = (int32_t)number(10);
    plant->lead_q16 = (int32_t)number(10);
    plant->leads = (uint8_t)number(10);
    plant->spring_q16 = (int32_t)number(10);
    plant->damp_q16 = (int32_t)number(10);
    plant->fall_q16 = (int32_t)number(10);
    plant->backlash = (int32_t)number(10);
    plant->gain_q16 = (int32_t)number(10);
}

static void read_rest(struct plant_config *plant)
{
    plant->load = (int32_t)number(10);
    plant->step_at = (int32_t)number(10);
    plant->step_by = (int32_t)number(10);
    plant->drift_q16 = (int32_t)number(10);
    plant->drift_steps = (int32_t)number(10);
    plant->base = (int32_t)number(10);
    plant->start = (int32_t)number(10);
    plant->noise = (int32_t)number(10);
    plant->seed = (uint32_t)number(10);
    plant->full_scale = (int32_t)number(10);
}

static void read_row(struct player_row *row)
{
    read_config(&row->config);
    row->setpoint = (int16_t)number(10);
    read_stages(&row->plant);
    read_rest(&row->plant);
    row->plant.falling = row->config.reverse;
    row->robustness_q4 = (uint8_t)number(10);
}

// The gains, or a minus and the reason.
static void read_gains(uint32_t values[PLAYER_GAINS_VALUES])
{
    memset(values, 0, PLAYER_GAINS_VALUES * sizeof values[0]);
    if (*rest == '-') {
        rest++;
        values[0] = (uint32_t)number(10);
        values[5] = PLAYER_WEIGHT_BEFORE;
        values[6] = 1;
    } else {
        for (unsigned i = 1; i <= 4; i++) {
            values[i] = (uint32_t)number(10);
        }
        values[5] = PLAYER_WEIGHT;
    }
}

// From PLAYER_MODEL on.
static void read_answers(uint32_t values[PLAYER_VALUES])
{
    uint32_t *value = &values[PLAYER_MODEL];

    *value++ = *rest != ',';
    for (unsigned i = 0; i < PLAYER_MODEL_FIELDS; i++) {
        *value++ = (uint32_t)(number(10) & 0xFFFFFFFF);
    }
    for (unsigned i = 0; i < PLAYER_GAINS_COUNT; i++) {
        read_gains(value);
        value += PLAYER_GAINS_VALUES;
    }
}

static void read_recorded(uint32_t values[PLAYER_VALUES])
{
    values[PLAYER_STATUS] = (uint32_t)number(10);
    values[PLAYER_STEPS] = (uint32_t)number(10);
    values[PLAYER_OUTPUTS] = (uint32_t)number(16);
    values[PLAYER_TOLD] = (uint32_t)number(16);
    read_answers(values);
}

static void read_record(struct fixpid_autotune_record *record)
{
    for (unsigned i = 0; i < FIXPID_AUTOTUNE_RECORD_SIZE; i++) {
        const char digits[] = {rest[0], rest[1], '\0'};

        record->bytes[i] = (uint8_t)strtoul(digits, NULL, 16);
        rest += 2;
    }
    TEST_ASSERT_EQUAL_CHAR(',', *rest);
    rest++;
}

// What is left of the experiment: all answers, and the same record once more.
static void replay_record(const char *place)
{
    struct fixpid_autotune_record record;
    struct fixpid_autotune_record again;
    struct fixpid_autotune_stage stage;
    uint32_t recorded[PLAYER_VALUES];
    uint32_t found[PLAYER_VALUES];
    uint8_t robustness_q4;

    read_record(&record);
    robustness_q4 = (uint8_t)number(10);
    memset(&autotune_controller, 0xA5, sizeof autotune_controller);
    TEST_ASSERT_TRUE_MESSAGE(
        fixpid_autotune_unpack(&autotune_controller, &record), place);
    TEST_ASSERT_EQUAL_UINT8_MESSAGE(
        number(10), fixpid_autotune_status(&autotune_controller), place);
    fixpid_autotune_progress(&autotune_controller, &stage);
    TEST_ASSERT_EQUAL_UINT8_MESSAGE(number(10), stage.done, place);
    TEST_ASSERT_EQUAL_UINT8_MESSAGE(stage.expected, stage.done, place);
    TEST_ASSERT_EQUAL_UINT16_MESSAGE(number(10), stage.period, place);
    read_answers(recorded);
    player_ask(robustness_q4, found);
    TEST_ASSERT_EQUAL_UINT32_ARRAY_MESSAGE(&recorded[PLAYER_MODEL],
                                           &found[PLAYER_MODEL],
                                           PLAYER_VALUES - PLAYER_MODEL, place);
    TEST_ASSERT_TRUE(fixpid_autotune_pack(&autotune_controller, &again));
    TEST_ASSERT_EQUAL_HEX8_ARRAY_MESSAGE(record.bytes, again.bytes,
                                         FIXPID_AUTOTUNE_RECORD_SIZE, place);
}

static void replay_experiment(const char *place)
{
    struct player_row row;
    uint32_t recorded[PLAYER_VALUES];
    uint32_t found[PLAYER_VALUES];

    read_row(&row);
    read_recorded(recorded);
    player_play(&row, found);
    TEST_ASSERT_EQUAL_UINT32_ARRAY_MESSAGE(recorded, found, PLAYER_VALUES,
                                           place);
}

static void replay(const char *path, unsigned count,
                   void (*replay_row)(const char *place))
{
    char line[LINE_SIZE];
    char place[16];
    FILE *const file = fopen(path, "r");
    unsigned rows = 0;

    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_NOT_NULL(fgets(line, LINE_SIZE, file)); // the names
    while (fgets(line, LINE_SIZE, file) != NULL) {
        rest = line;
        rows++;
        snprintf(place, sizeof place, "row %u", rows);
        replay_row(place);
    }
    fclose(file);
    TEST_ASSERT_EQUAL_UINT(count, rows);
}

void test_autotune_recorded_experiments_come_out_bit_for_bit(void)
{
    replay("test/support/vectors/autotune.csv", ROWS, replay_experiment);
}

void test_autotune_recorded_records_answer_bit_for_bit(void)
{
    replay("test/support/vectors/autotune_records.csv", RECORDS, replay_record);
}
