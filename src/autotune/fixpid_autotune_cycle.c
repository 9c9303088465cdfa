// SPDX-License-Identifier: MIT
// What the end of a cycle decides in fixpid_autotune, or that there is none.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_private.h"

#define SEEN_MAX 48u
#define SEEN_LOST 4u    // a lost swing counts as so many cycles
#define SEEN_FITTED 20u // no more cycles are spent on a better relay
#define LAST_PERIOD_MIN 10u

void fixpid_autotune_clear(FIXPID_DATA struct fixpid_autotune_sums *sums)
{
    sums->all = 0;
    sums->on = 0;
    sums->rise = 0;
    sums->steps = 0;
    sums->on_steps = 0;
}

void fixpid_autotune_finish(FIXPID_DATA struct fixpid_autotune *self,
                            uint8_t status)
{
    SELF.state = status;
    SELF.output = SELF.config.output_rest;
}

// |a - b| <= by. pre: |a - b| + by < 65536
static bool within(uint16_t a, uint16_t b, uint16_t by)
{
    return (uint16_t)((uint16_t)(a + by) - b) <= (uint16_t)(by << 1);
}

// The relay is much like the one that it was made from, whose centre and half
// these are. The centre has moved by three halves of 21759 at most.
static bool fits(FIXPID_DATA const struct fixpid_autotune *self,
                 uint16_t centre, uint16_t half)
{
    if (SELF.seen >= SEEN_FITTED) {
        return true;
    }
    if (!within((uint16_t)SELF.centre, centre, half)) {
        return false;
    }
    if (SELF.half > (uint16_t)(half << 1)) {
        return false;
    }
    return half <= (uint16_t)(SELF.half << 1);
}

// A relay that fits measures; one that does not makes a better one.
static void next_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t centre = (uint16_t)SELF.centre;
    const uint16_t half = SELF.half;

    fixpid_autotune_fit_relay(self);
    SELF.averaged = FRESH;
    if (SELF.state == PHASE_FIND) {
        SELF.state = PHASE_CENTRE;
        return;
    }
    if (fits(self, centre, half)) {
        SELF.state = PHASE_FIRST;
        fixpid_autotune_clear(&SELF.sums[0]);
    }
}

// The half at high is the same part of the cycle as it was, within a 32nd: the
// output that holds the setpoint is the same. The sums have this cycle, too.
static bool same_load(FIXPID_DATA const struct fixpid_autotune *self)
{
    return fixpid_autotune_same_share(
        (uint16_t)(SELF.last_period - SELF.elapsed), SELF.last_period,
        SELF.sums[0].on_steps, SELF.sums[0].steps,
        (uint16_t)((SELF.last_period >> 5) + 1u));
}

// The cycle that ends is like the one before it, or in the last phase like
// those of the first.
static bool regular(FIXPID_DATA const struct fixpid_autotune *self,
                    uint16_t before)
{
    if (SELF.state == PHASE_THIRD) {
        return same_load(self);
    }
    // a cycle that settles is at most 65534, and one in the sums 32767
    return within(before, SELF.last_period,
                  (uint16_t)((SELF.last_period >> 3) + 1u));
}

FIXPID_DATA struct fixpid_autotune_sums *fixpid_autotune_sums_of_phase(
    FIXPID_DATA struct fixpid_autotune *self)
{
    if (SELF.state == PHASE_SECOND) {
        return &SELF.sums[1];
    }
    return &SELF.sums[0];
}

// True if one half is below an eighth of the cycles. So short a half tells
// little about the process.
static bool lopsided(FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    const uint16_t least = (uint16_t)(sums->steps >> 3);

    return (uint16_t)(sums->on_steps - least) >
           (uint16_t)(sums->steps - (uint16_t)(least << 1));
}

static uint8_t ending(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t swing =
        (uint16_t)((uint16_t)SELF.highest - (uint16_t)SELF.lowest);
    const uint16_t band = fixpid_autotune_noise_band(self);

    if (lopsided(&SELF.sums[0])) {
        return FIXPID_AUTOTUNE_IRREGULAR;
    }
    if (lopsided(&SELF.sums[1])) {
        return FIXPID_AUTOTUNE_IRREGULAR;
    }
    if (SELF.last_period < LAST_PERIOD_MIN) {
        return FIXPID_AUTOTUNE_TOO_FAST;
    }
    if (swing < (uint16_t)(band << 2)) { // 6144 at most
        return FIXPID_AUTOTUNE_TOO_SMALL;
    }
    return FIXPID_AUTOTUNE_DONE;
}

// A cycle unlike the one before may be the first of new ones.
static void start_average_again(FIXPID_DATA struct fixpid_autotune *self)
{
    if (SELF.state == PHASE_THIRD) {
        SELF.state = PHASE_FIRST;
    }
    fixpid_autotune_clear(fixpid_autotune_sums_of_phase(self));
    SELF.averaged = 0;
}

// The last cycles were at high for the same part as the first, within a 64th.
static bool same_sums(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t last = (uint16_t)(SELF.sums[0].steps - SELF.first_steps);

    return fixpid_autotune_same_share(
        (uint16_t)(SELF.sums[0].on_steps - SELF.first_on), last, SELF.first_on,
        SELF.first_steps, (uint16_t)((last >> 6) + 2u));
}

// The cycles of a relay are complete, or one more is averaged.
static void average(FIXPID_DATA struct fixpid_autotune *self)
{
    SELF.averaged++;
    if (SELF.averaged < SELF.config.cycles) {
        return;
    }
    if (SELF.state == PHASE_THIRD) {
        if (same_sums(self)) {
            fixpid_autotune_finish(self, ending(self));
        } else {
            start_average_again(self);
        }
        return;
    }
    if (SELF.state == PHASE_FIRST) {
        SELF.first_on = SELF.sums[0].on_steps;
        SELF.first_steps = SELF.sums[0].steps;
        fixpid_autotune_clear(&SELF.sums[1]);
    }
    SELF.averaged = FRESH;
    SELF.state++; // the third phase goes on with the sums of the first
}

// A cycle is a half at high and the half at low that ends now.
static void end_cycle(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t before = SELF.last_period;

    SELF.last_period = SELF.period;
    SELF.period = 0;
    SELF.seen++;
    if (SELF.seen >= SEEN_MAX) {
        fixpid_autotune_finish(self, FIXPID_AUTOTUNE_IRREGULAR);
    } else if (SELF.averaged == FRESH) {
        SELF.averaged = 0;
    } else if (SELF.state < PHASE_FIRST) {
        next_relay(self);
    } else if (regular(self, before)) {
        average(self);
    } else {
        start_average_again(self);
    }
}

void fixpid_autotune_end_cycle(FIXPID_DATA struct fixpid_autotune *self,
                               int16_t deviation)
{
    end_cycle(self);
    SELF.elapsed = 0;
    if (SELF.state >= PHASE_NOISE) {
        SELF.highest = deviation;
        SELF.lowest = deviation;
        fixpid_autotune_drive(self);
    }
}

void fixpid_autotune_lose_cycle(FIXPID_DATA struct fixpid_autotune *self)
{
    if (SELF.output == fixpid_autotune_level(self, PHASE_FIND, SELF.side)) {
        return; // the setpoint is out of reach, or slow to reach
    }
    SELF.seen = (uint8_t)(SELF.seen + SEEN_LOST);
    if (SELF.seen >= SEEN_MAX) {
        fixpid_autotune_finish(self, FIXPID_AUTOTUNE_IRREGULAR);
        return;
    }
    fixpid_autotune_clear(&SELF.sums[0]);
    SELF.averaged = FRESH;
    SELF.period = 0;
    SELF.elapsed = 1;
    fixpid_autotune_widen_relay(self);
}
