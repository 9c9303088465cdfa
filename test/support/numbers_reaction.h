// SPDX-License-Identifier: MIT
// Random experiments of fixpid_reaction, on plants in 32-bit arithmetic, which
// every chip has.
#ifndef NUMBERS_REACTION_H
#define NUMBERS_REACTION_H
#include <stdint.h>

#include "fixpid_reaction.h"

// The next configuration, and a plant that is at rest: a dead time and two
// lags, or a lag and an integrator. Some are refused.
void numbers_reaction_config(struct fixpid_reaction_config *config);

// The reading of that plant, with noise and steps of a sensor.
int16_t numbers_reaction_measure(void);

// A step of the plant with this output of the experiment.
void numbers_reaction_move(int16_t output);

#endif
