// SPDX-License-Identifier: MIT
// What the sources of fixpid_pid share: how they reach the controller, and its
// private bits.
#include "fixpid_pid.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_PID_SELF
#define VALID_SELF FIXPID_PID_VALID_SELF

#ifndef FIXPID_PID_PRIVATE_H
#define FIXPID_PID_PRIVATE_H
#include <limits.h>

// SDCC reaches the operands of its assembly for a PIC18 in places that are
// fixpid_pid's own.
#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_pid_pic18.h"
#else
#include "../common/fixpid_signed.h"
#endif

#define WEIGHT_ONE 256u // the setpoint weight b = 1

// The output limits of a refused controller are equal.
#define REFUSED (SELF.output_min == SELF.output_max)

// The features, as constant conditions. A mask that needs a missing one is 0,
// and the compiler drops the code that tests its bits.
#define FEATURES ((unsigned)FIXPID_PID_FEATURES)
#define HAS_FILTER ((FEATURES & FIXPID_PID_HAS_FILTER) != 0u)
#define HAS_WEIGHT ((FEATURES & FIXPID_PID_HAS_WEIGHT) != 0u)
#define HAS_REVERSE ((FEATURES & FIXPID_PID_HAS_REVERSE) != 0u)
#define HAS_DERIVATIVE_ON_ERROR                                                \
    ((FEATURES & FIXPID_PID_HAS_DERIVATIVE_ON_ERROR) != 0u)
#define HAS_FEEDFORWARD ((FEATURES & FIXPID_PID_HAS_FEEDFORWARD) != 0u)
#define HAS_MANUAL ((FEATURES & FIXPID_PID_HAS_MANUAL) != 0u)
#define HAS_COARSE_KI ((FEATURES & FIXPID_PID_HAS_COARSE_KI) != 0u)
#define HAS_TRACK ((FEATURES & FIXPID_PID_HAS_TRACK) != 0u)

// The object's `options` has three bits for what the configuration has three
// bools for and, in the five that are free, the derivative filter and the scale
// of ki: one byte instead of five, and a step asks with one comparison whether
// the PID is plain, which has none of the three. WEIGHTED is set if the
// setpoint weight is below 1. With proportional_on_measurement the weight is 0.
// Each is its feature's bit, moved, and 0 without the feature.
#define REVERSE ((FEATURES & FIXPID_PID_HAS_REVERSE) << 4)              // 0x40
#define ON_ERROR ((FEATURES & FIXPID_PID_HAS_DERIVATIVE_ON_ERROR) << 2) // 0x20
#define WEIGHTED ((FEATURES & FIXPID_PID_HAS_WEIGHT) << 2)              // 0x08

// Bits of `status` under which `integral` holds the output to return instead of
// an integral.
#define HELD (HAS_MANUAL ? (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL) : 0u)

#define DERIVATIVE_MAX INT32_C(0x3F000000) // 2^30 - 2^24

// `previous` before the first step: with 32 bits the value itself marks it.
#define NO_PREVIOUS ((int)((UINT_MAX > 65535u) ? INT32_C(0x7FFF7FFF) : 0))

// The largest number of counts that 16 bits can hold, in 1/256.
#define COUNTS_MAX_Q8 INT32_C(0x7FFFFF)

#endif
