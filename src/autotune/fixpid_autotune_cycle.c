// SPDX-License-Identifier: MIT
// The relays of fixpid_autotune, and what the end of a cycle decides.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_private.h"

#define SEEN_MAX 48u
#define SEEN_LOST 4u    // a lost swing counts as so many cycles
#define SEEN_FITTED 20u // no more cycles are spent on a better relay
#define LAST_PERIOD_MIN 10u
#define HALF_DOUBLED 10000u // below it, so that three halves fit 16 bits
#define SCALED_MAX UINT32_C(131072)

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

// value * part / whole, rounded to 8 bits. At most 131072, which is twice of
// every range and every swing.
static uint32_t in_proportion(uint16_t value, uint16_t part_counts,
                              uint16_t whole)
{
    uint16_t part = part_counts;
    uint32_t scaled = value;

    while (part > whole) { // at most 16 times, also if whole is 0
        part >>= 1;
        scaled <<= 1;
    }
    if (scaled > SCALED_MAX) {
        scaled = SCALED_MAX;
    }
    if (part < whole) {
        scaled = (scaled * share(part, whole)) >> 8;
    }
    return scaled;
}

static uint16_t range_of(FIXPID_DATA const struct fixpid_autotune *self)
{
    return (uint16_t)((uint16_t)SELF.config.output_max -
                      (uint16_t)SELF.config.output_min);
}

// From the centre to the nearer end of the range.
static uint16_t room(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t down =
        (uint16_t)((uint16_t)SELF.centre - (uint16_t)SELF.config.output_min);
    const uint16_t up =
        (uint16_t)((uint16_t)SELF.config.output_max - (uint16_t)SELF.centre);

    return (down < up) ? down : up;
}

// Of a relay of three halves: at most 21759.
static uint16_t half_of(uint16_t relay_counts)
{
    return (uint16_t)(((uint32_t)relay_counts * 85u) >> 8);
}

static void set_half(FIXPID_DATA struct fixpid_autotune *self, uint16_t half)
{
    SELF.half = (half < 2u) ? 2u : half;
}

// What the hysteresis leaves of the largest swing, counts: 0..14245
static uint16_t largest_overshoot(
    FIXPID_DATA const struct fixpid_autotune *self)
{
    uint16_t swing = SELF.config.swing;
    uint16_t eighth;

    if (swing == 0u) {
        swing = (uint16_t)((uint16_t)SELF.config.measurement_max -
                           (uint16_t)SELF.config.measurement_min);
        swing >>= 3;
    }
    eighth = (uint16_t)(swing >> 3);
    return (uint16_t)(swing - eighth - (eighth >> 1));
}

// The hysteresis for a relay that overshoots it by so much, both sides
// together: 3/13 of that, which is 3/16 of the whole swing. But what the noise
// asks for at least, and enough for a swing of six times that.
static void fit_edge(FIXPID_DATA struct fixpid_autotune *self,
                     uint32_t overshoot)
{
    const uint16_t band = fixpid_autotune_noise_band(self);
    const uint16_t four_bands = (uint16_t)(band << 2);  // 6144 at most
    uint16_t edge = (uint16_t)((overshoot * 59u) >> 8); // 30208 at most

    if (overshoot < four_bands) {
        edge = (uint16_t)((uint16_t)(four_bands + (band << 1)) -
                          (uint16_t)overshoot);
        edge >>= 1;
    } else if (edge < band) {
        edge = band;
    }
    SELF.edge = edge;
}

// What overshoots the hysteresis on each side is in proportion to the drive
// that is left on that side. So where the setpoint cuts the overshoot, the
// output that holds it cuts the relay: true of every lag with every dead time.
// The relay switched on both sides, so that each side overshoots by 1 at least.
// The output still is the low one of the cycle that ends. The next relay is as
// large as the swing and the range allow.
static void recentre(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t low = (uint16_t)SELF.output;
    const uint16_t relay_counts =
        (uint16_t)((uint16_t)fixpid_autotune_level(self, SELF.state, AT_HIGH) -
                   low);
    const uint16_t below =
        (uint16_t)(fixpid_negated((uint16_t)SELF.lowest) - SELF.edge);
    const uint16_t over =
        (uint16_t)((uint16_t)SELF.highest - SELF.edge + below);
    const uint16_t range = range_of(self);
    // to the nearest: 65535 * 255 + 128 < 2^24
    const uint32_t held_q8 =
        ((uint32_t)relay_counts * share(below, over)) + 128u;
    uint32_t next = in_proportion(relay_counts, largest_overshoot(self), over);
    uint16_t half;

    SELF.centre = (int16_t)(uint16_t)(low + (uint16_t)(held_q8 >> 8));
    if (next > range) {
        next = range;
    }
    half = half_of((uint16_t)next);
    if (half > room(self)) {
        half = room(self);
    }
    set_half(self, half);
    half = (uint16_t)(SELF.half + (uint16_t)(SELF.half << 1));
    if (half > range) {
        half = range;
    }
    fit_edge(self, in_proportion(over, half, relay_counts));
}

// The relay is much like the one that it was made from, whose centre and half
// these are. The centre has moved by three halves at most.
static bool fits(FIXPID_DATA const struct fixpid_autotune *self,
                 uint16_t centre, uint16_t half)
{
    const uint16_t twice = (uint16_t)(half << 1);

    if ((uint16_t)((uint16_t)SELF.centre - centre + half) > twice) {
        return false;
    }
    if (SELF.half > twice) {
        return false;
    }
    return half <= (uint16_t)(SELF.half << 1);
}

// A relay that fits measures; one that does not is the start of a better one.
static void next_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t centre = (uint16_t)SELF.centre;
    const uint16_t half = SELF.half;

    recentre(self);
    SELF.averaged = FRESH;
    if (SELF.state == PHASE_FIND) {
        SELF.state = PHASE_CENTRE;
    } else if ((SELF.seen >= SEEN_FITTED) || fits(self, centre, half)) {
        SELF.state = PHASE_FIRST;
        fixpid_autotune_clear(&SELF.sums[0]);
    }
}

// on / steps is others_on / others, within `allowed` of these steps. Each
// number is at most 32767, and `allowed` 1024.
static bool same_share(uint16_t on, uint16_t steps, uint16_t others_on,
                       uint16_t others, uint16_t allowed)
{
    const uint32_t within = (uint32_t)allowed * others;
    const uint32_t apart =
        ((uint32_t)on * others) - ((uint32_t)others_on * steps);

    return (apart + within) <= (within << 1);
}

// The half at high is the same part of the cycle as it was, within a 32nd: the
// output that holds the setpoint is the same. The sums have this cycle, too.
static bool same_load(FIXPID_DATA const struct fixpid_autotune *self)
{
    return same_share((uint16_t)(SELF.last_period - SELF.elapsed),
                      SELF.last_period, SELF.sums[0].on_steps,
                      SELF.sums[0].steps,
                      (uint16_t)((SELF.last_period >> 5) + 1u));
}

static uint16_t distance(uint16_t a, uint16_t b)
{
    if (a < b) {
        return (uint16_t)(b - a);
    }
    return (uint16_t)(a - b);
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

    return same_share((uint16_t)(SELF.sums[0].on_steps - SELF.first_on), last,
                      SELF.first_on, SELF.first_steps,
                      (uint16_t)((last >> 6) + 2u));
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

// A process at rest near the setpoint is held by the output at rest, so that a
// small relay about that is enough. Otherwise the whole range finds the output.
void fixpid_autotune_start_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t band = fixpid_autotune_noise_band(self);
    const uint16_t eight_bands = (uint16_t)(band << 3);
    const uint16_t off =
        (uint16_t)((SELF.highest < 0) ? -SELF.highest : SELF.highest);

    SELF.edge = band;
    SELF.centre = SELF.config.output_rest;
    SELF.state = PHASE_FIND;
    if (off < (uint16_t)(eight_bands + eight_bands + eight_bands)) {
        if (room(self) != 0u) {
            SELF.state = PHASE_CENTRE;
            set_half(self, half_of((uint16_t)(range_of(self) >> 3)));
        }
    }
    fixpid_autotune_drive(self);
}

// The output that holds the setpoint lies beyond the present one: the centre
// moves there and half of a relay of twice the size further.
void fixpid_autotune_widen_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint8_t side = SELF.side;

    if (SELF.output == fixpid_autotune_level(self, PHASE_FIND, side)) {
        return; // the setpoint is out of reach, or slow to reach
    }
    SELF.seen = (uint8_t)(SELF.seen + SEEN_LOST);
    if (SELF.seen >= SEEN_MAX) {
        fixpid_autotune_finish(self, FIXPID_AUTOTUNE_IRREGULAR);
        return;
    }
    if (SELF.half < HALF_DOUBLED) {
        SELF.half = (uint16_t)(SELF.half << 1);
    }
    SELF.centre = SELF.output;
    // one half away: high of the second phase, low of the first
    SELF.centre =
        fixpid_autotune_level(self, (uint8_t)(PHASE_FIRST + side), side);
    fixpid_autotune_clear(&SELF.sums[0]);
    SELF.state = PHASE_CENTRE;
    SELF.averaged = FRESH;
    SELF.period = 0;
    SELF.elapsed = 1;
    fixpid_autotune_drive(self);
}
