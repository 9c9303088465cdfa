// SPDX-License-Identifier: MIT
// The other kind of plant: one that moves in a controller's steps, in counts of
// its sensor and of its actuator. What a loop without a scenario needs: dead
// time, then an integrator (with a lag or without) or one or two lags, then a
// sensor with noise.
//
//   inner[n+1] = inner[n] + (gain drive[n - delay] - inner[n]) / lag
//   value[n+1] = value[n] + (inner[n+1] - value[n]) / second_lag
//
// These are the difference equations themselves, and not a solution of
// differential ones, so plant.h has no part in them.
#ifndef PLANT_COUNTS_H
#define PLANT_COUNTS_H
#include <stdint.h>

#define PLANT_COUNTS_DELAY_MAX 64

struct plant_counts {
    const char *name;
    double gain;             // counts per count; of an integrator, each step
    double lag_steps;        // 0: an integrator
    double second_lag_steps; // 0: there is none
    int delay_steps;         // 1..PLANT_COUNTS_DELAY_MAX
    int noise_counts;        // of the sensor, each side
    double sensor_max;       // counts, each side of 0
};

// A plant in motion, with the noise of its sensor.
struct motion {
    const struct plant_counts *plant;
    double value; // counts of the sensor
    double inner; // the first of two lags
    double line[PLANT_COUNTS_DELAY_MAX];
    int oldest;
    uint32_t noise;
};

// At rest at 0.
void motion_start(struct motion *self, const struct plant_counts *plant);

// The sensor's reading, whole counts.
int16_t motion_read(struct motion *self);

// One step at a constant output.
void motion_move(struct motion *self, double output);

#endif
