// SPDX-License-Identifier: MIT
// Compiled as C and as C++, with -DGAIN=6.0 and the like. The runner reads the
// byte from the object file.
#include "fixpid_an937.h"

extern const uint8_t gain_q4;
const uint8_t gain_q4 = FIXPID_AN937_GAIN(GAIN);
