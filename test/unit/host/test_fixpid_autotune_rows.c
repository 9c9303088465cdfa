// SPDX-License-Identifier: MIT
// The recorded experiments of test/support/vectors/autotune.csv;
// test/model/autotune/run plays them on any machine.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "autotune_plant.h"
#include "player.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")

#define ROWS 300
#define LINE_SIZE 1024

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

static void read_config(struct fixpid_autotune_config *config)
{
    config->output_min = (int16_t)number(10);
    config->output_max = (int16_t)number(10);
    config->output_rest = (int16_t)number(10);
    config->measurement_min = (int16_t)number(10);
    config->measurement_max = (int16_t)number(10);
    config->swing = (uint16_t)number(10);
    config->timeout_steps = (uint16_t)number(10);
    config->cycles = (uint8_t)number(10);
    config->options = (uint8_t)number(10);
}

static void read_plant(struct plant_config *plant)
{
    plant->integrating = number(10) != 0;
    plant->delay = (uint8_t)number(10);
    plant->lags = (uint8_t)number(10);
    plant->pole_q16 = (int32_t)number(10);
    plant->gain_q16 = (int32_t)number(10);
    plant->load = (int32_t)number(10);
    plant->step_at = (int32_t)number(10);
    plant->step_by = (int32_t)number(10);
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
    read_plant(&row->plant);
    row->plant.falling = (row->config.options & FIXPID_AUTOTUNE_REVERSE) != 0u;
    row->robustness_q4 = (uint8_t)number(10);
}

static void read_recorded(uint32_t values[PLAYER_VALUES])
{
    uint32_t *value = &values[PLAYER_MODEL];

    values[PLAYER_STATUS] = (uint32_t)number(10);
    values[PLAYER_STEPS] = (uint32_t)number(10);
    values[PLAYER_OUTPUTS] = (uint32_t)number(16);
    *value++ = *rest != ',';
    for (unsigned i = 0; i < PLAYER_MODEL_FIELDS; i++) {
        *value++ = (uint32_t)(number(10) & 0xFFFFFFFF);
    }
    for (unsigned rule = 0; rule < PLAYER_RULES_COUNT; rule++) {
        if (*rest == '-') {
            memset(value, 0, PLAYER_RULE_VALUES * sizeof *value);
            rest += 2;
        } else {
            value[0] = 1;
            for (unsigned i = 1; i <= 5; i++) {
                value[i] = (uint32_t)number(10);
            }
            value[6] = value[5] == 0;
        }
        value += PLAYER_RULE_VALUES;
    }
}

void test_autotune_recorded_experiments_come_out_bit_for_bit(void)
{
    char line[LINE_SIZE];
    char place[16];
    FILE *const file = fopen("test/support/vectors/autotune.csv", "r");
    unsigned rows = 0;

    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_NOT_NULL(fgets(line, LINE_SIZE, file)); // the names
    while (fgets(line, LINE_SIZE, file) != NULL) {
        struct player_row row;
        uint32_t recorded[PLAYER_VALUES];
        uint32_t found[PLAYER_VALUES];

        rest = line;
        read_row(&row);
        read_recorded(recorded);
        player_play(&row, found);
        rows++;
        snprintf(place, sizeof place, "row %u", rows);
        TEST_ASSERT_EQUAL_UINT32_ARRAY_MESSAGE(recorded, found, PLAYER_VALUES,
                                               place);
    }
    fclose(file);
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}
