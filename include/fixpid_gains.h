/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_gains: gains of fixpid_pid at run time, from a menu, an EEPROM or a
// bus, in thousandths, and back for a display. 32-bit integers only: no float.
//
// Gains that are known when the program is compiled do not need this:
// FIXPID_PID_GAINS computes them. Both round each gain half up. This module
// does so exactly; the macros compute in double, where an exact half may round
// the other way.
//
// The unit of time is free as long as ki, kd and the rate have the same one. A
// slow oven whose ki is 0.0005 per second, half a thousandth, has 0.030 per
// minute: 30 thousandths, with the rate in thousandths of steps per minute.
//
// The functions have no state and may be called at any time, except, where
// fixpid.h forbids it, from an interrupt that interrupts them. They divide
// numbers of 32 bits: not for the hot path.
#ifndef FIXPID_GAINS_H
#define FIXPID_GAINS_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_pid.h"

FIXPID_C_BEGIN

// The highest rate: half a million steps per second, in thousandths.
#define FIXPID_GAINS_RATE_MAX 500000000u

// Thousandths of the gains in real units, each any uint32_t.
struct fixpid_gains_milli {
    uint32_t kp; // output counts per measurement count
    uint32_t ki; // the same per second
    uint32_t kd; // the same times seconds
};

// Gains for fixpid_pid_init and fixpid_pid_set_gains, which accept them all.
// `rate_milli` is in thousandths of steps per second, 1..FIXPID_GAINS_RATE_MAX;
// `filter` is derivative_filter, 0..7. With q = rate_milli / 1000:
//   kp_q8  = kp / 1000 * 256, half up
//   ki_q24 = ki / 1000 / q * 2^24, half up
//   kd_q8  = kd / 1000 * q / 2^filter * 256, half up
// False, and *gains untouched, if the rate or the filter is out of range, if a
// gain would be above what fixpid_pid takes, or if one that is not 0 would be
// rounded to 0; ki must make 8 / 2^24 per step, as in FIXPID_PID_KI.
bool fixpid_gains_from_milli(struct fixpid_pid_gains *gains,
                             const struct fixpid_gains_milli *milli,
                             uint32_t rate_milli, uint8_t filter);

// The reverse, each rounded half up, for the same rate. It tells what the
// controller has, which is not always what was typed: a kp of 0.100 is kept as
// 26 / 256 and comes back as 0.102. A menu that must show what was typed has to
// keep it. False, and *milli untouched, if the rate or a gain is out of range,
// or if ki or kd would be above 4294967.294.
bool fixpid_gains_to_milli(struct fixpid_gains_milli *milli,
                           const struct fixpid_pid_gains *gains,
                           uint32_t rate_milli);

FIXPID_C_END

#endif
