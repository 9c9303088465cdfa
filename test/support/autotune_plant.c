// SPDX-License-Identifier: MIT
#include "autotune_plant.h"

#define POLE_MAX INT64_C(65536)
#define INTEGRATED_MAX (INT64_C(1) << 40)
#define INTEGRAL_MAX (INT64_C(1) << 47)

// floor(value / 2^shift)
static int64_t shift_right_floor(int64_t value, uint8_t shift)
{
    return value >= 0 ? value >> shift : ~(~value >> shift);
}

static int64_t clamp(int64_t value, int64_t low, int64_t high)
{
    if (value < low) {
        return low;
    }
    return value > high ? high : value;
}

void plant_start(struct plant *self, const struct plant_config *config,
                 int16_t output)
{
    const int64_t level_q16 = (int64_t)config->start * 65536;

    self->config = *config;
    for (uint16_t i = 0; i < PLANT_DELAY_MAX; i++) {
        self->line[i] = config->start;
    }
    for (uint8_t i = 0; i <= PLANT_LAGS_MAX; i++) {
        self->levels_q16[i] = level_q16;
    }
    self->position_q16 = level_q16;
    self->speed_q16 = 0;
    self->integral_q32 = 0;
    self->random = config->seed;
    self->steps = 0;
    self->slack = output;
    self->place = 0;
}

static int32_t noise(struct plant *self)
{
    const uint32_t span = 2u * (uint32_t)self->config.noise + 1u;

    self->random = self->random * UINT32_C(1664525) + UINT32_C(1013904223);
    return (int32_t)(((self->random >> 16) * span) >> 16) - self->config.noise;
}

// What a lag gives on of its input: its level, and if it is one of those with a
// lead a part of the difference.
static int64_t given_on(const struct plant *self, uint8_t lag, int64_t input)
{
    const int64_t level_q16 = self->levels_q16[lag];
    int64_t lead_q16 = 0;

    if (lag + self->config.leads > self->config.lags) {
        lead_q16 =
            shift_right_floor((input - level_q16) * self->config.lead_q16, 16);
    }
    return level_q16 + lead_q16;
}

static int64_t last_level(const struct plant *self)
{
    int64_t level_q16 = self->levels_q16[0];

    for (uint8_t lag = 1; lag <= self->config.lags; lag++) {
        level_q16 = given_on(self, lag, level_q16);
    }
    return level_q16;
}

int16_t plant_measure(struct plant *self)
{
    const struct plant_config *const config = &self->config;
    const int64_t level_q32 = config->integrating
                                  ? self->integral_q32
                                  : last_level(self) * config->gain_q16;
    int64_t measurement = config->base + shift_right_floor(level_q32, 32);

    measurement = clamp(measurement + noise(self), 0, config->full_scale);
    if (config->falling) {
        measurement = config->full_scale - measurement;
    }
    return (int16_t)measurement;
}

// What reaches the plant of this step's output: the slack follows it within the
// backlash, and load, step and drift are added.
static int32_t pushed(struct plant *self, int16_t output)
{
    const struct plant_config *const config = &self->config;
    const int32_t drifted =
        self->steps < config->drift_steps ? self->steps : config->drift_steps;
    int64_t sum;

    self->slack = (int32_t)clamp(self->slack, output - config->backlash,
                                 output + config->backlash);
    sum = (int64_t)self->slack + config->load;
    if (self->steps > config->step_at) {
        sum += config->step_by;
    }
    sum += shift_right_floor((int64_t)drifted * config->drift_q16, 16);
    return (int32_t)sum;
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

static int64_t swung(struct plant *self, int64_t input)
{
    const struct plant_config *const config = &self->config;

    self->speed_q16 +=
        shift_right_floor((input - self->position_q16) * config->spring_q16,
                          16) -
        shift_right_floor(self->speed_q16 * config->damp_q16, 16);
    self->position_q16 += self->speed_q16;
    return self->position_q16;
}

static int64_t lagged(struct plant *self, int64_t input)
{
    const struct plant_config *const config = &self->config;
    int64_t pole_q16 = config->pole_q16;

    for (uint8_t lag = 1; lag <= config->lags; lag++) {
        int64_t *const level_q16 = &self->levels_q16[lag];
        const bool falls = lag == 1u && input < *level_q16;
        const int64_t rate =
            falls && config->fall_q16 != 0 ? config->fall_q16 : pole_q16;

        *level_q16 += shift_right_floor((input - *level_q16) * rate, 16);
        input = given_on(self, lag, input);
        pole_q16 = clamp(shift_right_floor(pole_q16 * config->ratio_q8, 8), 1,
                         POLE_MAX);
    }
    return input;
}

static void integrate(struct plant *self, int64_t input)
{
    const struct plant_config *const config = &self->config;

    self->integral_q32 +=
        clamp(input, -INTEGRATED_MAX, INTEGRATED_MAX) * config->gain_q16 +
        shift_right_floor(self->integral_q32, 16) * config->growth_q16;
    self->integral_q32 = clamp(self->integral_q32, -INTEGRAL_MAX, INTEGRAL_MAX);
}

void plant_move(struct plant *self, int16_t output)
{
    int64_t level_q16;

    self->steps++;
    level_q16 = (int64_t)delayed(self, pushed(self, output)) * 65536;
    if (self->config.spring_q16 != 0) {
        level_q16 = swung(self, level_q16);
    }
    self->levels_q16[0] = level_q16;
    level_q16 = lagged(self, level_q16);
    if (self->config.integrating) {
        integrate(self, level_q16);
    }
}
