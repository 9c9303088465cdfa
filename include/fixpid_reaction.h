/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_reaction: gains for fixpid_pid from the first minutes of a heat-up.
//
// It is for plants that are heated, cooled or filled and may begin at rest: an
// oven, a boiler, a hot end, a hot plate, a tank. Use fixpid_autotune for
// plants that run away by themselves, if the dead time is longer than half the
// lag, or if half the output does not have half the effect and less than full
// output is tried (a dimmer, an equal-percentage valve).
//
// The output changes from one value to another, and the first response of the
// reading gives the gains: the process reaction curve of Ziegler and Nichols
// (1942). The module measures the noise for 32 steps at output_rest. Then it
// returns output_drive until the reading no longer rises more steeply. The line
// of the steepest slope, extended back to the moment of the change, misses the
// reading's start by some counts: these and the slope give the delay. The
// static gain and the lag are not needed, so the experiment ends long before
// the reading settles: on heaters after about a minute, and after at most 32800
// steps.
//
// Call fixpid_reaction_step where the controller's step would be called, at the
// same rate, until the status is no longer FIXPID_REACTION_RUNNING. Then the
// controller takes over in the same step:
//
//   if (fixpid_reaction_status(&reaction) != FIXPID_REACTION_RUNNING) {
//       if (fixpid_reaction_result(&reaction, FIXPID_REACTION_PID,
//                                  FIXPID_REACTION_SAFE, &config.gains)) {
//           config.setpoint_weight_q8 = 128;
//           fixpid_pid_init(&pid, &config);
//           output = fixpid_pid_step(&pid, setpoint, measurement);
//       } else {
//           say(fixpid_reaction_status(&reaction));
//       }
//   }
//
// fixpid_pid_seed is not needed: far below the setpoint the proportional term
// holds the output at its end, so nothing jumps. A setpoint weight of 1/2
// avoids most of the overshoot. To hold the reading where it is instead, seed
// the controller with output_rest.
//
// Begin at rest. A reading that still coasts up from earlier heat ends as
// MOVING in most cases, but not in all; a reading that falls back does no harm.
//
// Switching the output off does not remove stored heat: the reading coasts on.
// In simulations with all ratios of dead time to lag, the reading never reached
// a measurement_stop at least four times as far from the start as it coasts.
// With a nearer stop the experiment ends as LIMIT, and the reading may pass the
// stop: by as much as it coasts if the stop is nearer than one and a half times
// that. So begin cold, or with a smaller output: the reading then coasts less
// far.
//
// The module keeps the reading as the means of up to eight blocks; when there
// are eight, each pair becomes one block of twice the length. So no time is
// configured, and nothing depends on the rate. The gains belong to the rate of
// the experiment: a step is their unit of time. The arithmetic is in integers,
// and a step does not divide. Every measurement is legal, an output is
// output_rest, output_drive or 0, and each experiment ends.
//
// Any number of experiments work side by side. Functions of one experiment must
// not interrupt each other; fixpid.h lists the chips on which those of two must
// not either.
#ifndef FIXPID_REACTION_H
#define FIXPID_REACTION_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_pid.h"

FIXPID_C_BEGIN

// What fixpid_reaction_status returns, and what to do. All but RUNNING are
// final until reset.
enum fixpid_reaction_state {
    // init found an illegal configuration. Outputs 0.
    FIXPID_REACTION_REFUSED,

    // Keep stepping.
    FIXPID_REACTION_RUNNING,

    // It has measured: fixpid_reaction_result gives gains.
    FIXPID_REACTION_DONE,

    // The reading was not at rest before the output changed: it moved by more
    // than 511 counts, or rose in the direction of the heat-up. Wait.
    FIXPID_REACTION_MOVING,

    // No clear movement within timeout_steps. Check that the heater is on and
    // the sensor in its place. If both are, use a longer timeout_steps.
    FIXPID_REACTION_NO_MOVEMENT,

    // The reading went the other way: set `reverse`, or clear it.
    FIXPID_REACTION_WRONG_WAY,

    // The reading has reached measurement_stop, or would have: begin colder,
    // let it go further, or use half of output_drive if half the output has
    // half the effect (a relay, an SSR, a PWM, fixpid_tpo).
    FIXPID_REACTION_LIMIT,

    // The reading came to rest before the slope was clear: use fixpid_autotune,
    // or a faster rate.
    FIXPID_REACTION_LEVELS_OFF,

    // 32768 steps of the heat-up: sample more slowly.
    FIXPID_REACTION_TOO_SLOW
};

// Tuning rules. Use PID with SAFE first: it is as calm as PI and responds to a
// load more quickly. Use PI if the derivative would work on noise.
enum fixpid_reaction_rule { FIXPID_REACTION_PI, FIXPID_REACTION_PID };

// robustness_q4, 8..64: a larger one makes a calmer loop, as in
// fixpid_autotune. QUICK has a third more gain than SAFE: do not use it if the
// load may change during the experiment. CALM has two thirds of the gain of
// SAFE, for a process that changes much.
#define FIXPID_REACTION_QUICK 8u
#define FIXPID_REACTION_SAFE 16u
#define FIXPID_REACTION_CALM 32u

struct fixpid_reaction_config {
    // The output before and after: off, or the output that keeps the reading at
    // rest.
    int16_t output_rest;

    // The output of the heat-up, not output_rest: full, or less if full goes
    // too far.
    int16_t output_drive;

    // The reading that must not be reached, in the direction of the heat-up;
    // more than 16384 counts from the start count as 16384. If it lies in the
    // other direction, as when it was forgotten, the experiment ends as LIMIT
    // before any output.
    int16_t measurement_stop;

    // Longest wait for a clear movement in steps, 1..32767; it may last a
    // quarter longer. 0 means 1000.
    uint16_t timeout_steps;

    // The reading falls when the output rises (cooling), like `reverse` of
    // fixpid_pid.
    bool reverse;
};

// The process that the experiment found, for fixpid_guard and for rules of your
// own: for a short time it is an integrator. Times are in steps.
struct fixpid_reaction_process {
    uint32_t slope_q24; // counts per step for one count of the output, x 2^24
    uint32_t dead_q4;   // the delay x 16, with a margin for noise and the hold
    uint16_t noise_q4;  // standard deviation of the noise x 16
};

// This is private, and open only so that the application can allocate it: 40
// bytes.
struct fixpid_reaction {
    int16_t output_rest;
    int16_t output_drive;
    int16_t stop; // mirrored, like every reading, where the heat-up leads down
    uint16_t timeout_steps;
    uint8_t state;   // a status, or private while it heats
    uint8_t blocks;  // in the record
    uint8_t doubled; // how often: a block is of 2^doubled steps
    uint8_t scale;   // the record is in 2^-scale counts; and the mirror's bit
    uint16_t left;   // steps of this block, or of listening
    int16_t start;   // the first reading
    int16_t base;    // the mean above it before the heat-up, x 16
    uint16_t band;   // of the noise, peak to peak
    uint32_t sum;    // of this block
    uint16_t record[8];
};

// Starts the experiment. An output_drive equal to output_rest and a
// timeout_steps above 32767 are refused: the result is false, the status
// FIXPID_REACTION_REFUSED and the output 0, until a good init. An all-zero
// object is such an experiment.
bool fixpid_reaction_init(FIXPID_DATA struct fixpid_reaction *self,
                          const struct fixpid_reaction_config *config);

// Starts it again with the same configuration; a refused one stays refused.
void fixpid_reaction_reset(FIXPID_DATA struct fixpid_reaction *self);

// One step in the controller's place; returns output_drive while it heats, and
// output_rest before that and once the experiment is over.
int16_t fixpid_reaction_step(FIXPID_DATA struct fixpid_reaction *self,
                             int16_t measurement);

// One of enum fixpid_reaction_state.
uint8_t fixpid_reaction_status(FIXPID_DATA const struct fixpid_reaction *self);

// How far it is, 0..100: up to 8 while it measures the noise, 98 at a clear
// movement, 100 when it is over.
uint8_t fixpid_reaction_progress(
    FIXPID_DATA const struct fixpid_reaction *self);

// What the experiment found. False, and nothing written, unless the status is
// FIXPID_REACTION_DONE. Slow: it divides.
bool fixpid_reaction_model(FIXPID_DATA const struct fixpid_reaction *self,
                           struct fixpid_reaction_process *process);

// Gains by a rule of enum fixpid_reaction_rule. Call it as often and with as
// many rules as you like. With the slope u of output_drive in counts per step,
// its height h in counts, the output's change d, and the robustness r,
//   PI   kp = d / H, ki = kp / (3 C) per step, where
//   PID  kp = 5/4 d / H, ki = kp / (2 C), kd = kp C / 8, and
//        H = 19/256 (r + 18) h, C = H / u, which are 2.5 h and 2.5 delays at
//        SAFE;
// the derivative's filter lags at most a quarter of its time or two steps.
// False, and nothing written, if the status is not FIXPID_REACTION_DONE, for
// another rule or robustness, or if a gain is out of its range: if kp, ki or kd
// is too large, measure more finely or use a smaller output; if ki is below
// 8 / 2^24, sample more slowly. Slow: it divides.
bool fixpid_reaction_result(FIXPID_DATA const struct fixpid_reaction *self,
                            uint8_t rule, uint8_t robustness_q4,
                            struct fixpid_pid_gains *gains);

// Object mode, for firmware with one experiment: compile the application and
// fixpid_reaction*.c with -DFIXPID_REACTION_OBJECT=name, and define that object
// at file scope, not static. Calls stay as they are; the pointer is ignored.
// FIXPID_REACTION_PLACE may put it at an address. Sources that disagree about
// the object or its place do not link.
#ifdef FIXPID_REACTION_OBJECT
extern FIXPID_DATA struct fixpid_reaction FIXPID_REACTION_PLACE
    FIXPID_REACTION_OBJECT;
#endif

FIXPID_C_END

#endif
