// SPDX-License-Identifier: MIT
// Random arguments of fixpid_slew, fixpid_tpo and fixpid_gains: legal ones,
// their ends often, and a few that are not. Those of a larger module are a file
// of their own, because SDCC links whole object files.
#ifndef NUMBERS_CONTROL_H
#define NUMBERS_CONTROL_H
#include "fixpid_gains.h"
#include "fixpid_tpo.h"

// A rate of fixpid_slew.
uint32_t numbers_slew_rate(void);

void numbers_tpo_config(struct fixpid_tpo_config *config);

// Duties of that configuration's range, its ends, and others.
int16_t numbers_tpo_duty(int16_t full);

void numbers_gains_milli(struct fixpid_gains_milli *milli);
uint32_t numbers_gains_rate(void);
uint8_t numbers_gains_filter(void);

#endif
