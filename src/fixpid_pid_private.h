// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid share: how they reach the controller, and its
// private bits.
#include "fixpid_pid.h"

#undef OBJECT
#ifdef FIXPID_PID_OBJECT
#define OBJECT FIXPID_PID_OBJECT
#endif
#include "fixpid_self.h"

#ifndef FIXPID_PID_PRIVATE_H
#define FIXPID_PID_PRIVATE_H
#include "fixpid_pid_arith.h"

// The output limits of a refused controller are equal.
#define REFUSED (SELF.output_min == SELF.output_max)

// Whether steps remember their output.
#define HAS_TRACK ((FIXPID_PID_FEATURES & FIXPID_PID_HAS_TRACK) != 0u)

// Bits of `status` under which `integral` holds the output to return instead of
// an integral.
#define HELD (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

// The largest number of counts that 16 bits can hold, in 1/256.
#define COUNTS_MAX_Q8 INT32_C(0x7FFFFF)

#endif
