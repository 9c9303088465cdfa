/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_tpo: time-proportional output, for an actuator that can only be on or
// off: a relay, a solid-state relay, a solenoid valve.
//
// Time is divided into windows of some steps. Each window begins with one
// pulse, whose share of the window is the duty. Pulses are whole steps; a
// remainder that one window cannot give, because it is less than a step or less
// than the shortest pulse, is carried into the next. So the mean is exact: over
// any number of windows the on-steps differ from the sum of the duties by less
// than the shortest pulse or gap, one step at least.
//
// Call fixpid_tpo_step once per step. The application chooses the period of a
// step, usually the controller's:
//   relay = fixpid_tpo_step(&tpo, fixpid_pid_step(&pid, setpoint, y));
// The module has no clock. Integers only, no division.
//
// With a tuner: with fixpid_autotune in the controller's place, call
// fixpid_tpo_step ten times for each step of the tuner, and later of the
// controller, with a window of ten, which is one step of theirs. Then the gains
// are as good as with an output that takes every value. Do not call it at the
// tuner's own rate: the tuner would take each window for a swing of the plant.
//
// Only the duty of a window's first step counts. The others are ignored, so a
// change waits for the next window. To switch off at once, call
// fixpid_tpo_reset.
//
// There is at most one pulse in a window. Each on-time lasts minimum_on steps
// or more, each off-time minimum_off or more, also across windows. A window of
// duty 0 has no pulse, and one of full duty no gap.
//
// Choose a window of at most a tenth of the plant's lag, because waiting for
// the window acts like a dead time, and minimum times that the actuator
// tolerates: it makes at most 3600 / (window in seconds) on-off cycles an hour.
// With a window of 1 and no minimum it is a sigma-delta modulator, which has
// the least ripple and switches most. If the actuator needs a rest after
// power-up, make steps of duty 0 first.
//
// Any number of them work side by side. Functions of one must not interrupt
// each other; fixpid.h lists the chips on which those of two must not either.
#ifndef FIXPID_TPO_H
#define FIXPID_TPO_H
#include <stdbool.h>
#include <stdint.h>

FIXPID_C_BEGIN

struct fixpid_tpo_config {
    // The duty that is on without a gap, 1..32767: usually the controller's
    // output_max.
    int16_t full;

    uint16_t window; // steps; 1..32767

    // The shortest pulse and the shortest gap in steps, each 0..window and both
    // together at most window. 0 works like 1, but adds nothing to that sum.
    uint16_t minimum_on;
    uint16_t minimum_off;
};

// What fixpid_tpo_check returns: which field is illegal.
enum fixpid_tpo_problem {
    FIXPID_TPO_OK,
    FIXPID_TPO_BAD_FULL,
    FIXPID_TPO_BAD_WINDOW,
    FIXPID_TPO_BAD_MINIMUM_ON,
    FIXPID_TPO_BAD_MINIMUM_OFF // with minimum_on it is more than the window
};

// This is private, and open only so that the application can allocate it: 20
// bytes.
struct fixpid_tpo {
    int32_t credit;      // duty x steps that the relay owes
    int32_t pulse_least; // the credit that opens a window with a pulse
    int32_t whole_least; // the credit that makes all of a window a pulse
    int16_t full;        // 0: refused
    uint16_t window;
    uint16_t left; // steps of this window that are to come
    uint8_t on;    // this window has a pulse
    uint8_t whole; // this window has no gap
};

// Starts off: nothing is owed, and the next step begins a window. A value
// outside its range above is refused: the result is false, and every step is
// off until a good init. An all-zero object is off, too.
bool fixpid_tpo_init(FIXPID_DATA struct fixpid_tpo *self,
                     const struct fixpid_tpo_config *config);

// Tells why init would refuse a configuration: the first member, in the order
// of the structure, that is illegal. FIXPID_TPO_OK means that init accepts it.
// A linker leaves this function out of firmware that does not call it.
enum fixpid_tpo_problem fixpid_tpo_check(
    const struct fixpid_tpo_config *config);

// Off at once, as after init: forgets what is owed, and the next step begins a
// window. It does not wait for the minimum times.
void fixpid_tpo_reset(FIXPID_DATA struct fixpid_tpo *self);

// One step: true is on. Any duty is legal; below 0 it counts as 0, above full
// as full. With W the window and c the credit carried over, 0 at first, a
// window's first step makes
//   owed  = c + duty * W
//   pulse = floor(owed / full), 0 if owed is negative
//   pulse = 0, if it is below minimum_on
//   pulse = W, if it is above W or W - pulse is below minimum_off
//   c     = owed - pulse * full
// and the window's first `pulse` steps are on.
bool fixpid_tpo_step(FIXPID_DATA struct fixpid_tpo *self, int16_t duty);

FIXPID_C_END

#endif
