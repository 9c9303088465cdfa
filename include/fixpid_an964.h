// SPDX-License-Identifier: MIT
// fixpid_an964: the PID controller of Microchip's application note AN964,
// "Software PID Control of an Inverted Pendulum Using the PIC16F684", in the
// 10-bit form of the note's C program.
//
//   output = kp * (error + I + D) / 1024             (Equation 6, second form)
//
// error is a difference of 10-bit conversions and is limited to -1023..1023.
// I is ki times the sum of the errors, D is kd times E(n) - E(n-3)
// (Equation 8). Call fixpid_an964_step 256 times a second: the note's scaling
// contains that rate. kp multiplies all three terms, so it can follow a falling
// supply voltage without moving the controller's zeros.
//
// Any number of controllers work side by side. Functions of one controller must
// not interrupt each other.
//
// Departures from the program that Microchip shipped with the note:
// 1. Full error: the program keeps the error in a signed char, which wraps
//    beyond 127.
// 2. Exact products: the program's 16-bit products wrap above ki = 280 and
//    kd = 273.
// 3. Lower clamp: Figure 6 prints the derivative term's as `> -120`; it is
//    `< -120`.
// 4. Duty bits: the program sets the two low duty bits with XOR where AND was
//    meant; through port_drive every duty count reaches the bridge.
#ifndef FIXPID_AN964_H
#define FIXPID_AN964_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid.h"

FIXPID_C_BEGIN

// Anti-windup: the sum of errors stays within 1 - limit .. limit, as in the
// note's program. 1..30000.
#ifndef FIXPID_AN964_SUM_LIMIT
#define FIXPID_AN964_SUM_LIMIT 30000
#endif
#if FIXPID_AN964_SUM_LIMIT < 1 || FIXPID_AN964_SUM_LIMIT > 30000
#error "FIXPID_AN964_SUM_LIMIT: 1..30000"
#endif

// Limits both E(n) - E(n-3) and the derivative term. 1..255.
#ifndef FIXPID_AN964_TERM_LIMIT
#define FIXPID_AN964_TERM_LIMIT 120
#endif
#if FIXPID_AN964_TERM_LIMIT < 1 || FIXPID_AN964_TERM_LIMIT > 255
#error "FIXPID_AN964_TERM_LIMIT: 1..255"
#endif

// Limits the output. 1..1023.
#ifndef FIXPID_AN964_OUTPUT_LIMIT
#define FIXPID_AN964_OUTPUT_LIMIT 1000
#endif
#if FIXPID_AN964_OUTPUT_LIMIT < 1 || FIXPID_AN964_OUTPUT_LIMIT > 1023
#error "FIXPID_AN964_OUTPUT_LIMIT: 1..1023"
#endif

// As read from three potentiometers by a 10-bit converter: each 0..1023.
struct fixpid_an964_gains {
    uint16_t kp; // 1024 would be 1.0, on all three terms
    uint16_t ki; // 16 adds (sum of errors) / 256
    uint16_t kd; // 32 adds E(n) - E(n-3)
};

// Private: open only so that the application can allocate it.
struct fixpid_an964 {
    struct fixpid_an964_gains gains;
    int16_t sum;
    int16_t error[3]; // AN964 en0, en1, en2 after a step, the newest first
    int16_t integral;
    int16_t derivative;
    uint8_t flags;
    uint8_t ready; // 0: refused, kp is 0
};

// Bits of fixpid_an964_flags, of the last step: the value before the limit lay
// beyond it.
#define FIXPID_AN964_SUM_LIMITED 0x01u
#define FIXPID_AN964_OUTPUT_LIMITED 0x02u

// Object mode, for firmware with one controller: compile the application and
// fixpid_an964.c with -DFIXPID_AN964_OBJECT=name, and define that object at
// file scope, not static. Calls stay as they are; the pointer is ignored.
// FIXPID_AN964_PLACE may put it at an address.
#ifdef FIXPID_AN964_OBJECT
#ifndef FIXPID_AN964_PLACE
#define FIXPID_AN964_PLACE
#endif
extern FIXPID_DATA struct fixpid_an964 FIXPID_AN964_PLACE FIXPID_AN964_OBJECT;
#endif

// Starts from rest with these gains. A gain above 1023 is refused: the result
// is false and the controller outputs 0 on every step, and set_gains returns
// false, until a good init. An all-zero object is such a controller.
bool fixpid_an964_init(FIXPID_DATA struct fixpid_an964 *self,
                       const struct fixpid_an964_gains *gains);

// Back to rest, as after init; the gains stay.
void fixpid_an964_reset(FIXPID_DATA struct fixpid_an964 *self);

// New gains for the next step. False, and nothing changed, if one is above 1023
// or the controller was refused.
bool fixpid_an964_set_gains(FIXPID_DATA struct fixpid_an964 *self, uint16_t kp,
                            uint16_t ki, uint16_t kd);

// One step, 256 times a second; any int16_t error. Returns duty counts within
// +-FIXPID_AN964_OUTPUT_LIMIT. With trunc toward zero and floor toward minus
// infinity:
//   e   = clamp(error, -1023, 1023)
//   sum = clamp(sum + e, 1 - SUM_LIMIT, SUM_LIMIT)
//   I   = trunc(trunc(sum / 256) * ki / 16)
//   d   = clamp(e(n) - e(n-3), -TERM_LIMIT, TERM_LIMIT)
//   D   = clamp(floor(d * kd / 32), -TERM_LIMIT, TERM_LIMIT)
//   out = clamp(trunc((e + I + D) * kp / 1024), -OUTPUT_LIMIT, OUTPUT_LIMIT)
int16_t fixpid_an964_step(FIXPID_DATA struct fixpid_an964 *self, int16_t error);

// The terms of the last step, before the product with kp: P (the error) within
// +-1023, I within +-7480, D within +-FIXPID_AN964_TERM_LIMIT.
int16_t fixpid_an964_proportional(FIXPID_DATA struct fixpid_an964 *self);
int16_t fixpid_an964_integral(FIXPID_DATA struct fixpid_an964 *self);
int16_t fixpid_an964_derivative(FIXPID_DATA struct fixpid_an964 *self);

// What the last step limited.
uint8_t fixpid_an964_flags(FIXPID_DATA struct fixpid_an964 *self);

FIXPID_C_END

#endif
