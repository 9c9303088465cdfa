// SPDX-License-Identifier: MIT
// One loop's plant with its sensor and its actuator. The tuner has two: the
// library's and its twin's.
#ifndef TUNER_SCENE_H
#define TUNER_SCENE_H
#include <stdint.h>

#include "plant_motor.h"
#include "plant_oven.h"
#include "plant_pendulum.h"
#include "plant_process.h"

#define DEGREES_PER_RAD 57.29577951308232

struct scene {
    int kind; // enum tuner_plant
    struct process process;
    struct oven oven;
    struct motor motor;
    struct pendulum pendulum;
    double load;
    double shove_left_s;
    uint32_t noise;
};

// At rest, from tuner_params.
void scene_begin(struct scene *self);

// The measurement's value in units.
double scene_value(const struct scene *self);

// What the converter makes of the value.
int16_t scene_read(struct scene *self);

// Units as counts of the sensor, which ends where its bits do.
int16_t scene_counts(double units);

// The dead time as it is simulated.
double scene_dead_s(const struct scene *self);

void scene_load(struct scene *self, double load);

// What one count of error is to the controller: AN937's motor has 4000 counts
// of speed where this sensor has 1023.
int scene_error_per_count(void);

// A step at an output in counts.
void scene_move(struct scene *self, double output);

#endif
