// SPDX-License-Identifier: MIT
// What the two sources of fixpid_pid share: how they address the controller,
// and its private bits.
#ifndef FIXPID_PID_SELF_H
#define FIXPID_PID_SELF_H
#include "fixpid_pid.h"
#include "fixpid_pid_arith.h"

#ifdef FIXPID_PID_OBJECT
#define SELF FIXPID_PID_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

// A refused controller has no room between its output limits.
#define REFUSED (SELF.output_min == SELF.output_max)

// Of status: `integral` is the output held.
#define HELD (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

// What 16 bits of counts can hold, in 1/256.
#define COUNTS_MAX_Q8 INT32_C(0x7FFFFF)

#endif
