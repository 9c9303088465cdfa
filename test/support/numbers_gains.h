// SPDX-License-Identifier: MIT
// Random arguments of fixpid_gains: legal ones, their ends often, and a few
// that are not.
#ifndef NUMBERS_GAINS_H
#define NUMBERS_GAINS_H
#include "fixpid_gains.h"

void numbers_gains_milli(struct fixpid_gains_milli *milli);
uint32_t numbers_gains_rate(void);
uint8_t numbers_gains_filter(void);

#endif
