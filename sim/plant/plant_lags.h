// SPDX-License-Identifier: MIT
// A plant that is continuous in time, in counts and in a controller's steps:
// dead time, then lags one after the other, then perhaps an integrator. Its
// output is held for a step, as a converter does, and moves in eighths of one.
//
// Its dead time is a whole number of eighths. Unlike the one of plant_counts.h
// it has a frequency response that is known exactly, to judge a loop by.
#ifndef PLANT_LAGS_H
#define PLANT_LAGS_H
#include <stdbool.h>

#define PLANT_LAGS_MAX 6
#define PLANT_LAGS_PARTS 8 // of a step
#define PLANT_LAGS_DEAD_MAX 60
#define PLANT_LAGS_LINE (PLANT_LAGS_DEAD_MAX * PLANT_LAGS_PARTS)

struct plant_lags {
    double gain; // counts per count; of an integrator, each step
    bool integrating;
    int lags; // 0..PLANT_LAGS_MAX; one or more unless it integrates
    double lag_steps[PLANT_LAGS_MAX];
    double dead_steps; // 0..PLANT_LAGS_DEAD_MAX
};

// A plant in motion.
struct lags_motion {
    const struct plant_lags *plant;
    double share[PLANT_LAGS_MAX]; // of a lag's way that it moves in a part
    double lag[PLANT_LAGS_MAX];   // before the gain
    double integral;              // after the gain
    double line[PLANT_LAGS_LINE];
    int dead_parts;
    int oldest;
};

// The lags at rest with this output, the integral at 0.
void lags_start(struct lags_motion *self, const struct plant_lags *plant,
                double output);

double lags_value(const struct lags_motion *self);

// One step at a constant output.
void lags_move(struct lags_motion *self, double output);

// The dead time as it is simulated.
double lags_dead_steps(const struct plant_lags *plant);

double lags_sum_steps(const struct plant_lags *plant);

// The time that matters to a controller, in steps: dead time and lags, twice of
// an integrating plant.
double lags_scale_steps(const struct plant_lags *plant);

#endif
