// SPDX-License-Identifier: MIT
// Random experiments, printed for model.rb: a line for each call, with what it
// was given and what it answered.
//
//   i CONFIGURATION... ACCEPTED
//   n STATUS                                        a reset
//   s SETPOINT MEASUREMENT OUTPUT STATUS PROGRESS...
//   m ACCEPTED MODEL...                             0 for what was not given
//   r RULE ROBUSTNESS ACCEPTED KP KI KD FILTER WEIGHT OPTIONS REASON
//   u PACKED SPOILT GOOD STATUS PROGRESS...   whether a record of the
//   experiment
//        was made, one with a turned bit accepted, and the good one in an
//        object of any bytes, which goes on from there
#include <string.h>

#include "autotune_plant.h"
#include "fixpid_autotune.h"
#include "numbers.h"
#include "trace_lines.h"

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_autotune autotune_controller;

// What the experiment is done on.
enum kind {
    LAG,
    SWING, // a made-up swing: any period and height, and sometimes another
    INTEGRATOR,
    SPIKES,  // next to nothing, but for a spike at the end of each half
    EXTREME, // a lag with any counts, small or large
    NOISE,   // any measurement, and any configuration
    HEATER,  // a lag that falls more slowly than it rises
    RUNAWAY, // an integrator that grows by itself
    COARSE,  // a lag of few counts, which all outputs there are move
    KINDS
};

#define SLOW_EVERY 20 // one of so many swings is too slow

struct world {
    enum kind kind;
    struct plant plant;
    uint16_t half_steps[2]; // of a swing: below and above
    uint16_t height, unlike;
    uint16_t left;
    bool above;
};

static struct world world;

static uint8_t status(void)
{
    return fixpid_autotune_status(&autotune_controller);
}

static int32_t between(int32_t least, int32_t most)
{
    return least + (int32_t)numbers_below((uint32_t)(most - least + 1));
}

static bool one_of(uint32_t count)
{
    return numbers_below(count) == 0;
}

// 1..2^bits - 1, small numbers as often as large ones.
static int32_t any_size(uint32_t bits)
{
    const uint32_t size = numbers_below(bits);

    return (int32_t)((UINT32_C(1) << size) +
                     numbers_below(UINT32_C(1) << size));
}

static struct fixpid_autotune_config any_config(void)
{
    struct fixpid_autotune_config config;

    config.output_min = numbers_int16();
    config.output_max = numbers_int16();
    config.output_rest = one_of(2) ? config.output_min : numbers_int16();
    config.measurement_min = one_of(2) ? INT16_MIN : numbers_int16();
    config.measurement_max = one_of(2) ? INT16_MAX : numbers_int16();
    config.swing = (uint16_t)(one_of(2) ? 0 : between(0, 17000));
    config.timeout_steps = (uint16_t)between(0, 33000);
    config.cycles = (uint8_t)between(0, 5);
    config.reverse = one_of(2);
    return config;
}

static struct fixpid_autotune_config legal_config(void)
{
    const int32_t span = any_size(16);
    const int32_t low = between(INT16_MIN, INT16_MAX - span);
    struct fixpid_autotune_config config;

    config.output_min = (int16_t)low;
    config.output_max = (int16_t)(low + span);
    config.output_rest = (int16_t)between(low, low + span);
    config.measurement_min = -32000;
    config.measurement_max = 32000;
    config.swing = (uint16_t)(one_of(3) ? 0 : between(8, 600));
    config.timeout_steps = (uint16_t)between(200, 2000);
    config.cycles = (uint8_t)between(1, 4);
    config.reverse = one_of(2);
    return config;
}

// The lags and the delay of a plant, and the gain with which it covers a part
// of its scale.
static void shape(struct plant_config *plant, int32_t span)
{
    int32_t slowness = 1;

    plant->delay = (uint8_t)between(plant->integrating ? 3 : 0, 12);
    plant->lags = (uint8_t)between(plant->integrating ? 0 : 1, 3);
    plant->pole_q16 = between(3000, 30000);
    plant->ratio_q8 = one_of(2) ? 256 : between(128, 1024);
    if (plant->lags > 1u && one_of(6)) { // it begins in the wrong direction
        plant->leads = 1;
        plant->lead_q16 = -between(6000, 40000);
    }
    if (plant->integrating) {
        slowness = plant->delay + 1 + plant->lags * 65536 / plant->pole_q16;
    }
    plant->gain_q16 =
        (int32_t)((int64_t)plant->full_scale * 65536 * between(20, 90) /
                  (100 * (int64_t)span * slowness)) +
        1;
}

// A plant that the output range moves through most of its scale; the setpoint
// that an output somewhere in the range holds.
static int16_t start_plant(const struct fixpid_autotune_config *config,
                           enum kind kind)
{
    const bool integrating = kind == INTEGRATOR || kind == RUNAWAY;
    static const int32_t scales[] = {1023, 4095, 30000, 255};
    const int32_t span = (int32_t)config->output_max - config->output_min;
    const int32_t holding = config->output_min + span * between(3, 97) / 100;
    struct plant_config plant;
    int32_t setpoint;

    memset(&plant, 0, sizeof plant);
    plant.integrating = integrating;
    plant.falling = config->reverse;
    plant.full_scale = (kind == COARSE) ? 255 : scales[numbers_below(4)];
    shape(&plant, span);
    plant.start = config->output_rest;
    plant.noise = one_of(2) ? between(0, 4) : 0;
    plant.noise = one_of(12) ? plant.full_scale / between(10, 60) : plant.noise;
    plant.seed = numbers_next();
    plant.step_at = one_of(3) ? between(40, 600) : 100000;
    plant.step_by = between(-span / 8, span / 8);
    plant.base =
        (int32_t)(plant.full_scale / 20 -
                  (int64_t)plant.gain_q16 * config->output_min / 65536);
    setpoint =
        plant.base + (int32_t)((int64_t)plant.gain_q16 * holding / 65536);
    if (integrating) {
        plant.load = -holding;
        plant.start = 0;
        plant.base = plant.full_scale / between(2, 4);
        setpoint = plant.full_scale / 2;
    }
    if (kind == COARSE) {
        plant.noise = 0;
        plant.step_by = 0;
    }
    plant.fall_q16 = (kind == HEATER) ? plant.pole_q16 / between(2, 8) : 0;
    plant.growth_q16 = (kind == RUNAWAY) ? between(200, 2500) : 0;
    plant_start(&world.plant, &plant, config->output_rest);
    return (int16_t)(plant.falling ? plant.full_scale - setpoint : setpoint);
}

static void start_swing(struct fixpid_autotune_config *config)
{
    const bool slow = one_of(SLOW_EVERY);

    for (uint8_t i = 0; i < 2; i++) {
        world.half_steps[i] = (uint16_t)(slow ? 4500 : 1 + any_size(6));
    }
    config->timeout_steps = (uint16_t)(slow ? 9000 : config->timeout_steps);
    config->cycles = (uint8_t)(slow ? 4 : config->cycles);
    world.height = (uint16_t)any_size(one_of(4) ? 14 : 10);
    world.unlike = (uint16_t)(one_of(3) ? numbers_below(100) : 0);
    world.left = 0;
    world.above = false;
}

// Above and below by turns, whatever the relay does: a share of the halves and
// heights is another by up to `unlike` percent.
static int16_t swing(void)
{
    const uint32_t more = 100u + numbers_below(world.unlike + 1u);
    int32_t height = (int32_t)(world.height * more / 100u);

    if (world.left == 0) {
        world.above = !world.above;
        world.left = (uint16_t)(world.half_steps[world.above] * more / 100u);
    }
    world.left--;
    if (world.kind == SPIKES && world.left != 0) {
        height = one_of(2) ? height / 16 : 0;
    }
    return (int16_t)(world.above ? height : -height);
}

static int16_t measure(void)
{
    switch (world.kind) {
    case LAG:
    case INTEGRATOR:
    case EXTREME:
    case HEATER:
    case RUNAWAY:
    case COARSE:
        return plant_measure(&world.plant);
    case SWING:
    case SPIKES:
        return swing();
    case NOISE:
    default:
        return numbers_int16();
    }
}

static void say_model(void)
{
    struct fixpid_autotune_process model;
    int32_t values[8];

    memset(&model, 0, sizeof model);
    values[0] = fixpid_autotune_model(&autotune_controller, &model);
    values[1] = (int32_t)model.gain_q8;
    values[2] = (int32_t)model.lag_q4;
    values[3] = (int32_t)model.dead_q4;
    values[4] = (int32_t)model.slope_q24;
    values[5] = model.holding;
    values[6] = model.noise_q4;
    values[7] = model.hysteresis;
    trace_say('m', values, 8);
}

// As the bits of a record, of which two are not the result's to change.
static void set_options(struct fixpid_pid_config *config, uint8_t options)
{
    config->reverse = (options & 0x80u) != 0u;
    config->derivative_on_error = (options & 0x40u) != 0u;
    config->proportional_on_measurement = (options & 0x20u) != 0u;
}

static uint8_t options_of(const struct fixpid_pid_config *config)
{
    return (uint8_t)((config->reverse ? 0x80u : 0u) |
                     (config->derivative_on_error ? 0x40u : 0u) |
                     (config->proportional_on_measurement ? 0x20u : 0u));
}

static void say_result(uint8_t rule, uint8_t robustness_q4)
{
    struct fixpid_pid_config config;
    int32_t values[10] = {rule, robustness_q4};

    memset(&config, 0, sizeof config);
    config.setpoint_weight_q8 = 128;
    set_options(&config, (uint8_t)numbers_next());
    values[8] = options_of(&config);
    values[2] = fixpid_autotune_result(&autotune_controller, rule,
                                       robustness_q4, &config);
    values[3] = config.gains.kp_q8;
    values[4] = (int32_t)config.gains.ki_q24;
    values[5] = config.gains.kd_q8;
    values[6] = config.gains.derivative_filter;
    values[7] = config.setpoint_weight_q8;
    values[8] =
        (int32_t)(((uint32_t)values[8] << 8) | (uint32_t)options_of(&config));
    values[9] =
        fixpid_autotune_reason(&autotune_controller, rule, robustness_q4);
    trace_say('r', values, 10);
}

static void say_results(void)
{
    say_model();
    for (uint8_t rule = 0; rule <= 2; rule++) {
        say_result(rule, FIXPID_AUTOTUNE_SAFE);
        say_result(rule,
                   one_of(2) ? FIXPID_AUTOTUNE_QUICK : FIXPID_AUTOTUNE_CALM);
        say_result(rule, (uint8_t)between(4, 70));
    }
}

// Writes the status and the four fields of the progress.
static void ask_progress(int32_t values[5])
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&autotune_controller, &stage);
    values[0] = status();
    values[1] = stage.phase;
    values[2] = stage.done;
    values[3] = stage.expected;
    values[4] = stage.period;
}

// What is written to an object that held anything.
static void say_record(void)
{
    struct fixpid_autotune_record record;
    struct fixpid_autotune_record spoilt;
    int32_t values[8] = {0, 0, 0};

    values[0] = fixpid_autotune_pack(&autotune_controller, &record);
    if (values[0] != 0) {
        const uint32_t at = numbers_below(FIXPID_AUTOTUNE_RECORD_SIZE);

        spoilt = record;
        spoilt.bytes[at] ^= (uint8_t)(1u << numbers_below(8));
        values[1] = fixpid_autotune_unpack(&autotune_controller, &spoilt);
        if (one_of(2)) {
            say_model(); // the object is as it was
        }
        numbers_fill(&autotune_controller, sizeof autotune_controller);
        values[2] = fixpid_autotune_unpack(&autotune_controller, &record);
    }
    ask_progress(&values[3]);
    trace_say('u', values, 8);
}

static void start(const struct fixpid_autotune_config *config)
{
    const bool good = fixpid_autotune_init(&autotune_controller, config);
    const int32_t values[] = {config->output_min,      config->output_max,
                              config->output_rest,     config->measurement_min,
                              config->measurement_max, config->swing,
                              config->timeout_steps,   config->cycles,
                              config->reverse,         good};

    trace_say('i', values, 10);
}

static int16_t step(int16_t setpoint, int16_t measurement)
{
    const int16_t output =
        fixpid_autotune_step(&autotune_controller, setpoint, measurement);
    int32_t values[8] = {setpoint, measurement, output};

    ask_progress(&values[3]);
    trace_say('s', values, 8);
    return output;
}

static void start_again(void)
{
    int32_t now;

    fixpid_autotune_reset(&autotune_controller);
    now = status();
    trace_say('n', &now, 1);
}

// The configuration and the world of an experiment; returns its setpoint.
static int16_t prepare(enum kind kind, struct fixpid_autotune_config *config)
{
    int16_t setpoint = 0;

    world.kind = kind;
    *config = legal_config();
    switch (kind) {
    case NOISE:
        *config = any_config();
        setpoint = numbers_int16();
        break;
    case SWING:
    case SPIKES:
        start_swing(config);
        break;
    case LAG:
    case INTEGRATOR:
    case HEATER:
    case RUNAWAY:
        config->output_min = (int16_t)(one_of(2) ? 0 : -between(1, 999));
        config->output_max = (int16_t)between(100, 1000);
        config->output_rest = (int16_t)(one_of(2) ? 0 : config->output_min);
        setpoint = start_plant(config, kind);
        if (one_of(16)) {
            setpoint = (int16_t)(setpoint * 3 / 2); // likely out of reach
        }
        break;
    case COARSE:
        config->output_min = (int16_t)between(INT16_MIN, -30000);
        config->output_max = (int16_t)between(30000, INT16_MAX);
        config->output_rest = 0;
        config->swing = (uint16_t)between(8, 40);
        setpoint = start_plant(config, kind);
        break;
    case EXTREME:
    default:
        setpoint = start_plant(config, one_of(4) ? INTEGRATOR : LAG);
        break;
    }
    return setpoint;
}

static void play(int16_t setpoint)
{
    uint16_t until_reset = (uint16_t)(one_of(4) ? between(1, 1200) : 0);
    uint8_t after = 3; // steps once it is over

    while (after != 0) {
        const int16_t output = step(setpoint, measure());

        plant_move(&world.plant, output);
        if (until_reset != 0) {
            until_reset--;
            if (until_reset == 0) {
                say_record();
                start_again();
            }
        }
        if (status() != FIXPID_AUTOTUNE_RUNNING) {
            after--;
        }
    }
}

static void experiment(enum kind kind)
{
    struct fixpid_autotune_config config;
    const int16_t setpoint = prepare(kind, &config);

    start(&config);
    play(setpoint);
    say_results();
    say_record();
    say_results();
    (void)step(setpoint, setpoint);
    if (one_of(4)) { // what was unpacked can start again
        start_again();
        (void)step(setpoint, setpoint);
    }
}

void trace_experiment(uint32_t number)
{
    experiment((enum kind)(number % KINDS));
}

void trace_experiments(long runs)
{
    numbers_seed(2016);
    for (long run = 0; run < runs; run++) {
        trace_experiment((uint32_t)run);
    }
}
