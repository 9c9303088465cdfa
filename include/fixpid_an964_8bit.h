// SPDX-License-Identifier: MIT
// fixpid_an964_8bit: the PID controller of Microchip's application note AN964
// in the form of the note's assembly program: products of 8 x 8 bits only.
//
//   output = kp * (error + I + D) / 32               (Equation 6, second form)
//
// error is the top 8 bits of a 10-bit conversion plus 128, carry ignored: a
// signed byte, half scale is 0. With a quarter of the 10-bit form's error and
// an eighth of its gains every line here is a quarter of the line there, and
// the output is in the same duty counts: both balance the same pendulum with
// the same potentiometer setting. Call the step 256 times a second.
//
// Any number of controllers work side by side. Functions of one controller must
// not interrupt each other.
#ifndef FIXPID_AN964_8BIT_H
#define FIXPID_AN964_8BIT_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid.h"

FIXPID_C_BEGIN

// Anti-windup: the sum of errors stays within +-this. 1..8191.
#ifndef FIXPID_AN964_8BIT_SUM_LIMIT
#define FIXPID_AN964_8BIT_SUM_LIMIT 7500
#endif
#if FIXPID_AN964_8BIT_SUM_LIMIT < 1 || FIXPID_AN964_8BIT_SUM_LIMIT > 8191
#error "FIXPID_AN964_8BIT_SUM_LIMIT: 1..8191"
#endif

// Limits both E(n) - E(n-3) and the derivative term. 1..127.
#ifndef FIXPID_AN964_8BIT_TERM_LIMIT
#define FIXPID_AN964_8BIT_TERM_LIMIT 30
#endif
#if FIXPID_AN964_8BIT_TERM_LIMIT < 1 || FIXPID_AN964_8BIT_TERM_LIMIT > 127
#error "FIXPID_AN964_8BIT_TERM_LIMIT: 1..127"
#endif

// An eighth of what the three potentiometers read in 10 bits: each 0..127.
struct fixpid_an964_8bit_gains {
    uint8_t kp; // 32 is 1.0, on all three terms
    uint8_t ki; // 8 adds (sum of errors) / 64
    uint8_t kd; // 4 adds E(n) - E(n-3)
};

// Private: open only so that the application can allocate it.
struct fixpid_an964_8bit {
    struct fixpid_an964_8bit_gains gains;
    int8_t error[3]; // AN964 en0, en1, en2 after a step, the newest first
    int16_t sum;
    int8_t integral;
    int8_t derivative;
    uint8_t flags;
    uint8_t ready; // 0: refused, kp is 0
};

// Bits of fixpid_an964_8bit_flags, of the last step: the value before the limit
// lay beyond it.
#define FIXPID_AN964_8BIT_SUM_LIMITED 0x01u
#define FIXPID_AN964_8BIT_OUTPUT_LIMITED 0x02u // e + I + D lay beyond +-127

// Object mode, for firmware with one controller: compile the application and
// fixpid_an964_8bit.c with -DFIXPID_AN964_8BIT_OBJECT=name, and define that
// object at file scope, not static. Calls stay as they are; the pointer is
// ignored. FIXPID_AN964_8BIT_PLACE may put it at an address.
#ifdef FIXPID_AN964_8BIT_OBJECT
#ifndef FIXPID_AN964_8BIT_PLACE
#define FIXPID_AN964_8BIT_PLACE
#endif
extern FIXPID_DATA struct fixpid_an964_8bit FIXPID_AN964_8BIT_PLACE
    FIXPID_AN964_8BIT_OBJECT;
#endif

// Starts from rest with these gains. A gain above 127 is refused: the result is
// false and the controller outputs 0 on every step, and set_gains returns
// false, until a good init. An all-zero object is such a controller.
bool fixpid_an964_8bit_init(FIXPID_DATA struct fixpid_an964_8bit *self,
                            const struct fixpid_an964_8bit_gains *gains);

// Back to rest, as after init; the gains stay.
void fixpid_an964_8bit_reset(FIXPID_DATA struct fixpid_an964_8bit *self);

// New gains for the next step. False, and nothing changed, if one is above 127
// or the controller was refused.
bool fixpid_an964_8bit_set_gains(FIXPID_DATA struct fixpid_an964_8bit *self,
                                 uint8_t kp, uint8_t ki, uint8_t kd);

// One step, 256 times a second; any int8_t error. Returns -504..504 duty
// counts. With trunc toward zero and floor toward minus infinity:
//   sum = clamp(sum + e, -SUM_LIMIT, SUM_LIMIT)
//   I   = clamp(trunc(trunc(sum / 64) * ki / 8), -127, 127)
//   d   = clamp(e(n) - e(n-3), -TERM_LIMIT, TERM_LIMIT)
//   D   = clamp(floor(d * kd / 4), -TERM_LIMIT, TERM_LIMIT)
//   S   = clamp(e + I + D, -127, 127)
//   out = trunc(S * kp / 32)
int16_t fixpid_an964_8bit_step(FIXPID_DATA struct fixpid_an964_8bit *self,
                               int8_t error);

// The terms of the last step, before the product with kp: P (the error) within
// -128..127, I within +-127, D within +-FIXPID_AN964_8BIT_TERM_LIMIT.
int16_t fixpid_an964_8bit_proportional(
    FIXPID_DATA struct fixpid_an964_8bit *self);
int16_t fixpid_an964_8bit_integral(FIXPID_DATA struct fixpid_an964_8bit *self);
int16_t fixpid_an964_8bit_derivative(
    FIXPID_DATA struct fixpid_an964_8bit *self);

// What the last step limited.
uint8_t fixpid_an964_8bit_flags(FIXPID_DATA struct fixpid_an964_8bit *self);

FIXPID_C_END

#endif
