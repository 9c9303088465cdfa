/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_slew: a value that follows a target at limited speed, for the ramp of
// a setpoint or for an actuator that must not be moved fast.
//
//   value += clamp(target - value, -fall, rise)
//
// Call fixpid_slew_step once per sample period: the module has no clock, so its
// rates are counts per step. Target and result are counts, any int16_t each;
// the value between them has 16 fractional bits, so that a rate may be as slow
// as one count in 65536 steps. Only the result is rounded, to the nearest
// count, half up. Hence
//   - the target is reached exactly and never passed;
//   - a value on its way moves by exactly n times the rate in n steps;
//   - a result differs from the one before by the rate at most, rounded up to
//     whole counts;
//   - a new target, direction or rate counts from the next step on, from the
//     fraction that the value has.
//
// As a ramp, it comes before the controller,
//   output = fixpid_pid_step(&pid, fixpid_slew_step(&ramp, setpoint), y);
// and is seeded with the measurement before the first step and when the loop
// comes back from manual. As an actuator's limit, it comes after the
// controller:
//   valve = fixpid_slew_step(&slew, fixpid_pid_step(&pid, setpoint, y));
//
// Any number of them work side by side. Functions of one must not interrupt
// each other; fixpid.h lists the chips on which those of two must not either.
#ifndef FIXPID_SLEW_H
#define FIXPID_SLEW_H
#include <stdint.h>

FIXPID_C_BEGIN

// No rate limit: the value is at its target after each step. Any rate of 65535
// counts per step (0xFFFF0000) or more has the same effect.
#define FIXPID_SLEW_NO_LIMIT 0xFFFFFFFFu

// A rate from counts per second and steps per second, computed at compile time
// and rounded half up; also in a static initialiser. It takes constants only:
// anything else does not compile (C++98 and tcc cannot tell). Neither does a
// rate below 0, one that would round to 0 without being 0, or one that 32 bits
// do not hold: 65536 counts per step. No floating-point code is generated.
//
// A compiler whose double has 32 bits, such as avr-gcc and XC8, computes the
// rate with 24 bits: of 1000 random rates 149 differed, by at most 1 + rate_q16
// / 2^22. A ramp then ends that much earlier or later; its target is still
// reached exactly. If all chips must have the same bits, write the integer:
// 65536 times the counts per step.
#define FIXPID_SLEW_RATE(counts_per_second, steps_per_second)                  \
    (FIXPID_FOLDED(FIXPID_SLEW_Q16(counts_per_second, steps_per_second)) +     \
     FIXPID_CHECKED(                                                           \
         0, (FIXPID_REAL(counts_per_second) >= 0.0) &&                         \
                (FIXPID_REAL(steps_per_second) > 0.0) &&                       \
                ((!(FIXPID_REAL(counts_per_second) > 0.0)) ||                  \
                 (FIXPID_SLEW_Q16(counts_per_second, steps_per_second) >=      \
                  0.5)) &&                                                     \
                (FIXPID_SLEW_Q16(counts_per_second, steps_per_second) <        \
                 4294967295.5)))
// This is a part of the macro above, and private.
#define FIXPID_SLEW_Q16(counts_per_second, steps_per_second)                   \
    (FIXPID_REAL(counts_per_second) * 65536.0 / FIXPID_REAL(steps_per_second))

// This is private, and open only so that the application can allocate it: 12
// bytes.
struct fixpid_slew {
    int32_t value; // Q16.16
    uint32_t rise_q16;
    uint32_t fall_q16;
};

// The rates upward and downward in counts per step x 65536, any uint32_t each:
// 0 holds the value in that direction. The value is 0, not the first target: an
// actuator starts from rest. An all-zero object holds 0.
void fixpid_slew_init(FIXPID_DATA struct fixpid_slew *self, uint32_t rise_q16,
                      uint32_t fall_q16);

// Back to 0 at once. The rates stay.
void fixpid_slew_reset(FIXPID_DATA struct fixpid_slew *self);

// New rates from the next step on. The value stays.
void fixpid_slew_set_rates(FIXPID_DATA struct fixpid_slew *self,
                           uint32_t rise_q16, uint32_t fall_q16);

// Sets the value at once, in counts: to where the process is, or to where the
// actuator was found.
void fixpid_slew_seed(FIXPID_DATA struct fixpid_slew *self, int16_t value);

// One step toward the target; returns the value to the nearest count.
int16_t fixpid_slew_step(FIXPID_DATA struct fixpid_slew *self, int16_t target);

// The value in 1/65536 of a count.
int32_t fixpid_slew_value(FIXPID_DATA const struct fixpid_slew *self);

FIXPID_C_END

#endif
