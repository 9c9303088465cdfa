// SPDX-License-Identifier: MIT
// What the sources of fixpid_reaction share: how they reach the experiment, and
// what its record tells.
#include "fixpid_reaction.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_REACTION_SELF
#define VALID_SELF FIXPID_REACTION_VALID_SELF

#ifndef FIXPID_REACTION_PRIVATE_H
#define FIXPID_REACTION_PRIVATE_H

#define BLOCKS 8u

// Any byte of `doubled` counts as 0..15, and of `scale` as 0..7.
#define DOUBLED 0x0Fu
#define SCALE 0x07u

// How much the record rises, each time over two blocks.
struct fixpid_reaction_rises {
    uint16_t last;
    uint16_t steepest;
    uint16_t before; // the steepest without the last two
    uint8_t place;   // where the steepest ends, the first of equals; 2..7
};

// These functions have the marks of the others.
#define fixpid_reaction_scaled FIXPID_SUFFIXED(reaction, scaled)
#define fixpid_reaction_origin FIXPID_SUFFIXED(reaction, origin)
#define fixpid_reaction_measure FIXPID_SUFFIXED(reaction, measure)

// counts * 2^scale
uint16_t fixpid_reaction_scaled(FIXPID_DATA const struct fixpid_reaction *self,
                                uint16_t counts);

// Where the record has the start: 0..16384.
uint16_t fixpid_reaction_origin(FIXPID_DATA const struct fixpid_reaction *self);

void fixpid_reaction_measure(FIXPID_DATA const struct fixpid_reaction *self,
                             struct fixpid_reaction_rises *rises);

#endif
