// SPDX-License-Identifier: MIT
// The batch of 134 processes that AMIGO's rules were made for: Astrom and
// Hagglund, "Revisiting the Ziegler-Nichols step response method for PID
// control", Journal of Process Control 14 (2004), with their times in their
// own units.
#ifndef FAMILIES_BATCH_H
#define FAMILIES_BATCH_H
#include "chance.h"
#include "linear.h"

void draw_of_batch(struct chance *chance, struct linear *plant);

#endif
