// SPDX-License-Identifier: MIT
// Recorded experiments, on plants in integers, and records of experiments:
// autotune.csv and autotune_records.csv of test/support/vectors/, bit for bit.
// Their answers were made by another program, in 64-bit arithmetic.
// The last 17 records are sums that no plant was seen to make, each of which
// notices it if a constant of the result is by a 64th another, where no
// experiment does.
#include <stdio.h>
#include <string.h>

#include "autotune_plant.h"
#include "fixpid_autotune.h"
#include "unity.h"
#include "vectors.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")

#define ROWS 311
#define RECORDS 45
#define STEPS_AT 35     // columns
#define REVERSE 0x80    // of the options
#define WEIGHT_BEFORE 9 // which a result changes, or not

#ifndef TEST_STEPS_MAX
#define TEST_STEPS_MAX INT32_MAX // a longer experiment is left out
#endif

FIXPID_DATA struct fixpid_autotune autotune_controller;

static int32_t columns[VECTORS_COLUMNS_MAX];
static unsigned column, row;
static uint8_t robustness_q4;

void setUp(void)
{
    row = 0;
}

void tearDown(void)
{
}

static bool next_row(void)
{
    column = 0;
    row++;
    return vectors_next(columns);
}

static int32_t next(void)
{
    return columns[column++];
}

static void is_next(int32_t found)
{
    static char place[32];

    if (found != columns[column]) {
        (void)snprintf(place, sizeof place, "row %u, column %u", row,
                       column + 1u);
    }
    TEST_ASSERT_EQUAL_INT32_MESSAGE(columns[column], found, place);
    column++;
}

// What has no model has zeros.
static void model_is_next(void)
{
    struct fixpid_autotune_process model;

    memset(&model, 0, sizeof model);
    (void)fixpid_autotune_model(&autotune_controller, &model);
    is_next((int32_t)model.gain_q8);
    is_next((int32_t)model.lag_q4);
    is_next((int32_t)model.dead_q4);
    is_next((int32_t)model.slope_q24);
    is_next(model.holding);
    is_next(model.noise_q4);
    is_next(model.hysteresis);
}

// The gains, or minus the reason and zeros. Both functions say the same.
static void result_is_next(uint8_t rule, uint8_t robustness)
{
    const uint8_t reason =
        fixpid_autotune_reason(&autotune_controller, rule, robustness);
    struct fixpid_pid_config config;
    bool given;

    memset(&config, 0, sizeof config);
    config.setpoint_weight_q8 = WEIGHT_BEFORE;
    config.proportional_on_measurement = true;
    given =
        fixpid_autotune_result(&autotune_controller, rule, robustness, &config);
    TEST_ASSERT_EQUAL(reason == FIXPID_AUTOTUNE_NO_REASON, given);
    TEST_ASSERT_EQUAL_UINT16(given ? 256 : WEIGHT_BEFORE,
                             config.setpoint_weight_q8);
    TEST_ASSERT_EQUAL(!given, config.proportional_on_measurement);
    is_next(given ? config.gains.kp_q8 : -(int32_t)reason);
    is_next((int32_t)config.gains.ki_q24);
    is_next(config.gains.kd_q8);
    is_next(config.gains.derivative_filter);
}

// The model, and PI and PID at 8, 16, 32 and the row's own robustness.
static void answers_are_next(void)
{
    model_is_next();
    for (uint8_t rule = FIXPID_AUTOTUNE_PI; rule <= FIXPID_AUTOTUNE_PID;
         rule++) {
        result_is_next(rule, FIXPID_AUTOTUNE_QUICK);
        result_is_next(rule, FIXPID_AUTOTUNE_SAFE);
        result_is_next(rule, FIXPID_AUTOTUNE_CALM);
        result_is_next(rule, robustness_q4);
    }
}

// An option that there is not is refused; the library has no place for one, and
// refuses no cycles likewise.
static void read_config(struct fixpid_autotune_config *config)
{
    int32_t options;

    config->output_min = (int16_t)next();
    config->output_max = (int16_t)next();
    config->output_rest = (int16_t)next();
    config->measurement_min = (int16_t)next();
    config->measurement_max = (int16_t)next();
    config->swing = (uint16_t)next();
    config->timeout_steps = (uint16_t)next();
    config->cycles = (uint8_t)next();
    options = next();
    config->reverse = (options & REVERSE) != 0;
    if ((options & ~REVERSE) != 0) {
        config->cycles = 0;
    }
}

static void read_plant(struct plant_config *plant)
{
    plant->integrating = next() != 0;
    plant->growth_q16 = next();
    plant->delay = (uint8_t)next();
    plant->lags = (uint8_t)next();
    plant->pole_q16 = next();
    plant->ratio_q8 = next();
    plant->lead_q16 = next();
    plant->leads = (uint8_t)next();
    plant->spring_q16 = next();
    plant->damp_q16 = next();
    plant->fall_q16 = next();
    plant->backlash = next();
    plant->gain_q16 = next();
    plant->load = next();
    plant->step_at = next();
    plant->step_by = next();
    plant->drift_q16 = next();
    plant->drift_steps = next();
    plant->base = next();
    plant->start = next();
    plant->noise = next();
    plant->seed = (uint32_t)next();
    plant->full_scale = next();
}

// FNV-1a.
static uint32_t digest_of(uint32_t digest, uint8_t byte)
{
    return (digest ^ byte) * UINT32_C(16777619);
}

// Of phase, done and the low byte of the period.
static uint32_t digest_of_progress(uint32_t digest)
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&autotune_controller, &stage);
    digest = digest_of(digest, stage.phase);
    digest = digest_of(digest, stage.done);
    return digest_of(digest, (uint8_t)(stage.period & 0xFFu));
}

// Status, steps, and the digests of all outputs and of all that progress says.
static void experiment_is_next(struct plant *plant, int16_t setpoint)
{
    uint32_t outputs = UINT32_C(2166136261);
    uint32_t told = outputs;
    int32_t steps = 0;

    do {
        const int16_t output = fixpid_autotune_step(
            &autotune_controller, setpoint, plant_measure(plant));

        plant_move(plant, output);
        steps++;
        outputs = digest_of(outputs, (uint8_t)((uint16_t)output & 0xFFu));
        outputs = digest_of(outputs, (uint8_t)((uint16_t)output >> 8));
        told = digest_of_progress(told);
    } while (fixpid_autotune_status(&autotune_controller) ==
             FIXPID_AUTOTUNE_RUNNING);
    is_next(fixpid_autotune_status(&autotune_controller));
    is_next(steps);
    is_next((int32_t)outputs);
    is_next((int32_t)told);
}

static void replay_experiment(void)
{
    static struct plant plant;
    struct fixpid_autotune_config config;
    struct plant_config made;
    int16_t setpoint;

    read_config(&config);
    setpoint = (int16_t)next();
    read_plant(&made);
    made.falling = config.reverse;
    if (config.reverse) {
        setpoint = (int16_t)(made.full_scale - setpoint);
    }
    robustness_q4 = (uint8_t)next();
    plant_start(&plant, &made, config.output_rest);
    (void)fixpid_autotune_init(&autotune_controller, &config);
    experiment_is_next(&plant, setpoint);
    answers_are_next();
}

void test_autotune_recorded_experiments_come_out_bit_for_bit(void)
{
    VECTORS_OPEN(autotune);
    while (next_row()) {
        if (columns[STEPS_AT] <= TEST_STEPS_MAX) {
            replay_experiment();
        }
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, row - 1u);
}

// Two bytes are a word.
static void read_record(struct fixpid_autotune_record *record)
{
    for (unsigned i = 0; i < FIXPID_AUTOTUNE_RECORD_SIZE; i += 2u) {
        const uint16_t word = (uint16_t)next();

        record->bytes[i] = (uint8_t)(word & 0xFFu);
        record->bytes[i + 1u] = (uint8_t)(word >> 8);
    }
    robustness_q4 = (uint8_t)next();
}

// What is left of the experiment: all answers, and the same record once more.
void test_autotune_recorded_records_answer_bit_for_bit(void)
{
    VECTORS_OPEN(autotune_records);
    while (next_row()) {
        struct fixpid_autotune_record record;
        struct fixpid_autotune_record again;
        struct fixpid_autotune_stage stage;

        read_record(&record);
        memset(&autotune_controller, 0xA5, sizeof autotune_controller);
        TEST_ASSERT_TRUE(fixpid_autotune_unpack(&autotune_controller, &record));
        fixpid_autotune_progress(&autotune_controller, &stage);
        is_next(fixpid_autotune_status(&autotune_controller));
        is_next(stage.done);
        is_next(stage.period);
        TEST_ASSERT_EQUAL_UINT8(stage.expected, stage.done);
        answers_are_next();
        TEST_ASSERT_TRUE(fixpid_autotune_pack(&autotune_controller, &again));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(record.bytes, again.bytes,
                                     FIXPID_AUTOTUNE_RECORD_SIZE);
    }
    TEST_ASSERT_EQUAL_UINT(RECORDS, row - 1u);
}
