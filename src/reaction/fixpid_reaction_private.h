// SPDX-License-Identifier: MIT
// What the sources of fixpid_reaction share: how they reach the experiment, and
// how its record is scaled.
#include "fixpid_reaction.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_REACTION_SELF
#define VALID_SELF FIXPID_REACTION_VALID_SELF

#ifndef FIXPID_REACTION_PRIVATE_H
#define FIXPID_REACTION_PRIVATE_H

// `state` is a status, of which RUNNING stands for LISTENING, or HEATING.
#define STATE_REFUSED ((uint8_t)FIXPID_REACTION_REFUSED)
#define LISTENING ((uint8_t)FIXPID_REACTION_RUNNING)
#define STATE_DONE ((uint8_t)FIXPID_REACTION_DONE)
#define HEATING 9u // and above

#define LISTEN_STEPS 32u
#define REACH_MAX 16384
#define BLOCKS 8u
#define MOD_BLOCKS 7u // of any byte, an index

// Any byte of `doubled` counts as 0..15, and of `scale` as 0..7.
#define DOUBLED 0x0Fu
#define SCALE 0x07u
#define MIRRORED 0x80u // of `scale`

// The record while it listens: readings from the start, and the sum of the
// first 16.
#define LOWEST 0u
#define HIGHEST 1u
#define FIRST_HALF 2u

// These functions have the marks of the others.
#define fixpid_reaction_reach FIXPID_SUFFIXED(reaction, reach)
#define fixpid_reaction_scaled FIXPID_SUFFIXED(reaction, scaled)
#define fixpid_reaction_origin FIXPID_SUFFIXED(reaction, origin)
#define fixpid_reaction_needed FIXPID_SUFFIXED(reaction, needed)
#define fixpid_reaction_begin FIXPID_SUFFIXED(reaction, begin)
#define fixpid_reaction_halve FIXPID_SUFFIXED(reaction, halve)
#define fixpid_reaction_end_block FIXPID_SUFFIXED(reaction, end_block)

// How far it may go from the start: 0..16384.
int16_t fixpid_reaction_reach(FIXPID_DATA const struct fixpid_reaction *self);

// counts * 2^scale
uint16_t fixpid_reaction_scaled(FIXPID_DATA const struct fixpid_reaction *self,
                                uint16_t counts);

// Where the record has the start: 0..16384.
uint16_t fixpid_reaction_origin(FIXPID_DATA const struct fixpid_reaction *self);

// What is a clear movement in the record: four bands.
uint16_t fixpid_reaction_needed(FIXPID_DATA const struct fixpid_reaction *self);

// It has listened.
void fixpid_reaction_begin(FIXPID_DATA struct fixpid_reaction *self);

// Half as many blocks, of twice the length.
void fixpid_reaction_halve(FIXPID_DATA struct fixpid_reaction *self);

void fixpid_reaction_end_block(FIXPID_DATA struct fixpid_reaction *self);

#endif
