// SPDX-License-Identifier: MIT
// A random rate of fixpid_slew, its ends often.
#ifndef NUMBERS_SLEW_H
#define NUMBERS_SLEW_H
#include <stdint.h>

uint32_t numbers_slew_rate(void);

#endif
