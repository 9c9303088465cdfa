// SPDX-License-Identifier: MIT
// fixpid_pid: a general-purpose PID controller for those who have no note to
// reproduce: a heater, a valve, a motor.
//
//   output = kp * (b * setpoint - measurement) + I + D + feed-forward
//   I     += ki * (setpoint - measurement)
//   D      = kd * (fall of the measurement since the last step), filtered
//
// limited to [output_min, output_max]. Setpoint and measurement are counts of
// the sensor, the output is counts of the actuator: each any int16_t. Errors
// and differences saturate at the ends of int16_t. Every input gives a defined
// output; the only roundings are those of the output and of the weighted
// setpoint (to the nearest count, half up) and the derivative filter's (less
// than 2^filter / 256 of an output count).
//
// Call fixpid_pid_step once per sample period. The module has no clock: the
// rate is in ki_q24 and kd_q8, which the macros below fold from seconds.
//
// Anti-windup: the integral does not move while the output is limited and the
// error pushes it further; it moves as soon as the error turns, in the same
// step. It can also be given a range of its own.
//
// Any number of controllers work side by side. Functions of one controller must
// not interrupt each other: where an interrupt calls the step, mask it around
// all others.
#ifndef FIXPID_PID_H
#define FIXPID_PID_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid.h"

FIXPID_C_BEGIN

// The ends of the gains' ranges; each range starts at 0.
#define FIXPID_PID_KP_MAX 32767u               // 127.996 * 256
#define FIXPID_PID_KI_MAX UINT32_C(0x7FFF0000) // 127.996 * 2^24
#define FIXPID_PID_KD_MAX 32255u               // 125.996 * 256
#define FIXPID_PID_FILTER_MAX 7u

// Gains from real units, folded at compile time, also in a static initialiser;
// out of range does not compile, and no floating-point code is generated. Each
// is rounded half up. `rate` is in steps per second.
//   kp      output counts per measurement count, 0..127.996
//   ki      output counts per measurement count and second; per step at most
//           127.996, and not below 8 / 2^24 unless it is 0
//   kd      output counts per measurement count per second; times the rate
//           and divided by 2^filter at most 125.996
//   ti, td  reset and derivative time of the standard form, in seconds:
//           ki = kp / ti, kd = kp * td
#define FIXPID_PID_KP(kp)                                                      \
    ((uint16_t)(FIXPID_PID_FOLDED((kp)*256.0) +                                \
                FIXPID_CHECKED(0, ((kp) >= 0) && (((kp)*256.0) < 32767.5))))
#define FIXPID_PID_KI(ki, rate)                                                \
    (FIXPID_PID_FOLDED(FIXPID_PID_KI_Q24(ki, rate)) +                          \
     FIXPID_CHECKED(                                                           \
         0, ((ki) >= 0) && ((rate) > 0) &&                                     \
                (((ki) == 0) || (FIXPID_PID_KI_Q24(ki, rate) >= 8.0)) &&       \
                ((FIXPID_PID_KI_Q24(ki, rate) - 2147418112.0) < 0.5)))
#define FIXPID_PID_KD(kd, rate, filter)                                        \
    ((uint16_t)(FIXPID_PID_FOLDED(FIXPID_PID_KD_Q8(kd, rate, filter)) +        \
                FIXPID_CHECKED(                                                \
                    0, ((kd) >= 0) && ((rate) > 0) && ((filter) >= 0) &&       \
                           ((filter) <= 7) &&                                  \
                           (FIXPID_PID_KD_Q8(kd, rate, filter) < 32255.5))))
#define FIXPID_PID_TI(kp, ti, rate) FIXPID_PID_KI((kp)*1.0 / (ti), rate)
#define FIXPID_PID_TD(kp, td, rate, filter)                                    \
    FIXPID_PID_KD((kp)*1.0 * (td), rate, filter)

// Parts of the macros above.
#define FIXPID_PID_FOLDED(value) ((uint32_t)((value) + 0.5))
#define FIXPID_PID_KI_Q24(ki, rate) ((ki)*16777216.0 / (rate))
#define FIXPID_PID_KD_Q8(kd, rate, filter)                                     \
    ((kd)*256.0 * (rate) / (1u << ((filter)&7u)))

struct fixpid_pid_gains {
    // Integral gain per step x 2^24; 0..0x7FFF0000. Above 32767 it is kept to
    // the nearest of 15 bits: within 0.4 %.
    uint32_t ki_q24;
    uint16_t kp_q8; // proportional gain x 256; 0..32767

    // Derivative gain x rate / 2^derivative_filter x 256; 0..32255.
    uint16_t kd_q8;

    // First-order low-pass of the derivative: 0 none, 1..7 a time constant of
    // about 2^n steps. A filter of n divides kd_q8 by 2^n for the same kd.
    uint8_t derivative_filter;
};

// Bits of options.
#define FIXPID_PID_REVERSE 0x80u // the output falls to raise the measurement
#define FIXPID_PID_DERIVATIVE_ON_ERROR 0x40u // a setpoint step kicks, too

struct fixpid_pid_config {
    struct fixpid_pid_gains gains;

    // The actuator's range, which the anti-windup follows. output_min is below
    // output_max.
    int16_t output_min;
    int16_t output_max;

    // The integral's range, in output counts: -32767 <= min <= max. Where none
    // is wanted: -32767 and 32767.
    int16_t integral_min;
    int16_t integral_max;

    // b x 256: the part of the setpoint that the proportional term sees. 256 is
    // the plain PID; less softens a setpoint step, 0 is P on the measurement
    // only. 0..256.
    uint16_t setpoint_weight_q8;

    uint8_t options; // 0, or the bits above
};

// Private: open only so that the application can allocate it. 32 bytes.
struct fixpid_pid {
    int32_t integral;   // Q16.16; the output held while seeded or manual
    int32_t derivative; // Q24.8
    uint16_t kp;
    uint16_t ki; // 15 bits; how many are fractional: see options
    uint16_t kd;
    int16_t output_min; // equal to output_max: refused, gains are 0
    int16_t output_max;
    int16_t integral_min;
    int16_t integral_max;
    int16_t previous; // what the derivative saw last, unless status says first
    int16_t proportional_error;
    int16_t feedforward;
    uint8_t integral_fraction; // the next eight bits of the integral
    uint8_t setpoint_weight;   // where options say that it is below 256
    uint8_t options;           // with private bits
    uint8_t status;
};

// Bits of fixpid_pid_status. The first two describe the last step: the value
// before the limit lay beyond it.
#define FIXPID_PID_AT_MAX 0x01u
#define FIXPID_PID_AT_MIN 0x02u
#define FIXPID_PID_FIRST 0x10u  // no step since init or reset
#define FIXPID_PID_SEEDED 0x20u // the next step starts from a given output
#define FIXPID_PID_MANUAL 0x40u

// Object mode, for firmware with one controller: compile the application and
// fixpid_pid*.c with -DFIXPID_PID_OBJECT=name, and define that object at file
// scope, not static. Calls stay as they are; the pointer is ignored.
// FIXPID_PID_PLACE may put it at an address (PIC18 access RAM: __at(0x58)).
#ifdef FIXPID_PID_OBJECT
#ifndef FIXPID_PID_PLACE
#define FIXPID_PID_PLACE
#endif
extern FIXPID_DATA struct fixpid_pid FIXPID_PID_PLACE FIXPID_PID_OBJECT;
#endif

// Starts from rest, automatic. A value outside its range above is refused: the
// result is false and the controller outputs 0 on every step, its setters
// return false and a feed-forward is ignored, until a good init. An all-zero
// object is such a controller.
bool fixpid_pid_init(FIXPID_DATA struct fixpid_pid *self,
                     const struct fixpid_pid_config *config);

// Back to rest, as after init: the integral is 0 or what its limits have next
// to it, no derivative, no feed-forward, no sample seen, automatic. Gains and
// limits stay.
void fixpid_pid_reset(FIXPID_DATA struct fixpid_pid *self);

// New gains for the next step; integral, derivative and last input stay, so
// that at error 0 and a standing measurement the output does not move. False,
// and nothing changed, if one is out of range or the controller was refused.
bool fixpid_pid_set_gains(FIXPID_DATA struct fixpid_pid *self,
                          const struct fixpid_pid_gains *gains);

// A new actuator range, at any time. Of the integral, what would only be
// wind-up beyond the new limits is dropped; what a standing proportional,
// derivative or feed-forward term takes away again is kept. An output held by
// hand or by a seed moves inside. False, and nothing changed, if output_min is
// not below output_max or the controller was refused.
bool fixpid_pid_set_limits(FIXPID_DATA struct fixpid_pid *self,
                           int16_t output_min, int16_t output_max);

// A new range of the integral, -32767 <= min <= max; the integral moves inside
// at once, or, while the output is held, when the controller takes over. False,
// and nothing changed, for another range or if the controller was refused.
bool fixpid_pid_set_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                    int16_t integral_min, int16_t integral_max);

// Output counts added to the three terms from the next step on; any int16_t.
void fixpid_pid_set_feedforward(FIXPID_DATA struct fixpid_pid *self,
                                int16_t feedforward);

// By hand: steps return `output`, moved inside the output limits, until
// set_auto. P and D go on following the process, the integral rests. Without a
// bump: pass what the last step returned.
void fixpid_pid_set_manual(FIXPID_DATA struct fixpid_pid *self, int16_t output);

// Back to automatic without a bump: the next step returns the output held (as
// far as the integral's limits allow) and integrates from the one after. No
// effect in automatic.
void fixpid_pid_set_auto(FIXPID_DATA struct fixpid_pid *self);

// The same start from a given output, moved inside the output limits, while in
// automatic: after a reset, or when another controller hands over. In manual it
// moves the output held.
void fixpid_pid_seed(FIXPID_DATA struct fixpid_pid *self, int16_t output);

// One step, once per sample period; returns output_min..output_max. With every
// term in 1/256 of an output count, sat16 the limits of int16_t, floor toward
// minus infinity, and y the measurement, r the setpoint, F the feed-forward:
//   w = floor((b * r + 128) / 256), r itself at b = 256
//   e = sat16(r - y)                    reverse: sat16(y - r)
//   P = kp_q8 * sat16(w - y)            reverse: sat16(y - w)
//   d = sat16(fall of y)                reverse: its rise; option: rise of e
//   D = clamp(D - floor(D / 2^n) + kd_q8 * d, -DMAX, DMAX)
//   I = clamp(I + ki * e, integral_min, integral_max), in 1/2^24
//   U = floor((P + D + 256 F + floor(I / 2^16) + 128) / 256)
// with n the derivative filter and DMAX = 2^30 - 2^24, which only n > 0 can
// reach. d is 0 at the first step. I keeps its old value where U is above
// output_max and e > 0, or U below output_min and e < 0.
int16_t fixpid_pid_step(FIXPID_DATA struct fixpid_pid *self, int16_t setpoint,
                        int16_t measurement);

// The terms of the last step: P and D in 1/256, I in 1/65536 of an output
// count. P is with the present gain: read it before the gains change. While the
// output is held, I reads that output.
int32_t fixpid_pid_proportional(FIXPID_DATA struct fixpid_pid *self);
int32_t fixpid_pid_integral(FIXPID_DATA struct fixpid_pid *self);
int32_t fixpid_pid_derivative(FIXPID_DATA struct fixpid_pid *self);

// The bits above.
uint8_t fixpid_pid_status(FIXPID_DATA struct fixpid_pid *self);

FIXPID_C_END

#endif
