// SPDX-License-Identifier: MIT
// What three other libraries' autotuners find on the same benches. Written from
// what they publish, not taken from their sources; each starts at rest at the
// setpoint and is told the output that holds it, which all of them need, with
// what its documentation recommends for the rest.
#ifndef PEERS_H
#define PEERS_H
#include "bench.h"
#include "design.h"

#define PEERS 3
#define PEER_DESIGNS 3 // at most

struct peer {
    const char *name;
    int designs;
    const char *rules[PEER_DESIGNS];
    // Does the experiment, and writes a design for each rule; returns how many
    // steps it took.
    long (*run)(const struct subject *subject, struct design *designs);
};

extern const struct peer peers[PEERS];

#endif
