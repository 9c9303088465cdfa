// SPDX-License-Identifier: MIT
// A machine under fixpid_pid with gains of a tuner, and guards beside it: with
// the model of fixpid_autotune, with that of fixpid_reaction, and by the rule
// of fixpid_guard.h for those who have none. The lowest and the highest
// setpoint are their reach. The others have a tuner's model, and one thing that
// differs.
#ifndef LOOP_H
#define LOOP_H
#include "design.h"
#include "families.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "machine.h"
#include "peers.h"

enum guards {
    BY_AUTOTUNE,
    BY_REACTION,
    BY_RULE,
    BANDS_20,   // for what cools slowly, too
    REACH_0,    // 0, 0
    REACH_REST, // from 3 % of the scale above the reading at rest
    GUARDS
};

struct loop {
    const struct subject *subject;
    struct machine machine;
    struct design design;
    struct fixpid_pid pid;
    struct fixpid_guard_config configs[GUARDS];
    struct fixpid_guard guards[GUARDS];
    int alarms[GUARDS]; // raised until now; -1: there is no such guard
    bool heater;        // that printers' firmware could watch, too
    struct peers peers;
    unsigned peer_alarms; // PEER_MARLIN, PEER_KLIPPER until now
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
