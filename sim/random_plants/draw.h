// SPDX-License-Identifier: MIT
// Random plants, each with an experiment to be done on it.
#ifndef DRAW_H
#define DRAW_H
#include <stdint.h>

#include "plant_lags.h"

// A whole batch is drawn from the first five kinds by turns, or from one of the
// others alone.
enum kind {
    KIND_LAG, // with dead time of 0.05 to 10 lags
    KIND_TWO_LAGS,
    KIND_LAGS,       // four to six equal ones
    KIND_INTEGRATOR, // with dead time
    KIND_POSITION,   // an integrator behind a lag, with dead time
    KIND_MIXED,      // the end of those by turns
    KIND_SERVO,      // a position with a dead time of 0 to 3 steps
    KIND_DEAD        // a lag with dead time of 1 to 10 lags
};

struct task {
    struct plant_lags plant;
    enum kind kind;
    double sensor_max; // counts, from 0
    double output_max; // counts, from 0
    double holding;    // output that holds the setpoint
    double noise;      // standard deviation, counts
    bool power_on;     // it begins cold, and not at the setpoint
    bool reverse;
    double load; // output counts, from the step load_at on
    long load_at;
    double zero;  // counts, of the sensor when the plant is at 0
    double drift; // output counts that an integrator loses
    int setpoint;
    int timeout_steps;
    uint64_t noise_state;
};

// What is not left to chance.
struct draw {
    enum kind kind;    // KIND_MIXED or later
    double load_share; // of the experiments that meet a load
    double holding;    // share of the output's range; below 0: drawn
    uint64_t state;
};

void draw_start(struct draw *self, unsigned long seed);

// The next plant; `number` counts them from 0.
struct task draw_task(struct draw *self, int number);

// Normal noise of standard deviation 1, by the sum of twelve numbers.
double draw_noise(uint64_t *state);

#endif
