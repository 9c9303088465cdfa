// SPDX-License-Identifier: MIT
// fixpid_reaction in the controller's place on a bench: from cold, with the
// setpoint as its stop.
#ifndef HEAT_UP_H
#define HEAT_UP_H
#include "bench.h"
#include "design.h"
#include "fixpid_reaction.h"

struct heat_up {
    struct fixpid_reaction reaction;
    int status;
    long steps;
    double beyond; // the stop, in percent of the scale; below 0: before it
};

// With full output, or this part of it. It goes on until the reading no longer
// coasts. An integrator has no state that is cold, and is held before.
void heat_up_run(struct heat_up *self, const struct subject *subject, int part);

struct design heat_up_design(const struct heat_up *self, int number);

#endif
