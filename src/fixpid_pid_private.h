// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid share: how they reach the controller, and its
// private bits.
#ifndef FIXPID_PID_PRIVATE_H
#define FIXPID_PID_PRIVATE_H
#include "fixpid_pid.h"
#include "fixpid_pid_arith.h"

// A refused controller has no room between its output limits.
#define REFUSED (SELF.output_min == SELF.output_max)

// Bits of `status` under which `integral` holds the output to return instead of
// an integral.
#define HELD (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

// What 16 bits of counts can hold, in 1/256.
#define COUNTS_MAX_Q8 INT32_C(0x7FFFFF)

// The check of init and of fixpid_pid_set_integral_limits; false for an illegal
// range, and nothing changed.
bool fixpid_pid_accept_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                       int16_t integral_min,
                                       int16_t integral_max);

#endif

#undef OBJECT
#ifdef FIXPID_PID_OBJECT
#define OBJECT FIXPID_PID_OBJECT
#endif
#include "fixpid_self.h"
