// SPDX-License-Identifier: MIT
// Random experiments of fixpid_autotune on plants in 32-bit arithmetic, which
// every chip has. What is recorded is for a unit test.
#include "calls_autotune.h"
#include "calls.h"
#include "numbers.h"

#define DELAY_MAX 16
#define FULL_SCALE 4095

FIXPID_DATA struct fixpid_autotune tuner;

static struct fixpid_autotune_config config;
static int16_t setpoint;

// Dead time, then two lags, or a lag and an integrator. Positions are in 1/4096
// of an output count, below 2^29.
static struct {
    int32_t first;
    int32_t second;
    int16_t line[DELAY_MAX];
    uint8_t delay;
    uint8_t oldest;
    uint8_t first_shift;
    uint8_t second_shift;
    uint8_t noise;
    bool integrating;
} plant;

static bool one_in(uint8_t count)
{
    return numbers_below(count) == 0u;
}

static void draw(void)
{
    config.output_min = 0;
    config.output_max = one_in(2) ? 255 : 1000;
    config.output_rest = one_in(2) ? 0 : config.output_max >> 1;
    config.measurement_min = -1;
    config.measurement_max = FULL_SCALE + 1;
    config.swing = one_in(3) ? 0 : (uint16_t)(8u + numbers_below(600));
    config.timeout_steps = one_in(8) ? 40 : 4000;
    config.cycles = (uint8_t)(1u + numbers_below(4));
    config.reverse = one_in(3);
    plant.delay = (uint8_t)(1u + numbers_below(DELAY_MAX));
    plant.oldest = 0;
    plant.first_shift = (uint8_t)numbers_below(4);
    plant.second_shift = (uint8_t)(2u + numbers_below(4));
    plant.noise = (uint8_t)(one_in(8) ? 200 : numbers_below(5));
    plant.integrating = one_in(3);
    plant.first = 0;
    plant.second = 0;
    for (uint8_t i = 0; i < DELAY_MAX; i++) {
        plant.line[i] = 0;
    }
    setpoint =
        (int16_t)((config.output_max >> 3) * 3 + (int16_t)numbers_below(100));
    if (one_in(16)) {
        config.cycles = 0;
    }
}

static int16_t measure(void)
{
    int32_t counts = plant.second >> 11;

    if (plant.noise != 0u) {
        counts += (int32_t)numbers_below(plant.noise * 2u + 1u) - plant.noise;
    }
    counts = (counts < 0) ? 0 : counts;
    counts = (counts > FULL_SCALE) ? FULL_SCALE : counts;
    return (int16_t)(config.reverse ? FULL_SCALE - counts : counts);
}

static void move(int16_t output)
{
    int32_t driven = plant.line[plant.oldest];

    plant.line[plant.oldest] = output;
    plant.oldest++;
    if (plant.oldest >= plant.delay) {
        plant.oldest = 0;
    }
    if (plant.integrating) {
        driven -= config.output_max >> 1;
    }
    plant.first += (driven * 4096 - plant.first) >> plant.first_shift;
    if (plant.integrating) {
        plant.second += plant.first >> (plant.second_shift + 2u);
        plant.second = (plant.second < 0) ? 0 : plant.second;
        plant.second = (plant.second > 0xFFFFFFL) ? 0xFFFFFFL : plant.second;
    } else {
        plant.second += (plant.first - plant.second) >> plant.second_shift;
    }
}

static void answer(uint32_t value)
{
    calls_answer(value, value);
}

// Which is at most that.
static void answer_within(uint32_t value, uint32_t most)
{
    (void)most; // of DEFINED
    calls_answer(value, DEFINED((value > most) ? most : value, value));
}

static void ask_progress(void)
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&tuner, &stage);
    answer(stage.phase);
    answer_within(stage.done, stage.expected);
    answer(stage.expected);
    answer(stage.period);
}

static void ask_model(void)
{
    struct fixpid_autotune_process model = {0, 0, 0, 0, 0, 0, 0};

    answer(fixpid_autotune_model(&tuner, &model));
    answer(model.gain_q8);
    answer(model.lag_q4);
    answer(model.dead_q4);
    answer(model.slope_q24);
    answer((uint32_t)(int32_t)model.holding);
    answer(model.noise_q4);
    answer(model.hysteresis);
}

static void ask_gains(uint8_t rule, uint8_t robustness_q4)
{
    const uint8_t reason = fixpid_autotune_reason(&tuner, rule, robustness_q4);
    struct fixpid_pid_config gains = {{0, 0, 0, 0}, 0,     0,    0, 0, 0,
                                      false,        false, false};
    const uint32_t given =
        fixpid_autotune_result(&tuner, rule, robustness_q4, &gains) ? 1u : 0u;

    calls_answer(given, DEFINED(reason == FIXPID_AUTOTUNE_NO_REASON, given));
    answer_within(gains.gains.kp_q8, FIXPID_PID_KP_MAX);
    answer_within(gains.gains.ki_q24, FIXPID_PID_KI_MAX);
    answer_within(gains.gains.kd_q8, FIXPID_PID_KD_MAX);
    answer_within(gains.gains.derivative_filter, FIXPID_PID_FILTER_MAX);
    answer(gains.setpoint_weight_q8);
    answer(gains.proportional_on_measurement ? 1u : 0u);
    answer(reason);
}

// The bytes of a record are the same on each machine, and it is not unpacked
// with another period. What only measures the experiment and its result leaves
// the record out.
#ifdef CALLS_RECORD
static void ask_record(void)
{
    static struct fixpid_autotune_record record;
    struct fixpid_autotune_stage before;
    struct fixpid_autotune_stage stage;
    const bool packed = fixpid_autotune_pack(&tuner, &record);

    answer(packed ? 1u : 0u);
    if (packed) {
        for (uint8_t i = 0; i < FIXPID_AUTOTUNE_RECORD_SIZE; i++) {
            answer(record.bytes[i]);
        }
        fixpid_autotune_progress(&tuner, &before);
        answer(fixpid_autotune_unpack(&tuner, &record) ? 1u : 0u);
        fixpid_autotune_progress(&tuner, &stage);
        calls_answer(stage.period, DEFINED(before.period, stage.period));
    }
}
#define ASK_RECORD() ask_record()
#else
#define ASK_RECORD() ((void)0)
#endif

static void ask_results(void)
{
    answer(fixpid_autotune_status(&tuner));
    ASK_RECORD();
    ask_model();
    for (uint8_t rule = 0; rule < 3u; rule++) {
        ask_gains(rule, FIXPID_AUTOTUNE_SAFE);
        ask_gains(rule, (uint8_t)(8u + numbers_below(57)));
    }
}

#ifdef CALLS_BY_KIND
static FIXPID_DATA struct fixpid_autotune before;

// SDCC's pic16 port cannot assign a structure.
static void copy(FIXPID_DATA struct fixpid_autotune *to,
                 FIXPID_DATA struct fixpid_autotune *from)
{
    FIXPID_DATA uint8_t *const target = (FIXPID_DATA uint8_t *)to;
    FIXPID_DATA uint8_t *const source = (FIXPID_DATA uint8_t *)from;

    for (uint8_t i = 0; i < sizeof(struct fixpid_autotune); i++) {
        target[i] = source[i];
    }
}
#endif

// One step, through the function that its kind is metered by: which of them it
// is, a first try on a copy has told.
static int16_t step(int16_t target, int16_t measurement)
{
#ifdef CALLS_BY_KIND
    const uint8_t seen = tuner.seen;
    bool ends;

    copy(&before, &tuner);
    (void)fixpid_autotune_step(&tuner, target, measurement);
    ends = tuner.seen != seen;
    copy(&tuner, &before);
    if (ends) {
        return autotune_cycle_step(&tuner, target, measurement);
    }
    return autotune_ordinary_step(&tuner, target, measurement);
#else
    return fixpid_autotune_step(&tuner, target, measurement);
#endif
}

void calls_rows(void)
{
    // there are none
}

void calls_random(uint32_t count)
{
    uint32_t steps = 0;

    while (steps < count) {
        uint32_t left; // steps until it must have ended

        draw();
        left = 34u + 97u * config.timeout_steps;
        answer(fixpid_autotune_init(&tuner, &config));
        do {
            const int16_t target =
                (int16_t)(config.reverse ? FULL_SCALE - setpoint : setpoint);
            const int16_t output = step(target, measure());

            answer_within((uint16_t)output, (uint16_t)config.output_max);
            answer_within(1u, left);
            ask_progress();
            move(output);
            steps++;
            left--;
        } while (fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING);
        ask_results();
    }
}
