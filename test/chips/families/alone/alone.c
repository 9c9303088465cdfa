// SPDX-License-Identifier: MIT
// Five experiments on plants in 32-bit arithmetic, which end in different ways.
#include "program.h"

#define LINE 8 // most steps of dead time
#define FULL_SCALE 1023

// A lag of 2^lag steps behind another of 2^(lag - 2) and a dead time; or an
// integrator behind that other one.
struct plant {
    int16_t setpoint;
    int16_t measurement_max;
    uint16_t timeout_steps;
    uint8_t dead_steps;
    uint8_t lag;
    uint8_t noise_mask;
    bool integrating;
    bool reverse;
};

static const struct plant plants[PROGRAM_PARTS] = {
    {400, FULL_SCALE + 1, 400, 3, 4, 0, false, false},
    {500, FULL_SCALE + 1, 400, 4, 4, 1, true, false},
    {300, FULL_SCALE + 1, 400, 2, 5, 3, false, true},
    {1020, FULL_SCALE + 1, 60, 2, 5, 0, false, false}, // out of reach
    {400, 410, 400, 3, 4, 0, false, false},            // ends at 410
};

FIXPID_DATA struct fixpid_autotune tuner;
uint8_t program_bytes[PROGRAM_SIZE];

static int32_t lag_q12;   // output counts x 4096, below 2^21
static int32_t value_q12; // counts of the measurement x 4096, below 2^23
static int16_t line[LINE];
static uint8_t oldest;
static uint32_t random;
static uint32_t outputs;
static uint32_t told;

static uint32_t digested(uint32_t digest, uint16_t value)
{
    return (((digest & UINT32_C(0x7FFFFFF)) << 5) | (digest >> 27)) + value +
           1u;
}

static void start(const struct plant *plant)
{
    struct fixpid_autotune_config config;

    config.output_min = 0;
    config.output_max = 255;
    config.output_rest = plant->integrating ? 128 : 0;
    config.measurement_min = -1;
    config.measurement_max = plant->measurement_max;
    config.swing = 84;
    config.timeout_steps = plant->timeout_steps;
    config.cycles = 2;
    config.reverse = plant->reverse;
    lag_q12 = 0;
    value_q12 = 0;
    for (oldest = 0; oldest < LINE; oldest++) {
        line[oldest] = config.output_rest;
    }
    oldest = 0;
    random = 1;
    outputs = 0;
    told = 0;
    (void)fixpid_autotune_init(&tuner, &config);
}

static int16_t measured(const struct plant *plant)
{
    int16_t counts = (int16_t)(value_q12 >> 12);

    random = random * UINT32_C(1664525) + UINT32_C(1013904223);
    counts += (int16_t)((random >> 16) & plant->noise_mask);
    counts -= plant->noise_mask >> 1;
    return (counts < 0) ? 0 : counts;
}

static void move(const struct plant *plant, int16_t output)
{
    const int16_t driven = line[oldest];

    line[oldest] = output;
    oldest++;
    if (oldest == plant->dead_steps) {
        oldest = 0;
    }
    lag_q12 += ((int32_t)driven * 4096 - lag_q12) >> (plant->lag - 2u);
    if (plant->integrating) {
        value_q12 += (lag_q12 - INT32_C(128) * 4096) >> plant->lag;
        value_q12 = (value_q12 < 0) ? 0 : value_q12;
    } else {
        value_q12 += (lag_q12 * 4 - value_q12) >> plant->lag;
    }
}

static void tell_progress(void)
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&tuner, &stage);
    told = digested(told, (uint16_t)(stage.phase * 256u + stage.done));
    told = digested(told, stage.expected);
    told = digested(told, stage.period);
}

static void run(const struct plant *plant)
{
    do {
        const int16_t counts = measured(plant);
        int16_t output;

        if (plant->reverse) {
            output = fixpid_autotune_step(
                &tuner, (int16_t)(FULL_SCALE - plant->setpoint),
                (int16_t)(FULL_SCALE - counts));
        } else {
            output = fixpid_autotune_step(&tuner, plant->setpoint, counts);
        }
        outputs = digested(outputs, (uint16_t)output);
        move(plant, output);
        tell_progress();
    } while (fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING);
}

static void keep32(uint8_t at, uint32_t value)
{
    for (uint8_t i = 0; i < 4u; i++) {
        program_bytes[at + i] = (uint8_t)(value & 255u);
        value >>= 8;
    }
}

// The record's bytes are the last but one of what is kept.
static void keep(void)
{
    keep32(0, outputs);
    keep32(4, told);
    (void)fixpid_autotune_pack(
        &tuner, (struct fixpid_autotune_record *)(void *)&program_bytes[8]);
    program_bytes[PROGRAM_SIZE - 1u] = fixpid_autotune_status(&tuner);
}

void program_do(uint8_t number)
{
    start(&plants[number]);
    run(&plants[number]);
    keep();
}
