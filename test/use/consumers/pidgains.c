// SPDX-License-Identifier: MIT
// Compiled as C and as C++, with -DGAIN=FIXPID_PID_KP(2.5) and the like.
#include "fixpid_pid.h"

extern const struct fixpid_pid_gains gains;
const struct fixpid_pid_gains gains = {0, GAIN, 0, 0};

// Does not compile where the constant is not the expected one.
#ifdef EXPECTED
extern const unsigned checked;
const unsigned checked = FIXPID_CHECKED(1, (GAIN) == EXPECTED);
#endif
