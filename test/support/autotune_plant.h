// SPDX-License-Identifier: MIT
// A plant in integers for experiments that must be the same on every machine:
// backlash, a delay, a mass on a spring, lags and perhaps an integrator, then
// noise and a converter. What is 0 does nothing, but for ratio_q8.
#ifndef AUTOTUNE_PLANT_H
#define AUTOTUNE_PLANT_H
#include <stdbool.h>
#include <stdint.h>

#define PLANT_DELAY_MAX 255
#define PLANT_LAGS_MAX 8

struct plant_config {
    bool integrating;
    int32_t growth_q16; // of what is integrated, each step
    uint8_t delay;
    uint8_t lags;
    int32_t pole_q16; // of the first lag
    int32_t ratio_q8; // of each next pole to the one before; 256: all are alike
    int32_t lead_q16; // part of a lag's input that its output has at once
    uint8_t leads;    // the last so many lags have it
    int32_t spring_q16;
    int32_t damp_q16;
    int32_t fall_q16; // pole of the first lag while it falls
    int32_t backlash;
    int32_t gain_q16;
    int32_t load; // is added to the output, and step_by more after step_at
    int32_t step_at;
    int32_t step_by;
    int32_t drift_q16; // is added in each of the first drift_steps steps
    int32_t drift_steps;
    int32_t base;  // the measurement of an output of 0
    int32_t start; // the output that the plant starts at
    int32_t noise; // counts on each side
    uint32_t seed; // of the noise
    int32_t full_scale;
    bool falling; // the measurement falls when the output rises
};

struct plant {
    struct plant_config config;
    int32_t line[PLANT_DELAY_MAX]; // outputs on their way
    int64_t levels_q16[PLANT_LAGS_MAX + 1];
    int64_t position_q16; // of the mass
    int64_t speed_q16;
    int64_t integral_q32;
    uint32_t random;
    int32_t steps;
    int32_t slack; // where the backlash has the actuator
    uint8_t place;
};

// The actuator rests where `output` has put it.
void plant_start(struct plant *self, const struct plant_config *config,
                 int16_t output);

// The measurement of this step, 0..full_scale. Once a step: it draws the noise.
int16_t plant_measure(struct plant *self);

// The rest of this step, with its output.
void plant_move(struct plant *self, int16_t output);

#endif
