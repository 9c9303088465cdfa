// SPDX-License-Identifier: MIT
// Random arguments of fixpid_tpo: legal ones, their ends often, and a few that
// are not.
#ifndef NUMBERS_TPO_H
#define NUMBERS_TPO_H
#include "fixpid_tpo.h"

void numbers_tpo_config(struct fixpid_tpo_config *config);

// Duties of that configuration's range, its ends, and others.
int16_t numbers_tpo_duty(int16_t full);

#endif
