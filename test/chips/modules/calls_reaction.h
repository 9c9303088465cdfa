// SPDX-License-Identifier: MIT
// A step of fixpid_reaction, by what it does, so that each kind is metered.
#ifndef CALLS_REACTION_H
#define CALLS_REACTION_H
#include "fixpid_reaction.h"

int16_t reaction_ordinary_step(FIXPID_DATA struct fixpid_reaction *self,
                               int16_t measurement);
int16_t reaction_block_step(FIXPID_DATA struct fixpid_reaction *self,
                            int16_t measurement);
int16_t reaction_halving_step(FIXPID_DATA struct fixpid_reaction *self,
                              int16_t measurement);
int16_t reaction_last_listening_step(FIXPID_DATA struct fixpid_reaction *self,
                                     int16_t measurement);

#endif
