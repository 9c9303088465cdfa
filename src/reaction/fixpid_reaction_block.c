// SPDX-License-Identifier: MIT
// What few steps do: the heat-up begins, a block ends, the record is halved.
#include "fixpid_reaction.h"

#include "fixpid_reaction_private.h"

#define SCALE_MAX 4u
#define DOUBLED_MAX 12u
#define FEWEST_BLOCKS 6u // of two steps or more, that tell a slope
#define GROWING_BLOCKS 5u

void fixpid_reaction_begin(FIXPID_DATA struct fixpid_reaction *self)
{
    const uint16_t band =
        (uint16_t)(SELF.record[HIGHEST] - SELF.record[LOWEST]);
    const int16_t risen =
        (int16_t)((uint16_t)SELF.base - SELF.record[FIRST_HALF]);

    SELF.band = band;
    SELF.left = 1;
    SELF.state = HEATING;
    if (risen > (int16_t)(band + (uint16_t)(band << 2) + 16u)) {
        SELF.state = FIXPID_REACTION_MOVING;
    } else if (fixpid_reaction_reach(self) == 0) {
        SELF.state = FIXPID_REACTION_LIMIT;
    } else {
        while (fixpid_reaction_origin(self) <= (REACH_MAX / 2u)) {
            if ((SELF.scale & SCALE) >= SCALE_MAX) {
                break;
            }
            SELF.scale++;
        }
    }
}

void fixpid_reaction_halve(FIXPID_DATA struct fixpid_reaction *self)
{
    uint8_t i;

    for (i = 0; i < (BLOCKS / 2u); i++) {
        const uint16_t a = SELF.record[(uint8_t)(i << 1)];
        const uint16_t b = SELF.record[(uint8_t)((i << 1) + 1u)];

        // (a + b) >> 1 in 16 bits
        SELF.record[i] = (uint16_t)((a & b) + ((a ^ b) >> 1));
    }
    SELF.blocks = BLOCKS / 2u;
    SELF.doubled++;
    SELF.left = (uint16_t)(SELF.left << 1);
}

struct rises {
uint16_t last, before, steepest, need;
};
// The rises in two blocks.
static void measure(FIXPID_DATA const struct fixpid_reaction *self, struct rises *r)
{
    FIXPID_DATA const uint16_t *block = SELF.record;
    uint16_t last = 0;
    uint16_t steepest = 0;
    uint16_t before = 0;
    uint8_t left;

    for (left = SELF.blocks; left > 2; left--) {
        last = fixpid_reaction_excess(block[2], block[0]);
        if (last > steepest) {
            steepest = last;
        }
        if (left > 4u) { before = steepest; }
        block++;
    }
    r->last=last;
    r->before=before;
    r->steepest=steepest;
}

static uint8_t judge(FIXPID_DATA const struct fixpid_reaction *self, uint16_t newest)
{
    const uint16_t origin = fixpid_reaction_origin(self);
    const uint16_t need = fixpid_reaction_needed(self);
    const uint16_t risen = fixpid_reaction_excess(newest, origin);
    const uint8_t blocks = SELF.blocks;
    struct rises r;
    uint16_t fallen = fixpid_reaction_excess(origin, newest);
    
    if (fallen > (origin >> 2)) {
        if (fallen > need) {
            return FIXPID_REACTION_WRONG_WAY;
        }
    }
    measure(self, &r);
    if (blocks >= 6u) {
        if (SELF.doubled != 0u) {
            if (r.last <= (r.steepest >> 1)) {
                if ((risen >> 1) >= need) {
                    return FIXPID_REACTION_LEVELS_OFF;
                }
            } else if (r.steepest >= need) {
                if (r.last <= (uint16_t)(r.before + (r.before >> 3))) {
                    if (fixpid_reaction_excess(newest, SELF.record[(uint8_t)(blocks - 2u) & (BLOCKS - 1u)]) > (r.steepest >> 2)) {
                        return FIXPID_REACTION_DONE;
                    }
                }
            }
        }
    }
    {uint16_t coming = r.steepest >> 4;
    if (blocks >= 5u) {
        coming = (uint16_t)(coming + (fixpid_reaction_excess(r.last, r.before) >> 4));
    }
    if ((uint16_t)(coming * (uint8_t)(blocks + 1u)) >= (origin >> 3)) {
        return FIXPID_REACTION_LIMIT;
    }
    }
    if (SELF.doubled >= DOUBLED_MAX) {
        if (blocks >= BLOCKS) {
            return FIXPID_REACTION_TOO_SLOW;
        }
    }
    if ((risen >> 1) < need) {
        if ((uint16_t)(SELF.left * blocks) >= SELF.timeout_steps) {
            return FIXPID_REACTION_NO_MOVEMENT;
        }
    }
    return HEATING;
}

void fixpid_reaction_end_block(FIXPID_DATA struct fixpid_reaction *self)
{
    uint32_t sum = SELF.sum;
    uint16_t left = 1;
    uint8_t places;

    for (places = SELF.doubled & DOUBLED; places != 0u; places--) {
        sum >>= 1;
        left = (uint16_t)(left << 1);
    }
    SELF.left = left;
    SELF.record[SELF.blocks & (BLOCKS - 1u)] = (uint16_t)sum;
    SELF.sum = 0;
    SELF.blocks++;
    SELF.state = judge(self, (uint16_t)sum);
}
