/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_an937: the PID controller of Microchip's application note AN937,
// "Implementing a PID Controller Using a PIC18 MCU".
//
//   output = (kp * error + ki * accumulated + kd * delta) / 16   (Equation 4)
//
// error is setpoint - measurement, any int16_t; the note works in -4000..4000.
// Gains are Q4.4: 16 means 1.0, 255 means 15.9375. The sum is limited to a
// 24-bit magnitude and divided by 16 toward zero: -1048575..1048575.
//
// Two rates. Call fixpid_an937_tick once per timer tick; the tick sets the rate
// of I and D (the note's motor: 1 ms). Call fixpid_an937_step as often as there
// is a fresh error: P follows every step, while I and D move with the first
// step after a tick and keep their values between ticks.
//
// Any number of controllers work side by side. Functions of one controller must
// not interrupt each other, except that fixpid_an937_tick may interrupt all of
// them where the compiler's code is re-entrant: fixpid.h says where it is not.
//
// docs/migrating.md lists where the firmware that Microchip shipped with the
// note differs: in the sign of delta, in an error of 0, and in when it takes
// the first delta.
#ifndef FIXPID_AN937_H
#define FIXPID_AN937_H
#include <stdbool.h>
#include <stdint.h>

FIXPID_C_BEGIN

// Converts a real gain to Q4.4 at compile time: FIXPID_AN937_GAIN(6.0) is 96.
// It rounds to the nearest 1/16; a constant outside 0..15.9375 (after rounding)
// does not compile. No floating-point code is generated.
#define FIXPID_AN937_GAIN(gain)                                                \
    FIXPID_CAST(uint8_t, FIXPID_FOLDED(FIXPID_REAL(gain) * 16.0) +             \
                             FIXPID_CHECKED(                                   \
                                 0, (FIXPID_REAL(gain) >= 0.0) &&              \
                                        ((FIXPID_REAL(gain) * 16.0) < 255.5)))

struct fixpid_an937_config {
    uint8_t kp_q4; // proportional gain x 16; the note's motor: 96
    uint8_t ki_q4; // integral gain x 16, per tick; 80, later 144
    uint8_t kd_q4; // derivative gain x 16, per derivative sample; 16

    // Anti-windup: the accumulated error stays within +-this. 1..65535, in
    // error counts times ticks; the note's value is 4000.
    uint16_t accumulated_error_limit;

    // Ticks per derivative sample, the note's derivative counter. 1..255; the
    // note's motor samples every 4 ms: 4.
    uint8_t derivative_period_ticks;
};

// This is private, like everything down to FIXPID_AN937_SUM_SATURATED, and open
// only so that the application can allocate it. It is a signed number of 17
// bits, in two's complement or in sign-magnitude, as suits the chip.
union fixpid_an937_number {
    int32_t value;
    struct {
        uint16_t magnitude;
        uint8_t negative;
    } parts;
};

struct fixpid_an937 {
    union fixpid_an937_number error;             // AN937 error
    union fixpid_an937_number accumulated_error; // AN937 a_error
    union fixpid_an937_number delta;             // AN937 d_error
    uint8_t kp_q4;
    uint8_t derivative_period_ticks;
    uint16_t accumulated_error_limit; // 0: refused, gains are 0
    uint8_t ki_q4;
    uint8_t derivative_countdown;
    uint16_t previous_error; // AN937 p_error, in offset binary
    uint8_t kd_q4;
    volatile uint8_t tick_pending;
    volatile uint8_t tick_overrun;
    uint8_t step_flags;
};

// Bits of fixpid_an937_flags. The first two are about the last step: a value
// lay beyond its limit and was limited. The overrun stays until it is cleared.
#define FIXPID_AN937_SUM_SATURATED 0x01u
#define FIXPID_AN937_ACCUMULATED_ERROR_LIMITED 0x02u
#define FIXPID_AN937_TICK_OVERRUN 0x04u // a tick came before the last was used

// Bits of fixpid_an937_stat1 (the note's Register 1, pid_stat1) and of
// fixpid_an937_stat2 (Register 2, pid_stat2). A sign bit is 1 for positive
// and for zero. The note's bit 5, `mag`, belongs to its sign-magnitude
// routines and is always 0 here.
#define FIXPID_AN937_PID_SIGN 0x80u   // the 24-bit sum, before the division
#define FIXPID_AN937_D_ERR_SIGN 0x40u // the derivative term
#define FIXPID_AN937_P_ERR_SIGN 0x10u // the error of the last derivative sample
#define FIXPID_AN937_A_ERR_SIGN 0x08u // the accumulated error
#define FIXPID_AN937_ERR_SIGN 0x04u   // the error
#define FIXPID_AN937_A_ERR_ZERO 0x02u
#define FIXPID_AN937_ERR_ZERO 0x01u
#define FIXPID_AN937_D_ERR_Z 0x04u // stat2: delta is zero

// Starts from rest: no accumulated error, no pending tick, and the first tick
// takes a derivative sample. A limit or a period of 0 is refused: the result is
// false. Until a good init the controller then outputs 0 on every step, and its
// setters return false. An all-zero object is such a controller.
bool fixpid_an937_init(FIXPID_DATA struct fixpid_an937 *self,
                       const struct fixpid_an937_config *config);

// Back to rest, as after init; gains, limit and period stay.
void fixpid_an937_reset(FIXPID_DATA struct fixpid_an937 *self);

// New gains for the next step; every value is legal. The accumulated error
// stays, so the output jumps by the change of ki times the accumulated error.
// False, and nothing changed, if the controller was refused. The gains are
// three numbers, not a struct: a PIC18 takes 42 cycles for them, and would take
// 130 through a pointer.
bool fixpid_an937_set_gains(FIXPID_DATA struct fixpid_an937 *self,
                            uint8_t kp_q4, uint8_t ki_q4, uint8_t kd_q4);

// A new anti-windup limit, 1..65535, used from the next tick on. False, and
// nothing changed, for 0 or if the controller was refused.
bool fixpid_an937_set_accumulated_error_limit(
    FIXPID_DATA struct fixpid_an937 *self, uint16_t limit);

// A new derivative period, 1..255 ticks, used when the running countdown ends.
// False, and nothing changed, for 0 or if the controller was refused.
bool fixpid_an937_set_derivative_period(FIXPID_DATA struct fixpid_an937 *self,
                                        uint8_t ticks);

// Once per timer tick, from the loop that counted it. The next step accumulates
// the error once. If another tick still waits, the loop is too slow: the error
// is not added twice, and FIXPID_AN937_TICK_OVERRUN is set.
void fixpid_an937_tick(FIXPID_DATA struct fixpid_an937 *self);

// One step; returns -1048575..1048575. With a tick pending:
//   accumulated = clamp(accumulated + error, -limit, limit)   (Equation 2)
//   and every derivative period: delta = error - previous     (Equation 3)
// The sum of the three terms beyond +-(2^24 - 1) is limited there and sets
// FIXPID_AN937_SUM_SATURATED; each term fits 24 bits by itself.
int32_t fixpid_an937_step(FIXPID_DATA struct fixpid_an937 *self, int16_t error);

// The note's 8-bit mode: an error of -100..100 % (clamped) counts 40 per
// percent, and the output is divided by 1600 toward zero and limited to
// -100..100 %. So 100 % with kp 1.0 alone gives 2 %, as in the note's program.
// It divides: not for the hot path.
int8_t fixpid_an937_step_percent(FIXPID_DATA struct fixpid_an937 *self,
                                 int8_t error_percent);

// The terms of Equations 1 to 3 with their signs, before the division by 16:
// within +-16711425. They are products of the last step's values with the
// present gains: read them before the gains change.
int32_t fixpid_an937_proportional(FIXPID_DATA const struct fixpid_an937 *self);
int32_t fixpid_an937_integral(FIXPID_DATA const struct fixpid_an937 *self);
int32_t fixpid_an937_derivative(FIXPID_DATA const struct fixpid_an937 *self);

// AN937 a_error, within +-accumulated_error_limit. A new limit takes effect
// with the next tick.
int32_t fixpid_an937_accumulated_error(
    FIXPID_DATA const struct fixpid_an937 *self);

// The note's two status registers, bit by bit as above.
uint8_t fixpid_an937_stat1(FIXPID_DATA const struct fixpid_an937 *self);
uint8_t fixpid_an937_stat2(FIXPID_DATA const struct fixpid_an937 *self);

// What was limited and whether ticks were lost; clear_flags sets all to 0.
uint8_t fixpid_an937_flags(FIXPID_DATA const struct fixpid_an937 *self);
void fixpid_an937_clear_flags(FIXPID_DATA struct fixpid_an937 *self);

// Object mode, for firmware with one controller: compile the application and
// fixpid_an937*.c with -DFIXPID_AN937_OBJECT=name, and define that object at
// file scope, not static. Calls stay as they are; the pointer is ignored.
// Sources that disagree about the object or its place do not link.
//
// Addresses for SDCC, if the application has the room: in a PIC18's access RAM
// a step is a seventh faster. Compile the application and fixpid_an937*.c with
//   -DFIXPID_AN937_PLACE='__at(0x20)'          the object, 24 bytes
//   -DFIXPID_AN937_SIGNALS_PLACE='__at(0x38)'  what a step works on, 2 bytes
// or one of them, and define the object as `FIXPID_DATA struct fixpid_an937
// FIXPID_AN937_PLACE name;`. At 0x48 or below it also has faster products. What
// a step works on can also be placed in pointer mode.
#ifdef FIXPID_AN937_OBJECT
extern FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE FIXPID_AN937_OBJECT;
#endif

FIXPID_C_END

#endif
