// SPDX-License-Identifier: MIT
// What few steps do: the heat-up begins, a block ends, the record is halved.
#include "fixpid_reaction.h"

#include "fixpid_reaction_private.h"

#define SCALE_MAX 4u
#define DOUBLED_MAX 12u
#define BLOCKS_OF_A_SLOPE 6u // at least, and of two steps or more
#define BLOCKS_OF_A_GROWTH 5u

// How much the record rises, each time over two blocks.
struct rises {
    uint16_t last;
    uint16_t steepest;
    uint16_t before; // the steepest without the last two
};

// a - b, or 0 if b is the larger one
FIXPID_INLINE uint16_t excess(uint16_t a, uint16_t b)
{
    return (a > b) ? (uint16_t)(a - b) : 0u;
}

void fixpid_reaction_begin(FIXPID_DATA struct fixpid_reaction *self)
{
    const uint16_t band =
        (uint16_t)(SELF.record[HIGHEST] - SELF.record[LOWEST]);
    const uint16_t risen =
        (uint16_t)((uint16_t)SELF.base - SELF.record[FIRST_HALF]);
    uint16_t origin = (uint16_t)fixpid_reaction_reach(self);
    uint8_t places;

    SELF.band = band;
    SELF.left = 1;
    SELF.state = HEATING;
    if (origin == 0u) {
        SELF.state = FIXPID_REACTION_LIMIT;
    }
    // Above five bands it would coast on: at most 5 * 1022 + 16.
    if ((int16_t)risen >
        (int16_t)(uint16_t)((uint16_t)(band << 2) + band + 16u)) {
        SELF.state = FIXPID_REACTION_MOVING;
    }
    for (places = SCALE_MAX; places != 0u; places--) {
        origin = (uint16_t)(origin << 1);
        if (origin > (uint16_t)REACH_MAX) {
            break;
        }
        SELF.scale = (uint8_t)(SELF.scale + 1u);
    }
}

void fixpid_reaction_halve(FIXPID_DATA struct fixpid_reaction *self)
{
    FIXPID_DATA const uint16_t *pair = SELF.record;
    FIXPID_DATA uint16_t *mean = SELF.record;
    uint8_t left;

    for (left = BLOCKS / 2u; left != 0u; left--) {
        const uint16_t a = pair[0];
        const uint16_t b = pair[1];

        // (a + b) >> 1 in 16 bits
        mean[0] = (uint16_t)((a & b) + ((a ^ b) >> 1));
        mean++;
        pair++;
        pair++;
    }
    SELF.blocks = BLOCKS / 2u;
    SELF.doubled = (uint8_t)(SELF.doubled + 1u);
    SELF.left = (uint16_t)(SELF.left << 1);
}

// pre: at most 8 blocks
static void measure(FIXPID_DATA const struct fixpid_reaction *self,
                    struct rises *rises)
{
    FIXPID_DATA const uint16_t *block = SELF.record;
    uint16_t rise = 0;
    uint16_t steepest = 0;
    uint16_t before = 0;
    uint8_t left;

    for (left = SELF.blocks; left > 2u; left--) {
        rise = excess(block[2], block[0]);
        if (rise > steepest) {
            steepest = rise;
        }
        if (left > 4u) {
            before = steepest;
        }
        block++;
    }
    rises->last = rise;
    rises->steepest = steepest;
    rises->before = before;
}

// Whether the slope grows no more, but the reading does: a sensor that has just
// stuck does not.
static bool is_steady(const struct rises *rises, uint16_t need, uint16_t step)
{
    if (rises->steepest < need) {
        return false;
    }
    if (rises->last > (uint16_t)(rises->before + (rises->before >> 3))) {
        return false;
    }
    return step > (rises->steepest >> 2);
}

// What the slopes tell. `step` is by how much the newest block is above the one
// before it.
static uint8_t judge_slopes(const struct rises *rises, bool clear,
                            uint16_t need, uint16_t step)
{
    if (rises->last <= (rises->steepest >> 1)) {
        if (clear) {
            return FIXPID_REACTION_LEVELS_OFF;
        }
    } else if (is_steady(rises, need, step)) {
        return FIXPID_REACTION_DONE;
    } else {
        // It still grows.
    }
    return HEATING;
}

// Whether the reading would get to the stop with the heat that has gone in.
// One block more is allowed for, and a slope that grows.
static bool goes_too_far(const struct rises *rises, uint8_t blocks,
                         uint16_t origin)
{
    uint16_t coming = rises->steepest >> 4;

    if (blocks >= BLOCKS_OF_A_GROWTH) {
        coming = (uint16_t)(coming + (excess(rises->last, rises->before) >> 4));
    }
    // at most 4096 * 9
    return (uint16_t)(coming * (uint8_t)(blocks + 1u)) >= (origin >> 3);
}

static uint8_t judge_time(FIXPID_DATA const struct fixpid_reaction *self,
                          bool clear)
{
    if (SELF.doubled >= DOUBLED_MAX) {
        if (SELF.blocks >= BLOCKS) {
            return FIXPID_REACTION_TOO_SLOW;
        }
    }
    if (!clear) {
        // at most 2^15
        if ((uint16_t)(SELF.left * SELF.blocks) >= SELF.timeout_steps) {
            return FIXPID_REACTION_NO_MOVEMENT;
        }
    }
    return HEATING;
}

static bool is_wrong_way(uint16_t fallen, uint16_t origin, uint16_t need)
{
    if (fallen <= (origin >> 2)) {
        return false;
    }
    return fallen > need;
}

static uint8_t judge(FIXPID_DATA const struct fixpid_reaction *self,
                     uint16_t newest)
{
    const uint8_t blocks = SELF.blocks;
    const uint16_t origin = fixpid_reaction_origin(self);
    const uint16_t need = fixpid_reaction_needed(self);
    const bool clear = (excess(newest, origin) >> 1) >= need;
    struct rises rises;

    if (is_wrong_way(excess(origin, newest), origin, need)) {
        return FIXPID_REACTION_WRONG_WAY;
    }
    measure(self, &rises);
    if (blocks >= BLOCKS_OF_A_SLOPE) {
        if (SELF.doubled != 0u) {
            const uint8_t verdict = judge_slopes(
                &rises, clear, need,
                excess(newest,
                       SELF.record[(uint8_t)(blocks - 2u) & MOD_BLOCKS]));

            if (verdict != HEATING) {
                return verdict;
            }
        }
    }
    if (goes_too_far(&rises, blocks, origin)) {
        return FIXPID_REACTION_LIMIT;
    }
    return judge_time(self, clear);
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
    SELF.record[SELF.blocks & MOD_BLOCKS] = (uint16_t)sum;
    SELF.sum = 0;
    SELF.blocks = (uint8_t)(SELF.blocks + 1u);
    SELF.state = judge(self, (uint16_t)sum);
}
