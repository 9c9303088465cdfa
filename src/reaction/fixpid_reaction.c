// SPDX-License-Identifier: MIT
#include "fixpid_reaction.h"

#include "../common/fixpid_bits.h"
#include "fixpid_reaction_private.h"

#define TIMEOUT_MAX 32767u
#define TIMEOUT_USUAL 1000u
#define REST_MAX 511
#define MINUS_1 0xFFFFu
#define FIRST_JUMP_MAX 1022u // so that what is needed has 16 bits

// a - b, saturated
static int16_t apart(int16_t a, int16_t b)
{
    const uint16_t from = (uint16_t)b;
    const uint16_t to = (uint16_t)a;
    const uint16_t difference = (uint16_t)(to - from);

    // it has the wrong sign
    if ((((to ^ from) & (to ^ difference)) & FIXPID_SIGN_BIT) != 0u) {
        return (a < 0) ? INT16_MIN : INT16_MAX;
    }
    return (int16_t)difference;
}

int16_t fixpid_reaction_reach(FIXPID_DATA const struct fixpid_reaction *self)
{
    const int16_t far = apart(SELF.stop, SELF.start);

    if (far > REACH_MAX) {
        return REACH_MAX;
    }
    if (far < 0) {
        return 0;
    }
    return far;
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
    return fixpid_reaction_scaled(self, (uint16_t)fixpid_reaction_reach(self));
}

// at most 4 * 1023 * 2^4 < 2^16
uint16_t fixpid_reaction_needed(FIXPID_DATA const struct fixpid_reaction *self)
{
    return fixpid_reaction_scaled(self, (uint16_t)((SELF.band + 1u) << 2));
}

static bool is_at_rest(int16_t x)
{
    if (x > REST_MAX) {
        return false;
    }
    return x >= -REST_MAX;
}

static void listen(FIXPID_DATA struct fixpid_reaction *self, int16_t reading)
{
    int16_t x;

    if (SELF.left >= LISTEN_STEPS) {
        SELF.start = reading;
    }
    x = apart(reading, SELF.start);
    if (!is_at_rest(x)) {
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
        SELF.base = (int16_t)fixpid_add32(SELF.base, x);
    }
    SELF.left = (uint16_t)(SELF.left + MINUS_1);
    if (SELF.left == 0u) {
        fixpid_reaction_begin(self);
    }
}

static void heat(FIXPID_DATA struct fixpid_reaction *self, int16_t reading)
{
    const int16_t far = fixpid_reaction_reach(self);
    int16_t x = apart(reading, SELF.start);
    uint16_t counts;
    int32_t sum;

    // Not in the step that judges, which is long enough.
    if (SELF.blocks >= BLOCKS) {
        fixpid_reaction_halve(self);
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

        SELF.band = (jump < FIRST_JUMP_MAX) ? jump : FIRST_JUMP_MAX;
    }
    counts = (uint16_t)((uint16_t)x + (uint16_t)far); // at most 2^15 scaled
    counts = fixpid_reaction_scaled(self, counts);
    sum = fixpid_add32((int32_t)SELF.sum, (int32_t)counts);
    SELF.sum = (uint32_t)sum;
    SELF.left = (uint16_t)(SELF.left + MINUS_1);
    if (SELF.left == 0u) {
        fixpid_reaction_end_block(self);
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
        SELF.state = STATE_REFUSED;
    }
    if (SELF.timeout_steps > TIMEOUT_MAX) {
        SELF.state = STATE_REFUSED;
    }
    fixpid_reaction_reset(self);
    return SELF.state != STATE_REFUSED;
}

void fixpid_reaction_reset(FIXPID_DATA struct fixpid_reaction *self)
{
    uint8_t i;

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.state != STATE_REFUSED) {
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
    for (i = BLOCKS; i != 0u; i--) {
        SELF.record[i - 1u] = 0;
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
    if (SELF.state == STATE_REFUSED) {
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
