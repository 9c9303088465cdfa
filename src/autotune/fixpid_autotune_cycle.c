// SPDX-License-Identifier: MIT
// The relays of fixpid_autotune, and what the end of a cycle decides.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_private.h"

#define SEEN_MAX 48u
#define SEEN_LOST 8u // losing the swing counts as so many cycles
#define LAST_PERIOD_MIN 10u

// Wide enough for every swing asked for: a swing is at most 65534, and a range
// at most 65535.
#define AMPLITUDE_MAX UINT32_C(131072)

void fixpid_autotune_clear(FIXPID_DATA struct fixpid_autotune_sums *sums)
{
    sums->all = 0;
    sums->on = 0;
    sums->rise = 0;
    sums->steps = 0;
    sums->on_steps = 0;
}

// 3 standard deviations and 1 count: a second difference of noise is 1.95
// standard deviations in the mean. The sum of 32 is at most 32 * 1023 = 32736,
// and with its half 49104.
uint16_t fixpid_autotune_noise_band(
    FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t sum = (uint16_t)(SELF.noise + (SELF.noise >> 1) + 16u);

    return (uint16_t)((sum >> 5) + 1u);
}

// 24 bands, but SDCC would link a multiplication.
uint16_t fixpid_autotune_wanted_swing(
    FIXPID_DATA const struct fixpid_autotune *self, uint16_t noise_band)
{
    const uint16_t eight_bands = (uint16_t)(noise_band << 3);

    if (SELF.config.swing == 0u) {
        return (uint16_t)(eight_bands + eight_bands + eight_bands);
    }
    return SELF.config.swing;
}

// How far a side is from the centre. `half` is at most 21759, so that twice of
// it fits.
static uint16_t reach(FIXPID_DATA const struct fixpid_autotune *self,
                      uint8_t phase, uint8_t side)
{
    const uint8_t wide =
        (phase == PHASE_SECOND) ? (uint8_t)AT_LOW : (uint8_t)AT_HIGH;

    if (phase == PHASE_CENTRE) {
        return (uint16_t)(SELF.half + (SELF.half >> 1));
    }
    if (side == wide) {
        return (uint16_t)(SELF.half << 1);
    }
    return SELF.half;
}

int16_t fixpid_autotune_level(FIXPID_DATA const struct fixpid_autotune *self,
                              uint8_t phase, uint8_t side)
{
    const uint16_t centre = (uint16_t)SELF.centre;
    int16_t end = SELF.config.output_min;
    uint16_t far;

    if (side == AT_HIGH) {
        end = SELF.config.output_max;
    }
    if (phase == PHASE_FIND) {
        return end;
    }
    far = reach(self, phase, side);
    if (side == AT_HIGH) {
        if (far < (uint16_t)((uint16_t)end - centre)) {
            end = (int16_t)(uint16_t)(centre + far);
        }
    } else {
        if (far < (uint16_t)(centre - (uint16_t)end)) {
            end = (int16_t)(uint16_t)(centre - far);
        }
    }
    return end;
}

uint16_t fixpid_autotune_span(FIXPID_DATA const struct fixpid_autotune *self,
                              uint8_t phase)
{
    return (uint16_t)((uint16_t)fixpid_autotune_level(self, phase, AT_HIGH) -
                      (uint16_t)fixpid_autotune_level(self, phase, AT_LOW));
}

void fixpid_autotune_drive(FIXPID_DATA struct fixpid_autotune *self)
{
    SELF.output = fixpid_autotune_level(self, SELF.state, SELF.side);
}

void fixpid_autotune_finish(FIXPID_DATA struct fixpid_autotune *self,
                            uint8_t status)
{
    SELF.state = status;
    SELF.output = SELF.config.output_rest;
}

// floor(256 part / whole), 0..255. pre: part < whole
static uint8_t share(uint16_t part, uint16_t whole)
{
    uint8_t quotient = 0;
    uint16_t rest = part;
    uint8_t bit;

    for (bit = 0; bit < 8u; bit++) {
        const uint16_t missing = (uint16_t)(whole - rest); // above 0

        quotient = (uint8_t)(quotient << 1);
        if (rest >= missing) {
            quotient |= 1u;
            rest = (uint16_t)(rest - missing);
        } else {
            rest = (uint16_t)(rest << 1);
        }
    }
    return quotient;
}

// The relay that would overshoot its hysteresis as far as wanted, where one of
// relay_counts overshoots it by `over`.
static uint32_t amplitude_for(uint16_t wanted_counts, uint16_t over,
                              uint16_t relay_counts)
{
    uint16_t wanted = wanted_counts;
    uint32_t amplitude = relay_counts;

    while (wanted > over) {
        wanted >>= 1; // rounded towards a smaller swing
        amplitude <<= 1;
    }
    if (amplitude > AMPLITUDE_MAX) {
        amplitude = AMPLITUDE_MAX;
    }
    if (wanted < over) {
        amplitude = (amplitude * share(wanted, over)) >> 8;
    }
    return amplitude;
}

// Of both sides: what the hysteresis leaves of the wanted swing, but one
// hysteresis at least, which is at most 6912.
static uint16_t wanted_overshoot(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t wanted =
        fixpid_autotune_wanted_swing(self, fixpid_autotune_noise_band(self));

    if (wanted < (uint16_t)(SELF.edge << 1)) {
        return SELF.edge;
    }
    return (uint16_t)(wanted - SELF.edge);
}

// counts * share / 256, to the nearest: 65535 * 255 + 128 < 2^24
static uint16_t counts_of(uint16_t counts, uint8_t share_q8)
{
    return (uint16_t)((((uint32_t)counts * share_q8) + 128u) >> 8);
}

// What overshoots the hysteresis on each side is in proportion to the drive
// that is left on that side. So where the setpoint cuts the overshoot, the
// output that holds it cuts the relay: true of every lag with every dead time.
// The relay switched on both sides, so that each side overshoots by 1 at least.
static void recentre(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t relay_counts = fixpid_autotune_span(self, SELF.state);
    const uint16_t below =
        (uint16_t)(fixpid_negated((uint16_t)SELF.lowest) - SELF.edge);
    const uint16_t over =
        (uint16_t)((uint16_t)SELF.highest - SELF.edge + below);
    const uint16_t widest = (uint16_t)((uint16_t)SELF.config.output_max -
                                       (uint16_t)SELF.config.output_min);
    uint32_t amplitude =
        amplitude_for(wanted_overshoot(self), over, relay_counts);

    SELF.centre =
        (int16_t)(uint16_t)((uint16_t)fixpid_autotune_level(self, SELF.state,
                                                            AT_LOW) +
                            counts_of(relay_counts, share(below, over)));
    if (amplitude > widest) { // or the two relays would not differ
        amplitude = widest;
    }
    SELF.half = (uint16_t)((amplitude * 85u) >> 8); // a third
    if (SELF.half < 2u) {
        SELF.half = 2;
    }
}

static uint16_t distance(uint16_t a, uint16_t b)
{
    if (a < b) {
        return (uint16_t)(b - a);
    }
    return (uint16_t)(a - b);
}

// The half at high is as long as it was before, within a 32nd of the period:
// the output that holds the setpoint is the same. The sums have this cycle,
// too.
static bool same_load(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t on = (uint16_t)(SELF.last_period - SELF.elapsed);
    const uint32_t others = (uint32_t)SELF.config.cycles + SELF.averaged;
    const uint32_t cycles = others + 1u; // 8 at most
    const uint32_t all = cycles * on;
    const uint32_t sum = SELF.sums[0].on_steps;
    const uint32_t more = (all > sum) ? all : sum;
    const uint32_t less = (all > sum) ? sum : all;
    const uint16_t allowed = (uint16_t)((SELF.last_period >> 5) + 1u);

    return (more - less) <= (others * allowed);
}

// The cycle that ends is like the one before it, or in the last phase like
// those of the first.
static bool regular(FIXPID_DATA const struct fixpid_autotune *self,
                    uint16_t before)
{
    if (SELF.state == PHASE_THIRD) {
        return same_load(self);
    }
    return distance(SELF.last_period, before) <=
           (uint16_t)((SELF.last_period >> 3) + 1u);
}

FIXPID_DATA struct fixpid_autotune_sums *fixpid_autotune_sums_of_phase(
    FIXPID_DATA struct fixpid_autotune *self)
{
    if (SELF.state == PHASE_SECOND) {
        return &SELF.sums[1];
    }
    return &SELF.sums[0];
}

// True if one half is below an eighth of the cycles. So short a half says
// little of the process.
static bool lopsided(FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    const uint16_t least = (uint16_t)(sums->steps >> 3);

    if (sums->on_steps < least) {
        return true;
    }
    return (uint16_t)(sums->steps - sums->on_steps) < least;
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
    if (swing < (uint16_t)((uint16_t)(band << 2) + band)) { // 7680 at most
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

// The last cycles were as long at high as the first, within a 128th of both.
static bool same_sums(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t twice = (uint16_t)(SELF.first_on << 1);

    return distance(SELF.sums[0].on_steps, twice) <=
           (uint16_t)((SELF.sums[0].steps >> 7) + 2u);
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
        recentre(self);
        SELF.averaged = FRESH;
        SELF.state++;
        if (SELF.state == PHASE_FIRST) {
            fixpid_autotune_clear(&SELF.sums[0]);
        }
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

// The relay does not hold the setpoint any more: from the whole range again.
void fixpid_autotune_find_again(FIXPID_DATA struct fixpid_autotune *self)
{
    fixpid_autotune_clear(&SELF.sums[0]);
    SELF.state = PHASE_FIND;
    SELF.averaged = FRESH;
    SELF.period = 0;
    SELF.elapsed = 1;
    SELF.seen = (uint8_t)(SELF.seen + SEEN_LOST);
    fixpid_autotune_drive(self);
}
