// SPDX-License-Identifier: MIT
// A simulated world as a microcontroller's pins see it: voltages to convert and
// a drive to set, around one plant and what happens to it.
//
// A program has one world, chosen by the linker: world_pendulum.c,
// world_motor.c or world_oven.c. A world knows the board's wiring
// (port_board.h) but no port function and no controller, and leaves the
// conversion to counts to its caller. It is deterministic: options, seed and
// the sequence of calls decide.
#ifndef WORLD_H
#define WORLD_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A number of the scenario that the command line may change.
struct world_option {
    const char *name;
    double value; // the default until it is set
    double low;
    double high;
    const char *meaning; // with its unit
};

enum world_result { WORLD_OK, WORLD_NO_SUCH_OPTION, WORLD_OUT_OF_RANGE };

// The options of this world, for help texts; the first is its length in s.
const struct world_option *world_options(size_t *count);

// Sets an option, before world_start.
enum world_result world_set(const char *name, double value);

// Begins the scenario at time 0, with the drive off.
void world_start(uint32_t seed);

// Marsaglia's xorshift: the next of a row of random numbers. pre: *state != 0.
uint32_t world_random(uint32_t *state);

// Lets time pass. Events of the scenario happen on a grid of a millisecond.
void world_advance(double seconds);

double world_time_s(void);

// False when the scenario is over.
bool world_running(void);

// What is on an analog input, filters and noise included, as a fraction of the
// converter's reference, 0..1. An input that is not wired is at 0.
double world_voltage(uint8_t channel);

// What the last conversion of an analog input got; the noise does not go on.
double world_last_voltage(uint8_t channel);

// How an analog input is broken, and what `value` is then.
enum world_break {
    WORLD_WHOLE,
    WORLD_STUCK,   // it reads what it read last
    WORLD_READS,   // value, as a wire does that is open or touches another
    WORLD_NOISY,   // value: the standard deviation of what is added
    WORLD_CLIPPED, // it reads value at most and 1 - value at least
    WORLD_MOVED    // up and down the whole range; value: how often a second
};

// Breaks an analog input from here on, or mends it.
void world_break_input(uint8_t channel, enum world_break how, double value);

// The mean voltage of the bridge as a fraction of full drive, -1..1.
void world_drive(double fraction);

// What the plant gets of the drive.
enum world_drive_break {
    WORLD_OBEYED,  // all of it
    WORLD_HELD,    // value, as of a wire that is open or a relay that is shut
    WORLD_MIRRORED // value less the drive
};

// Breaks the drive from here on, or mends it.
void world_break_drive(enum world_drive_break how, double value);

// The true values behind the sensors, to record: names with their units, and as
// many values.
const char *const *world_trace_names(size_t *count);
void world_trace(double *values);

#define WORLD_TRACE_MAX 8u

#endif
