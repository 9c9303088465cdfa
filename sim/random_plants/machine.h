// SPDX-License-Identifier: MIT
// Random machines of 23 kinds, with what linear plants do not have: an
// actuator that is coarse, sticks or is slow, a process whose gain or dead time
// changes, and a sensor that is disturbed. A step is one of the controller.
#ifndef MACHINE_H
#define MACHINE_H
#include <stdbool.h>

#include "chance.h"

enum machine_kind {
    MACHINE_FURNACE,   // loses heat by radiation, too
    MACHINE_EQUAL,     // an equal-percentage valve, which is slow
    MACHINE_SATURATES, // its sensor's gain falls
    MACHINE_STICTION,  // or backlash, of 2 to 8 %
    MACHINE_QUARTER,   // a heater read in steps of 0.25 degrees, each second
    MACHINE_THERMISTOR,
    MACHINE_AMBIENT, // which swings, and a door
    MACHINE_SSR,     // half-cycles of the mains
    MACHINE_PWM,     // of ten levels
    MACHINE_NOISE,   // bursts, hum and outliers
    MACHINE_DELAY,   // a dead time that varies
    MACHINE_GAIN,    // which varies as 3 to 1
    MACHINE_OVEN,    // an element of 2 s, the oven of 600 s
    MACHINE_ROD,     // which conducts the heat
    MACHINE_INVERSE, // its response begins in the wrong direction
    MACHINE_TANK,    // with a leak
    MACHINE_POSITION,
    MACHINE_SPEED, // both with friction
    MACHINE_UNSTABLE,
    MACHINE_CASCADE, // around an inner loop
    MACHINE_JITTER,  // of the sampling, with missed samples
    MACHINE_KETTLE,
    MACHINE_HOT_END,
    MACHINES,

    // It is no part of the study: an espresso boiler behind an SSR.
    MACHINE_BOILER = MACHINES
};

#define MACHINE_STATES 20
#define MACHINE_LINE 8192

// All but the last part is drawn and stays. Times are in seconds, and an output
// of 1 is all of it.
struct machine {
    enum machine_kind kind;
    double step_s;
    int parts; // of a step: how finely it is computed
    int output_min, output_max, sensor_max; // counts; the sensor's from 0
    bool reverse;                           // the reading falls
    bool integrating;
    double zero, span; // where the reading is 0, and from there to its end
    double holding;    // the output that holds the setpoint
    int setpoint;      // counts
    double slowest_s;  // how long it takes to settle, about
    double rest[MACHINE_STATES]; // at the setpoint

    double dead_s, wander, wander_s; // the dead time's, by such a share
    double rate;                     // of the actuator, per second; 0: any
    double backlash, stiction;
    int levels, half_cycles; // of the actuator; 0: any output
    double noise;            // standard deviation, counts
    double burst, outliers;  // noise in a burst; share of the readings
    double hum, hum_steps;   // counts, and its period
    double jitter, missed;   // shares of a step, and of the steps
    double swing, swing_s, swing_at, door; // of the surroundings

    int states;
    double gain, lag_s[3], curve; // of lags one after the other
    double power, loss, radiation, coupling, room;
    double body, element, sensor_s; // heat of a degree; a lag
    double inertia, damping, friction, breakaway;
    double inner_gain, inner_min, inner_power;
    int sensed; // part of a rod

    bool smooth; // nothing of what is random, sticks or is coarse
    double load; // added to the output
    struct chance chance;
    double state[MACHINE_STATES];
    double line[MACHINE_LINE];
    int at;
    double time_s;
    double driven, moved, carried; // the actuator's
    int burst_left;
    long steps;
};

const char *machine_name(enum machine_kind kind);

// Machine `number` of this seed, with a setpoint on the scale.
void machine_draw(struct machine *self, enum machine_kind kind,
                  unsigned long seed, long number);

// At the setpoint with the output that holds it, or cold and off. A position
// may begin beside its setpoint, and what is unstable begins there. The same
// seed gives the same noise.
void machine_start(struct machine *self, bool at_rest, uint64_t seed);

// The process as an exact sensor would read it, in counts.
double machine_value(const struct machine *self);

// What the sensor reads: in whole counts of its range.
int machine_read(struct machine *self);

// One step with this output, in counts.
void machine_drive(struct machine *self, double output);

// Settles with this output, without noise, and stays smooth.
void machine_settle(struct machine *self, double output);

// What differs from kind to kind, in machine_kinds.c. Draws all but the
// setpoint and the state at rest.
void machine_kind_draw(struct machine *self);

// The states' change per second with this output.
void machine_kind_change(const struct machine *self, const double *state,
                         double output, double *change);

// In its own unit.
double machine_kind_value(const struct machine *self);

// The state when it is cold and off.
void machine_kind_cold(struct machine *self);

#endif
