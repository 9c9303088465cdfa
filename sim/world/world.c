// SPDX-License-Identifier: MIT
#include "world.h"

#include <math.h>
#include <string.h>

#include "scene.h"

#define SCENE_PERIOD_S 1e-3
#define LENGTH 0u // the option that ends the scenario

static double now_s;
static double scene_count; // updates of the scene so far
static double drive;

static struct {
    enum world_drive_break broken;
    double value;
} output;

static uint32_t noise_state;

#define CHANNELS 256u

// Of each analog input; all are whole until one is broken.
static struct input {
    enum world_break broken;
    double value;
    double last; // what it read
} inputs[CHANNELS];

uint32_t world_random(uint32_t *state)
{
    *state ^= (*state & 0x7FFFFu) << 13;
    *state ^= *state >> 17;
    *state ^= (*state & 0x7FFFFFFu) << 5;
    return *state;
}

static double uniform(void)
{
    return (double)world_random(&noise_state) / 4294967296.0;
}

// Standard deviation 1, nearly normal: a sum of twelve has variance 1.
static double normal(void)
{
    double sum = -6.0;
    for (int i = 0; i < 12; i++) {
        sum += uniform();
    }
    return sum;
}

const struct world_option *world_options(size_t *count)
{
    *count = scene_option_count;
    return scene_options;
}

enum world_result world_set(const char *name, double value)
{
    enum world_result result = WORLD_NO_SUCH_OPTION;
    for (size_t i = 0; i < scene_option_count; i++) {
        if (strcmp(scene_options[i].name, name) == 0) {
            result = WORLD_OUT_OF_RANGE;
            // Written so that a value that is not a number is refused.
            if ((value >= scene_options[i].low) &&
                (value <= scene_options[i].high)) {
                scene_options[i].value = value;
                result = WORLD_OK;
            }
        }
    }
    return result;
}

void world_start(uint32_t seed)
{
    now_s = 0.0;
    scene_count = 0.0;
    drive = 0.0;
    // An odd multiplier maps seeds one to one.
    const uint32_t mixed = seed * 2654435769u;
    noise_state = (mixed != 0u) ? mixed : 1u;
    scene_start();
}

static double driven(void)
{
    double fraction = drive;
    if (output.broken == WORLD_HELD) {
        fraction = output.value;
    } else if (output.broken == WORLD_MIRRORED) {
        fraction = output.value - drive;
    } else {
        // it is whole
    }
    return fraction;
}

void world_advance(double seconds)
{
    const double end_s = now_s + seconds;
    // Deviation 14.1: simulated time decides, and it is not an integer.
    while (now_s < end_s) {
        if (now_s >= (scene_count * SCENE_PERIOD_S)) {
            scene_update(scene_count * SCENE_PERIOD_S);
            scene_count += 1.0;
        }
        const double until_s = fmin(end_s, scene_count * SCENE_PERIOD_S);
        scene_advance(driven(), until_s - now_s);
        now_s = until_s;
    }
}

double world_time_s(void)
{
    return now_s;
}

bool world_running(void)
{
    return now_s < scene_options[LENGTH].value;
}

void world_break_input(uint8_t channel, enum world_break how, double value)
{
    inputs[channel].broken = how;
    inputs[channel].value = value;
}

// A triangle from 0 to 1 and back, `often` times a second.
static double moved(double often)
{
    const double turn = fmod(now_s * often, 1.0);
    return 1.0 - fabs((2.0 * turn) - 1.0);
}

static double broken(const struct input *input, double whole)
{
    double fraction = whole;
    switch (input->broken) {
    case WORLD_STUCK:
        fraction = input->last;
        break;
    case WORLD_READS:
        fraction = input->value;
        break;
    case WORLD_NOISY:
        fraction = whole + (input->value * normal());
        break;
    case WORLD_CLIPPED:
        fraction = fmin(fmax(whole, 1.0 - input->value), input->value);
        break;
    case WORLD_MOVED:
        fraction = moved(input->value);
        break;
    default:
        break;
    }
    return fraction;
}

double world_voltage(uint8_t channel)
{
    struct input *const input = &inputs[channel];
    double noise = 0.0;
    const double clean = scene_voltage(channel, &noise);
    const double fraction = broken(input, clean + (noise * normal()));
    input->last = fmin(fmax(fraction, 0.0), 1.0);
    return input->last;
}

double world_last_voltage(uint8_t channel)
{
    return inputs[channel].last;
}

void world_drive(double fraction)
{
    drive = fmin(fmax(fraction, -1.0), 1.0);
}

void world_break_drive(enum world_drive_break how, double value)
{
    output.broken = how;
    output.value = value;
}

const char *const *world_trace_names(size_t *count)
{
    *count = scene_trace_count;
    return scene_trace_names;
}

void world_trace(double *values)
{
    scene_trace(values);
}
