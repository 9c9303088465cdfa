// SPDX-License-Identifier: MIT
#include "calls_reaction.h"

int16_t reaction_ordinary_step(FIXPID_DATA struct fixpid_reaction *self,
                               int16_t measurement)
{
    return fixpid_reaction_step(self, measurement);
}

int16_t reaction_block_step(FIXPID_DATA struct fixpid_reaction *self,
                            int16_t measurement)
{
    return fixpid_reaction_step(self, measurement);
}

int16_t reaction_halving_step(FIXPID_DATA struct fixpid_reaction *self,
                              int16_t measurement)
{
    return fixpid_reaction_step(self, measurement);
}

int16_t reaction_last_listening_step(FIXPID_DATA struct fixpid_reaction *self,
                                     int16_t measurement)
{
    return fixpid_reaction_step(self, measurement);
}
