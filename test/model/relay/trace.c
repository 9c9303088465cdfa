// SPDX-License-Identifier: MIT
// Random experiments, printed for model.rb: a line for each call, with what it
// was given and what it answered.
//
//   i CONFIGURATION... ACCEPTED
//   n STATUS                                        a reset
//   s SETPOINT MEASUREMENT OUTPUT STATUS
//   r RULE ACCEPTED KP KI KD FILTER                 0 for what was not given
//
// Or a digest of them: test/support/trace_lines.c.
#include "fixpid_relay.h"
#include "numbers.h"
#include "trace_lines.h"

#define LINE_MAX 16

// What the experiment is done on.
enum kind {
    NOISE, // no plant at all, and any configuration
    LAG,   // first order with dead time
    INTEGRATOR,
    SWING, // a made-up swing: any period and height, and sometimes another
    KINDS
};

struct world {
    enum kind kind;
    int32_t level_q8;
    int16_t line[LINE_MAX]; // outputs on their way
    uint8_t at, dead_time;
    uint8_t lag_shift;
    uint16_t noise;
    int16_t direction;
    uint16_t half_steps, height, unlike; // of a swing
    uint16_t left;
    int16_t side;
};

static struct fixpid_relay tuner;

static uint8_t status(void)
{
    return fixpid_relay_status(&tuner);
}

// 1..2^bits - 1, small numbers as often as large ones.
static uint16_t any_size(uint32_t bits)
{
    const uint32_t size = 1u + numbers_below(bits);

    return (uint16_t)((1u << (size - 1u)) + numbers_below(1u << (size - 1u)));
}

static void order(int16_t *low, int16_t *high)
{
    if (*low > *high) {
        const int16_t kept = *low;

        *low = *high;
        *high = kept;
    }
}

static struct fixpid_relay_config any_config(void)
{
    struct fixpid_relay_config config = {
        .output_min = numbers_int16(),
        .output_max = numbers_int16(),
        .output_rest = numbers_int16(),
        .measurement_min = numbers_int16(),
        .measurement_max = numbers_int16(),
        .hysteresis = (uint16_t)numbers_below(8200),
        .timeout_steps = (uint16_t)numbers_below(33000),
        .cycles = (uint8_t)numbers_below(10),
        .options = (uint8_t)(numbers_below(8) == 0 ? numbers_next()
                                                   : numbers_below(2) * 0x80u)};

    if (numbers_below(4) != 0) { // or hardly any would be legal
        order(&config.output_min, &config.output_max);
        order(&config.measurement_min, &config.measurement_max);
    }
    return config;
}

static struct fixpid_relay_config legal_config(void)
{
    const uint16_t span = any_size(16);
    const int32_t low = INT16_MIN + (int32_t)numbers_below(65536u - span);

    return (struct fixpid_relay_config){
        .output_min = (int16_t)low,
        .output_max = (int16_t)(low + span),
        .output_rest = numbers_int16(),
        .measurement_min = -32000,
        .measurement_max = 32000,
        .hysteresis = (uint16_t)(1u + numbers_below(numbers_below(3) ? 4 : 80)),
        .timeout_steps = 3000,
        .cycles = (uint8_t)(1u + numbers_below(8)),
        .options = (uint8_t)(numbers_below(2) * 0x80u)};
}

// A relay about 0 that moves a plant by some hundred counts.
static struct fixpid_relay_config plant_config(struct world *world)
{
    struct fixpid_relay_config config = legal_config();

    config.output_min = (int16_t)(-100 - (int16_t)numbers_below(900));
    config.output_max = (int16_t)(100 + numbers_below(900));
    config.timeout_steps = (uint16_t)(20u + numbers_below(600));
    world->direction = config.options == 0 ? 1 : -1;
    return config;
}

static struct world any_world(enum kind kind)
{
    const uint16_t height = any_size(14);
    struct world world = {.kind = kind,
                          .dead_time = (uint8_t)(1u + numbers_below(LINE_MAX)),
                          .lag_shift = (uint8_t)(1u + numbers_below(6)),
                          .half_steps = any_size(8),
                          .height = height < 50 ? 50 : height,
                          .side = -1};

    if (numbers_below(3) == 0) {
        world.noise = (uint16_t)numbers_below(12);
    }
    if (numbers_below(3) == 0) { // a third, so that some are not alike
        world.unlike = (uint16_t)numbers_below(100);
    }
    return world;
}

static int16_t plant(struct world *world, int16_t output)
{
    const uint8_t now = (uint8_t)((world->at + world->dead_time) % LINE_MAX);
    int32_t drive_q8 = 256 * (int32_t)world->direction;

    world->line[now] = output;
    world->at = (uint8_t)((world->at + 1u) % LINE_MAX);
    drive_q8 *= world->line[world->at];
    if (world->kind == LAG) {
        drive_q8 = drive_q8 - world->level_q8;
    }
    world->level_q8 += drive_q8 / (1 << world->lag_shift);
    return (int16_t)(world->level_q8 / 256);
}

// Up and down by turns, whatever the relay does: a share of the halves and
// heights is another by up to `unlike` percent.
static int16_t swing(struct world *world)
{
    const uint32_t more = 100u + numbers_below(world->unlike + 1u);

    if (world->left == 0) {
        world->side = (int16_t)-world->side;
        world->left = (uint16_t)(world->half_steps * more / 100u);
        if (world->left == 0) {
            world->left = 1;
        }
    }
    world->left--;
    return (int16_t)(world->side * (int32_t)(world->height * more / 100u));
}

static int16_t measure(struct world *world, int16_t output)
{
    int32_t measurement;

    switch (world->kind) {
    case LAG:
    case INTEGRATOR:
        measurement = plant(world, output);
        break;
    case SWING:
        measurement = swing(world);
        break;
    case NOISE:
    default:
        return numbers_int16();
    }
    measurement += (int32_t)numbers_below(2u * world->noise + 1u);
    measurement -= world->noise;
    return (int16_t)(measurement > 32767 ? 32767 : measurement);
}

static void say_results(void)
{
    for (uint8_t rule = 0; rule <= 2; rule++) {
        struct fixpid_pid_gains gains = {0, 0, 0, 0};
        const bool good = fixpid_relay_result(&tuner, rule, &gains);
        const int32_t values[] = {rule,        good,
                                  gains.kp_q8, (int32_t)gains.ki_q24,
                                  gains.kd_q8, gains.derivative_filter};

        trace_say('r', values, 6);
    }
}

static void start(const struct fixpid_relay_config *config)
{
    const bool good = fixpid_relay_init(&tuner, config);
    const int32_t values[] = {config->output_min,      config->output_max,
                              config->output_rest,     config->measurement_min,
                              config->measurement_max, config->hysteresis,
                              config->timeout_steps,   config->cycles,
                              config->options,         good};

    trace_say('i', values, 10);
}

static int16_t step(int16_t setpoint, int16_t measurement)
{
    const int16_t output = fixpid_relay_step(&tuner, setpoint, measurement);
    const int32_t values[] = {setpoint, measurement, output, status()};

    trace_say('s', values, 4);
    return output;
}

static void start_again(void)
{
    int32_t now;

    fixpid_relay_reset(&tuner);
    now = status();
    trace_say('n', &now, 1);
}

static void experiment(enum kind kind)
{
    struct world world = any_world(kind);
    struct fixpid_relay_config config;
    uint8_t after = 3; // steps once it is over
    int16_t setpoint = 0;
    int16_t output = 0;

    switch (kind) {
    case NOISE:
        config = any_config();
        setpoint = numbers_int16();
        break;
    case SWING:
        config = legal_config();
        break;
    default:
        config = plant_config(&world);
        setpoint = (int16_t)((int32_t)numbers_below(100) - 50);
        if (numbers_below(8) == 0) {
            setpoint = (int16_t)(setpoint * 100); // likely out of reach
        }
        break;
    }
    start(&config);
    for (uint16_t n = 0; n < 40000u && after != 0; n++) {
        output = step(setpoint, measure(&world, output));
        if (numbers_below(2000) == 0) {
            start_again();
        }
        if (status() != FIXPID_RELAY_RUNNING) {
            after--;
        }
    }
    say_results();
}

void trace_experiment(uint32_t number)
{
    experiment((enum kind)(number % KINDS));
}

void trace_experiments(long runs)
{
    numbers_seed(1984);
    for (long run = 0; run < runs; run++) {
        trace_experiment((uint32_t)run);
    }
}
