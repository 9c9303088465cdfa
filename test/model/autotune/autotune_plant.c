// SPDX-License-Identifier: MIT
#include "autotune_plant.h"

#define INTEGRAL_MAX (INT64_C(1) << 47)

// floor(value / 2^shift)
static int64_t shift_right_floor(int64_t value, uint8_t shift)
{
    const int64_t divisor = INT64_C(1) << shift;

    return value >= 0 ? value / divisor : -((divisor - 1 - value) / divisor);
}

static int64_t clamp(int64_t value, int64_t low, int64_t high)
{
    if (value < low) {
        return low;
    }
    return value > high ? high : value;
}

void plant_start(struct plant *self, const struct plant_config *config)
{
    self->config = *config;
    for (uint16_t i = 0; i < PLANT_DELAY_MAX; i++) {
        self->line[i] = config->start;
    }
    for (uint8_t i = 0; i <= PLANT_LAGS_MAX; i++) {
        self->levels_q16[i] = (int64_t)config->start * 65536;
    }
    self->integral_q32 = 0;
    self->random = config->seed;
    self->steps = 0;
    self->place = 0;
}

static int32_t noise(struct plant *self)
{
    const uint32_t span = 2u * (uint32_t)self->config.noise + 1u;

    self->random = self->random * UINT32_C(1664525) + UINT32_C(1013904223);
    return (int32_t)(((self->random >> 16) * span) >> 16) - self->config.noise;
}

int16_t plant_measure(struct plant *self)
{
    const struct plant_config *const config = &self->config;
    const int64_t level_q32 =
        config->integrating ? self->integral_q32
                            : self->levels_q16[config->lags] * config->gain_q16;
    int64_t measurement = config->base + shift_right_floor(level_q32, 32);

    measurement = clamp(measurement + noise(self), 0, config->full_scale);
    if (config->falling) {
        measurement = config->full_scale - measurement;
    }
    return (int16_t)measurement;
}

// What was put into the delay as many steps ago as it is long.
static int32_t delayed(struct plant *self, int32_t input)
{
    int32_t output = input;

    if (self->config.delay != 0) {
        output = self->line[self->place];
        self->line[self->place] = input;
        self->place = (uint8_t)((self->place + 1u) % self->config.delay);
    }
    return output;
}

void plant_move(struct plant *self, int16_t output)
{
    const struct plant_config *const config = &self->config;
    int64_t *const levels_q16 = self->levels_q16;
    int32_t input = output + config->load;

    self->steps++;
    if (self->steps > config->step_at) {
        input += config->step_by;
    }
    levels_q16[0] = (int64_t)delayed(self, input) * 65536;
    for (uint8_t i = 1; i <= config->lags; i++) {
        levels_q16[i] += shift_right_floor(
            (levels_q16[i - 1] - levels_q16[i]) * config->pole_q16, 16);
    }
    if (config->integrating) {
        self->integral_q32 += levels_q16[config->lags] * config->gain_q16;
        self->integral_q32 =
            clamp(self->integral_q32, -INTEGRAL_MAX, INTEGRAL_MAX);
    }
}
