// SPDX-License-Identifier: MIT
// The margins of a scene's loop: its plant by tuner_params, and the integers of
// its controller and the dead time by tuner_results, where tuner_run or the
// caller has put them.
#ifndef TUNER_MARGINS_H
#define TUNER_MARGINS_H
#include "identify.h"
#include "loop.h"

void tuner_margins(struct loop_margins *to);

// Ms of the same controller with a plant that was identified, whose drive was
// `full` at the highest output; -1 where that loop is unstable.
double tuner_ms(const struct identify_plant *plant, double full);

// The seconds that matter to the controller: dead time and lags.
double tuner_scale_s(void);

#endif
