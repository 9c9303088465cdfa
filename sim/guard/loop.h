// SPDX-License-Identifier: MIT
// A machine under fixpid_pid with gains of a tuner, and guards beside it: with
// the model of fixpid_autotune, with that of fixpid_reaction, and by the rule
// of fixpid_guard.h for those who have none.
#ifndef LOOP_H
#define LOOP_H
#include "design.h"
#include "families.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "machine.h"

enum guards { BY_AUTOTUNE, BY_REACTION, BY_RULE, GUARDS };

struct loop {
    const struct subject *subject;
    struct machine machine;
    struct design design;
    struct fixpid_pid pid;
    struct fixpid_guard_config configs[GUARDS];
    struct fixpid_guard guards[GUARDS];
    int alarms[GUARDS]; // raised until now; -1: there is no such guard
    struct chance chance;
    double patience_share; // of what the rules say
    double low, high;      // the setpoints that it must hold
    double setpoint;
};

// Tunes and starts it, cold or at rest at its own setpoint, with that share of
// the patience. False if there are no gains for it.
bool loop_start(struct loop *self, const struct subject *subject, bool at_rest,
                double patience_share);

// What the guards and the controller make of a reading; the output.
int16_t loop_step(struct loop *self, int16_t reading);

#endif
