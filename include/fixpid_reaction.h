/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_reaction: gains for fixpid_pid from the first minutes of a heat-up.
//
// For what is heated, cooled or filled and may begin at rest: an oven, a
// boiler, a hot end, a hot plate, a tank. Not for plants that run away by
// themselves, nor where the dead time is longer than half the lag, nor where
// half the output has not half the effect and less than full output is tried
// (a dimmer, an equal-percentage valve): take fixpid_autotune there.
//
// The output goes from one value to another, and the reading's first answer
// tells the gains: the process reaction curve of Ziegler and Nichols (1942).
// The module listens to the noise for 32 steps at output_rest and then puts out
// output_drive, until the reading no longer rises more steeply. The steepest
// slope, carried back to the moment of the change, misses the reading's start
// by some counts: with the slope, these tell the delay. The static gain and
// the lag are not needed, so it ends long before the reading is still. On
// heaters that takes about a minute, and at most 32800 steps.
//
// Call fixpid_reaction_step where the controller's step would be called, at the
// same rate, until the status is no longer FIXPID_REACTION_RUNNING; then the
// controller goes on in the same step:
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
// No fixpid_pid_seed: far below the setpoint the proportional term holds the
// output at its end, so that nothing jumps. A setpoint weight of 1/2 takes most
// of the overshoot away. To hold the reading where it is instead, seed the
// controller with output_rest.
//
// Begin at rest. What still coasts up from before ends as MOVING in most cases,
// but not in all; a reading that falls back does no harm.
//
// An output that is off cannot take back heat that is stored: the reading
// coasts on. Simulated with dead time and lag in all shares, measurement_stop
// is never reached where it is at least four times as far from the start as the
// reading coasts. Nearer, the experiment ends as LIMIT and the reading may pass
// the stop, by as much as it coasts where the stop is nearer than one and a
// half times that. So begin cold, or with a smaller output: it coasts less far.
//
// The reading is kept as means of up to eight blocks; when there are eight,
// each pair becomes one of twice the length. So no time is configured, and
// nothing depends on the rate. The gains belong to it: a step is their unit of
// time. Integers only; a step does not divide. Every measurement is legal, an
// output is output_rest, output_drive or 0, and each experiment ends.
//
// Any number of experiments work side by side. Functions of one experiment must
// not interrupt each other; fixpid.h says on which chips those of two must not.
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
    // than 511 counts, or rose the way of the heat-up. Wait.
    FIXPID_REACTION_MOVING,

    // No clear movement within timeout_steps. Is the heater on, and the sensor
    // in its place? If both are, a longer timeout_steps.
    FIXPID_REACTION_NO_MOVEMENT,

    // The reading went the other way: set `reverse`, or clear it.
    FIXPID_REACTION_WRONG_WAY,

    // The reading is at measurement_stop, or would have got there: begin
    // colder, let it go further, or use half of output_drive, where half the
    // output has half the effect (a relay, an SSR, a PWM, fixpid_tpo).
    FIXPID_REACTION_LIMIT,

    // The reading came to rest before the slope was clear: take
    // fixpid_autotune, or a faster rate.
    FIXPID_REACTION_LEVELS_OFF,

    // 32768 steps of the heat-up: sample more slowly.
    FIXPID_REACTION_TOO_SLOW
};

// Tuning rules. PID with SAFE is the one to use first: it is as calm as PI and
// answers a load more quickly. PI where the derivative would work on noise.
enum fixpid_reaction_rule { FIXPID_REACTION_PI, FIXPID_REACTION_PID };

// robustness_q4, of which 8..64 is legal: a larger one makes a calmer loop, as
// in fixpid_autotune. QUICK has a third more gain than SAFE: not where the load
// may change during the experiment. CALM has two thirds of it, for a process
// that changes much.
#define FIXPID_REACTION_QUICK 8u
#define FIXPID_REACTION_SAFE 16u
#define FIXPID_REACTION_CALM 32u

struct fixpid_reaction_config {
    // The output before and after: off, or what keeps the reading at rest.
    int16_t output_rest;

    // The output of the heat-up, not output_rest: full, or less where full goes
    // too far.
    int16_t output_drive;

    // The reading that must not be reached, on the side to which the heat-up
    // leads; more than 16384 counts from the start count as 16384. On the other
    // side, as where it was forgotten, the experiment ends as LIMIT before any
    // output.
    int16_t measurement_stop;

    // Longest wait for a clear movement in steps, 1..32767; it may last a
    // quarter longer. 0 is 1000.
    uint16_t timeout_steps;

    // The reading falls when the output rises (cooling), like `reverse` of
    // fixpid_pid.
    bool reverse;
};

// The process that the experiment found, for fixpid_guard and for rules of your
// own: for short, it integrates. Times are steps.
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
    uint8_t state;   // a status, or that it heats
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

// Starts the experiment. An output_drive that is output_rest and a
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

// How far it is, 0..100: to 8 while it listens, to 98 at a clear movement, 100
// when it is over.
uint8_t fixpid_reaction_progress(
    FIXPID_DATA const struct fixpid_reaction *self);

// What the experiment found out. False, and nothing written, unless the status
// is FIXPID_REACTION_DONE. Slow: it divides.
bool fixpid_reaction_model(FIXPID_DATA const struct fixpid_reaction *self,
                           struct fixpid_reaction_process *process);

// Gains by a rule of enum fixpid_reaction_rule, as often and by as many rules
// as wanted. With the slope u of output_drive in counts per step, its height h
// in counts, the output's change d, and the robustness r,
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
