// SPDX-License-Identifier: MIT
// Five plants in steps, with the gains that the comparisons use: what a
// controller meets most, in counts of its sensor and of its actuator.
#ifndef PLANTS_H
#define PLANTS_H
#include <stdint.h>

#include "law.h"

#define PLANTS 5
#define PLANT_SETPOINTS 3
#define PLANT_DELAY_MAX 64

enum plant_kind {
    PLANT_ONE_LAG,
    PLANT_TWO_LAGS,
    PLANT_INTEGRATOR,
    PLANT_MOTOR,
    PLANT_OVEN
};

struct plant {
    const char *name;
    enum plant_kind kind;
    int delay_steps;  // 1..PLANT_DELAY_MAX
    int noise_counts; // of the sensor, each side
    double output_min;
    double output_max;
    double sensor_max; // counts, each side of 0

    struct law_gains gains;
    double setpoint_weight;

    // One after the other; the second is out of reach of all but the
    // integrator.
    double setpoints[PLANT_SETPOINTS];
    int steps; // of each

    // Of the relay experiment.
    int16_t relay_low;
    int16_t relay_high;
    double tune_at;
    uint16_t timeout_steps;
};

extern const struct plant plants[PLANTS];

// A plant in motion, with the noise of its sensor.
struct motion {
    const struct plant *plant;
    double value; // counts of the sensor
    double inner; // the first of two lags
    double line[PLANT_DELAY_MAX];
    int oldest;
    uint32_t noise;
};

// At rest at 0.
void motion_start(struct motion *self, const struct plant *plant);

// The sensor's reading, whole counts.
int16_t motion_read(struct motion *self);

// One step at a constant output.
void motion_move(struct motion *self, double output);

#endif
