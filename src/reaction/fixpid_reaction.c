// SPDX-License-Identifier: MIT
#include "fixpid_reaction.h"

#include "../common/fixpid_bits.h"
#include "fixpid_reaction_private.h"

#define TIMEOUT_MAX 32767u
#define TIMEOUT_USUAL 1000u

// `state` while it runs. Each byte is a status or HEATING.
#define LISTENING ((uint8_t)FIXPID_REACTION_RUNNING)
#define HEATING 9u // and above

#define MIRRORED 0x80u // of `scale`
#define SCALE_MAX 4u

#define LISTEN_STEPS 32u
#define REST_MAX 511
#define BAND_MAX 1022u // so that what is needed has 16 bits
#define REACH_MAX 16384
#define DOUBLED_MAX 12u

// The record while it listens: readings from the start, and the sum of the
// first 16.
#define LOWEST 0u
#define HIGHEST 1u
#define FIRST_HALF 2u

// a - b within -32767..32767
static int16_t apart(int16_t a, int16_t b)
{
    const uint16_t difference = (uint16_t)((uint16_t)a - (uint16_t)b);

    if (a >= b) {
        return (difference > 32767u) ? 32767 : (int16_t)difference;
    }
    return (difference <= 32768u) ? -32767 : (int16_t)difference;
}

// How far it may go from the start: 0..16384.
static int16_t reach(FIXPID_DATA const struct fixpid_reaction *self)
{
    const int16_t far = apart(SELF.stop, SELF.start);

    if (far > REACH_MAX) {
        return REACH_MAX;
    }
    return (far < 0) ? 0 : far;
}

uint16_t fixpid_reaction_scaled(FIXPID_DATA const struct fixpid_reaction *self,
                                uint16_t counts)
{
    uint16_t result = counts;
    uint8_t places;

    for (places = SELF.scale & SCALE; places != 0u; places--) {
        result = (uint16_t)(result << 1);
    }
    return result;
}

uint16_t fixpid_reaction_origin(FIXPID_DATA const struct fixpid_reaction *self)
{
    return fixpid_reaction_scaled(self, (uint16_t)reach(self));
}

// What is a clear movement: four bands, at most 4 * 1023 * 2^4 < 2^16.
static uint16_t needed(FIXPID_DATA const struct fixpid_reaction *self)
{
    return fixpid_reaction_scaled(self, (uint16_t)((SELF.band + 1u) << 2));
}

static uint16_t newest_block(FIXPID_DATA const struct fixpid_reaction *self)
{
    return SELF.record[(uint8_t)(SELF.blocks - 1u) & (BLOCKS - 1u)];
}

static uint16_t excess(uint16_t a, uint16_t b)
{
    return (a > b) ? (uint16_t)(a - b) : 0u;
}

void fixpid_reaction_measure(FIXPID_DATA const struct fixpid_reaction *self,
                             struct fixpid_reaction_rises *rises)
{
    uint16_t rise = 0;
    uint16_t steepest = 0;
    uint16_t before = 0;
    uint16_t older = 0;
    uint8_t place;

    rises->place = 2;
    for (place = 2; place < BLOCKS; place++) {
        if (place >= SELF.blocks) {
            break;
        }
        rise = excess(SELF.record[place], SELF.record[place - 2u]);
        before = older;
        older = steepest;
        if (rise > steepest) {
            steepest = rise;
            rises->place = place;
        }
    }
    rises->last = rise;
    rises->steepest = steepest;
    rises->before = before;
}

// Whether the slope grows no more but the reading still does: a sensor that
// has just stuck does not.
static bool is_steady(FIXPID_DATA const struct fixpid_reaction *self,
                      const struct fixpid_reaction_rises *rises, uint16_t need)
{
    uint16_t step;

    if (rises->steepest < need) {
        return false;
    }
    if (rises->last > (uint16_t)(rises->before + (rises->before >> 3))) {
        return false;
    }
    step = excess(newest_block(self),
                  SELF.record[(uint8_t)(SELF.blocks - 2u) & (BLOCKS - 1u)]);
    return step > (rises->steepest >> 2);
}

// Whether the reading, with what has gone in, would get to the stop: one block
// more is allowed for, with the growth of the slope.
static bool comes_too_far(FIXPID_DATA const struct fixpid_reaction *self,
                          const struct fixpid_reaction_rises *rises)
{
    uint16_t coming = rises->steepest >> 4;

    if (SELF.blocks >= 5u) {
        coming = (uint16_t)(coming + (excess(rises->last, rises->before) >> 4));
    }
    // at most 4096 * 9
    coming = (uint16_t)(coming * (uint8_t)(SELF.blocks + 1u));
    return coming >= (fixpid_reaction_origin(self) >> 3);
}

static bool is_late(FIXPID_DATA const struct fixpid_reaction *self)
{
    return ((uint32_t)SELF.blocks << (SELF.doubled & DOUBLED)) >=
           SELF.timeout_steps;
}

// What the slopes say. pre: six blocks of two steps or more
static uint8_t judge_slope(FIXPID_DATA const struct fixpid_reaction *self,
                           const struct fixpid_reaction_rises *rises,
                           uint16_t risen, uint16_t need)
{
    if (rises->last <= (rises->steepest >> 1)) {
        if ((risen >> 1) >= need) {
            return FIXPID_REACTION_LEVELS_OFF;
        }
    } else if (is_steady(self, rises, need)) {
        return FIXPID_REACTION_DONE;
    } else {
        // It grows still.
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

static uint8_t judge(FIXPID_DATA const struct fixpid_reaction *self)
{
    const uint16_t origin = fixpid_reaction_origin(self);
    const uint16_t need = needed(self);
    const uint16_t newest = newest_block(self);
    const uint16_t risen = excess(newest, origin);
    struct fixpid_reaction_rises rises;

    if (is_wrong_way(excess(origin, newest), origin, need)) {
        return FIXPID_REACTION_WRONG_WAY;
    }
    fixpid_reaction_measure(self, &rises);
    if (SELF.blocks >= 6u) {
        if (SELF.doubled != 0u) {
            const uint8_t verdict = judge_slope(self, &rises, risen, need);

            if (verdict != HEATING) {
                return verdict;
            }
        }
    }
    if (comes_too_far(self, &rises)) {
        return FIXPID_REACTION_LIMIT;
    }
    if (SELF.doubled >= DOUBLED_MAX) {
        if (SELF.blocks >= BLOCKS) {
            return FIXPID_REACTION_TOO_SLOW;
        }
    }
    if ((risen >> 1) < need) {
        if (is_late(self)) {
            return FIXPID_REACTION_NO_MOVEMENT;
        }
    }
    return HEATING;
}

// It has listened.
static void begin_heating(FIXPID_DATA struct fixpid_reaction *self)
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
    } else if (reach(self) == 0) {
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

static void listen(FIXPID_DATA struct fixpid_reaction *self, int16_t reading)
{
    int16_t x;

    if (SELF.left >= LISTEN_STEPS) {
        SELF.start = reading;
    }
    x = apart(reading, SELF.start);
    if ((uint16_t)(x + REST_MAX) > (uint16_t)(2 * REST_MAX)) {
        SELF.state = FIXPID_REACTION_MOVING;
        return;
    }
    if (x < (int16_t)SELF.record[LOWEST]) {
        SELF.record[LOWEST] = (uint16_t)x;
    }
    if (x > (int16_t)SELF.record[HIGHEST]) {
        SELF.record[HIGHEST] = (uint16_t)x;
    }
    if (SELF.left > (LISTEN_STEPS / 2u)) {
        SELF.record[FIRST_HALF] =
            (uint16_t)(SELF.record[FIRST_HALF] + (uint16_t)x);
    } else {
        SELF.base = (int16_t)((uint16_t)SELF.base + (uint16_t)x);
    }
    SELF.left--;
    if (SELF.left == 0u) {
        begin_heating(self);
    }
}

// Half as many blocks, of twice the length.
static void halve(FIXPID_DATA struct fixpid_reaction *self)
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

static void end_block(FIXPID_DATA struct fixpid_reaction *self)
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
    SELF.state = judge(self);
}

static void heat(FIXPID_DATA struct fixpid_reaction *self, int16_t reading)
{
    const int16_t far = reach(self);
    int16_t x = apart(reading, SELF.start);

    // Not in the step that judges, which is long enough.
    if (SELF.blocks >= BLOCKS) {
        halve(self);
    }
    if (x >= far) {
        SELF.state = FIXPID_REACTION_LIMIT;
        return;
    }
    if (x < -far) {
        x = (int16_t)-far;
    }
    if (SELF.band == 0u) {
        // A sensor without noise: its first jump is its quantum.
        const uint16_t jump = (uint16_t)((x < 0) ? -x : x);

        SELF.band = (jump < BAND_MAX) ? jump : BAND_MAX;
    }
    // at most 2^15; the sum at most 2^27
    SELF.sum += fixpid_reaction_scaled(self, (uint16_t)(x + far));
    SELF.left--;
    if (SELF.left == 0u) {
        end_block(self);
    }
}

bool fixpid_reaction_init(FIXPID_DATA struct fixpid_reaction *self,
                          const struct fixpid_reaction_config *config)
{
    bool leads_up;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    leads_up = config->output_drive > config->output_rest;
    SELF.output_rest = config->output_rest;
    SELF.output_drive = config->output_drive;
    SELF.stop = config->measurement_stop;
    SELF.timeout_steps = config->timeout_steps;
    if (SELF.timeout_steps == 0u) {
        SELF.timeout_steps = TIMEOUT_USUAL;
    }
    SELF.scale = 0;
    if (leads_up == config->reverse) {
        SELF.scale = MIRRORED;
        SELF.stop = complement(SELF.stop);
    }
    SELF.state = LISTENING;
    if (SELF.output_drive == SELF.output_rest) {
        SELF.state = FIXPID_REACTION_REFUSED;
    }
    if (SELF.timeout_steps > TIMEOUT_MAX) {
        SELF.state = FIXPID_REACTION_REFUSED;
    }
    fixpid_reaction_reset(self);
    return SELF.state != FIXPID_REACTION_REFUSED;
}

void fixpid_reaction_reset(FIXPID_DATA struct fixpid_reaction *self)
{
    uint8_t i;

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.state != FIXPID_REACTION_REFUSED) {
        SELF.state = LISTENING;
    }
    SELF.blocks = 0;
    SELF.doubled = 0;
    SELF.scale &= MIRRORED;
    SELF.left = LISTEN_STEPS;
    SELF.start = 0;
    SELF.base = 0;
    SELF.band = 0;
    SELF.sum = 0;
    for (i = 0; i < BLOCKS; i++) {
        SELF.record[i] = 0;
    }
}

int16_t fixpid_reaction_step(FIXPID_DATA struct fixpid_reaction *self,
                             int16_t measurement)
{
    int16_t reading = measurement;

    FIXPID_ASSERT(VALID_SELF);
    if ((SELF.scale & MIRRORED) != 0u) {
        reading = complement(measurement);
    }
    if (SELF.state == LISTENING) {
        listen(self, reading);
    } else if (SELF.state >= HEATING) {
        heat(self, reading);
    } else {
        // It is over.
    }
    if (SELF.state >= HEATING) {
        return SELF.output_drive;
    }
    if (SELF.state == FIXPID_REACTION_REFUSED) {
        return 0;
    }
    return SELF.output_rest;
}

uint8_t fixpid_reaction_status(FIXPID_DATA const struct fixpid_reaction *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (SELF.state >= HEATING) ? (uint8_t)FIXPID_REACTION_RUNNING
                                   : SELF.state;
}

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
    uint16_t risen;

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.state == LISTENING) {
        return (uint8_t)((LISTEN_STEPS - SELF.left) >> 2);
    }
    if (SELF.state < HEATING) {
        return 100;
    }
    need = needed(self);
    risen = excess(newest_block(self), fixpid_reaction_origin(self)) >> 1;
    if (risen >= need) {
        return 98;
    }
    return (uint8_t)(8u + ninetieths(risen, need));
}
