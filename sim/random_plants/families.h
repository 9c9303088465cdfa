// SPDX-License-Identifier: MIT
// Random plants of 22 families, each with the circumstances of an experiment.
#ifndef FAMILIES_H
#define FAMILIES_H
#include "chance.h"
#include "linear.h"
#include "machine.h"

// T is the lag, L the dead time.
enum family {
    FAMILY_LAG_DOMINANT, // L / T of 0.02 to 0.2
    FAMILY_BALANCED,     // 0.2 to 1
    FAMILY_DEAD_TIME,    // 1 to 10
    FAMILY_EQUAL_LAGS,   // three to eight
    FAMILY_INVERSE,      // the response begins in the wrong direction
    FAMILY_OSCILLATORY,  // damping 0.3 to 0.9
    FAMILY_INTEGRATOR,   // and dead time
    FAMILY_SERVO,        // integrator, lag, 0 to 3 steps of dead time
    FAMILY_INTEGRATOR_LAG,
    FAMILY_UNSTABLE,   // one pole, positive
    FAMILY_FRACTIONAL, // about 1 / (1 + s T)^0.5
    FAMILY_BATCH,      // the test batch that AMIGO was made for
    FAMILY_TWO_LAGS,
    FAMILY_SERVO_LAG,      // a servo with a second lag
    FAMILY_HEATER,         // cools two to five times as slowly
    FAMILY_BACKLASH,       // of 0.3 to 3 % of the output
    FAMILY_DRIFT,          // the load moves by up to 10 %
    FAMILY_HOLDING_LOW,    // 3 to 5 % of the output hold the setpoint
    FAMILY_HOLDING_HIGH,   // 93 to 97 %
    FAMILY_COARSE,         // 8 bits of output, 10 of a noisy sensor
    FAMILY_LOAD,           // a step of the load in every experiment
    FAMILY_SERVO_NO_DELAY, // no dead time
    FAMILIES,

    // It is no part of the study: a fractional lag of which 2 % answer at once.
    FAMILY_AT_ONCE = FAMILIES
};

struct subject {
    enum family family; // of a machine: FAMILIES
    const char *name;   // of the family or the kind
    struct linear plant;
    const struct machine *machine; // that moves in the plant's place, or NULL
    double period_steps;           // of its oscillation at -180 degrees
    double cooling;       // its first lag is so many times as long as it falls
    double backlash;      // output counts, on each side
    double drift;         // output counts, reached after 30 times T + L
    double load;          // output counts, after the step load_at
    long load_at;         // -1: never
    double holding;       // share of the output's range
    double noise;         // standard deviation, counts
    int sensor_max;       // counts, from 0
    int output_min;       // counts
    int output_max;       // counts
    bool reverse;         // the reading falls when the output rises
    bool at_rest;         // it begins at the setpoint, else from power-on
    int setpoint;         // counts
    int timeout_steps;    // for half a cycle
    int cycles;           // of the experiment
    double each_side;     // share of the output around its rest; 0: all
    struct chance chance; // of the sensor's noise
};

// Subject `number` of this seed. The study takes the families by turns.
struct subject draw_subject(unsigned long seed, long number,
                            enum family family);

const char *family_name(enum family family);

// L + T, twice that if it integrates, of a machine about that: what the length
// of an experiment is measured in.
double subject_scale(const struct subject *self);

#endif
