// SPDX-License-Identifier: MIT
// Private to the sources of fixpid_an937: how they reach the controller.
#ifndef FIXPID_AN937_SELF_H
#define FIXPID_AN937_SELF_H
#include "fixpid_an937.h"

#include "fixpid_an937_arith.h"

#ifdef FIXPID_AN937_OBJECT
#define SELF FIXPID_AN937_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

// What the leaves say of the sum stands in the flags as it is.
#if FIXPID_SUM_SATURATED != FIXPID_AN937_SUM_SATURATED
#error "FIXPID_SUM_SATURATED: the flag of fixpid_an937.h"
#endif

#endif
