// SPDX-License-Identifier: MIT
// Linear plants whose output is held for a step of the controller: a chain of
// sections with a dead time that may end between two steps. They are sampled
// exactly, so a step here is a step of the controller, however long.
#ifndef LINEAR_H
#define LINEAR_H
#include <complex.h>
#include <stdbool.h>

#define LINEAR_SECTIONS 10
#define LINEAR_STATES 12
#define LINEAR_DEAD 2048 // steps of dead time are fewer

// Coefficients of 1, s and s^2: numerator over denominator, which goes up to s
// at least.
struct section {
    double numerator[2];
    double denominator[3];
};

struct linear {
    struct section sections[LINEAR_SECTIONS];
    int count;
    double dead_steps;
    bool integrating; // one of its poles is 0
    bool unstable;    // one of its poles is positive
    bool at_once;     // what of an input passes all sections at once counts
};

void linear_add(struct linear *self, struct section section);
void linear_lag(struct linear *self, double lag);
void linear_integrate(struct linear *self);

// Makes all of its times so many times as long.
void linear_stretch(struct linear *self, double factor);

void linear_amplify(struct linear *self, double gain);

// Without jumps of a turn, as a sum over the sections.
double linear_phase(const struct linear *self, double radians);

// Where its phase falls below this. An unstable plant's begins at -180 degrees,
// so it must rise above it first.
double linear_crossing(const struct linear *self, double phase);

// Dead time and lags together: how slow the plant is.
double linear_steps(const struct linear *self);

// What the plant does from one step to the next.
struct sampled {
    int states;
    int dead;
    double transition[LINEAR_STATES][LINEAR_STATES];
    double now[LINEAR_STATES];    // of the input `dead` steps ago
    double before[LINEAR_STATES]; // and of the one before that
    double output[LINEAR_STATES];
    double direct; // of the input just before the sample is taken
};

void sampled_start(struct sampled *self, const struct linear *plant);

// From the held input to the sampled output, 0 < radians <= pi per step.
double complex sampled_response(const struct sampled *self, double radians);

struct motion {
    const struct sampled *plant;
    const struct sampled *falling; // the plant where its first state falls
    double state[LINEAR_STATES];
    double line[LINEAR_DEAD];
    int at;
    double last;
};

// All is 0, and it falls as it rises until `falling` is set. That one has the
// same dead time.
void motion_start(struct motion *self, const struct sampled *plant);

// As it is after this input for ever; no plant that integrates comes to rest.
void motion_rest(struct motion *self, double input);

double motion_value(const struct motion *self);

// One step with this input.
void motion_move(struct motion *self, double input);

#endif
