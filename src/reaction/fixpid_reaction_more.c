// SPDX-License-Identifier: MIT
// How far the experiment is. It has its own file because SDCC links whole
// object files.
#include "fixpid_reaction.h"

#include "fixpid_reaction_private.h"

#define WRAPPED 256u // a byte counts modulo it

// floor(90 * part / whole) by 90 additions. pre: part < whole
static uint8_t ninetieths(uint16_t part, uint16_t whole)
{
    const uint16_t rest = (uint16_t)(whole - part);
    uint16_t sum = 0; // 90 * part, modulo whole
    uint8_t wholes = 0;
    uint8_t turn;

    for (turn = 90; turn != 0u; turn--) {
        if (sum >= rest) {
            sum = (uint16_t)(sum - rest);
            wholes++;
        } else {
            sum = (uint16_t)(sum + part);
        }
    }
    return wholes;
}

uint8_t fixpid_reaction_progress(FIXPID_DATA const struct fixpid_reaction *self)
{
    uint16_t need;
    uint16_t newest;
    uint16_t origin;
    uint16_t risen;

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.state == LISTENING) {
        // 8 at most, and 63 of any bytes
        return (uint8_t)(WRAPPED + LISTEN_STEPS - (uint8_t)SELF.left) >> 2;
    }
    if (SELF.state < HEATING) {
        return 100;
    }
    need = fixpid_reaction_needed(self);
    newest = SELF.record[(uint8_t)(SELF.blocks + MOD_BLOCKS) & MOD_BLOCKS];
    origin = fixpid_reaction_origin(self);
    risen = 0;
    if (newest > origin) {
        risen = (uint16_t)(newest - origin) >> 1;
    }
    if (risen >= need) {
        return 98;
    }
    return (uint8_t)(8u + ninetieths(risen, need));
}
