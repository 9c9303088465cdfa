// SPDX-License-Identifier: MIT
// Compiled as C and as C++, with -DRATE=FIXPID_SLEW_RATE(10, 4) and the like.
#include "fixpid_slew.h"

extern const uint32_t rate;
const uint32_t rate = RATE;

// Does not compile where the constant is not the expected one.
#ifdef EXPECTED
extern const unsigned checked;
const unsigned checked = FIXPID_CHECKED(1, (RATE) == EXPECTED);
#endif
