// SPDX-License-Identifier: MIT
// A plant in integers for experiments that must be the same on every machine:
// a delay, lags and perhaps an integrator, then noise and a converter.
#ifndef AUTOTUNE_PLANT_H
#define AUTOTUNE_PLANT_H
#include <stdbool.h>
#include <stdint.h>

#define PLANT_DELAY_MAX 255
#define PLANT_LAGS_MAX 6

struct plant_config {
    bool integrating;
    bool falling; // the measurement falls when the output rises
    uint8_t delay;
    uint8_t lags;
    int32_t pole_q16; // of each lag
    int32_t gain_q16;
    int32_t load; // is added to the output, and step_by more after step_at
    int32_t step_at;
    int32_t step_by;
    int32_t base;  // the measurement of an output of 0
    int32_t start; // the output that the plant starts at
    int32_t noise; // counts on each side
    uint32_t seed; // of the noise
    int32_t full_scale;
};

struct plant {
    struct plant_config config;
    int32_t line[PLANT_DELAY_MAX]; // outputs on their way
    int64_t levels_q16[PLANT_LAGS_MAX + 1];
    int64_t integral_q32;
    uint32_t random;
    int32_t steps;
    uint8_t place;
};

void plant_start(struct plant *self, const struct plant_config *config);

// The measurement of this step, 0..full_scale. Once a step: it draws the noise.
int16_t plant_measure(struct plant *self);

// The rest of this step, with its output.
void plant_move(struct plant *self, int16_t output);

#endif
