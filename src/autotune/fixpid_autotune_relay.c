// SPDX-License-Identifier: MIT
// The relays of fixpid_autotune: their outputs and their hysteresis.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_private.h"

#define HALF_DOUBLED 10000u // a smaller half may be doubled
#define SCALED_MAX UINT32_C(131072)

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

// value * part / whole, to 8 bits of the quotient, x 256. At most 131072 x 256,
// and 131072 is more than any range and any swing.
static uint32_t in_proportion_q8(uint16_t value, uint16_t part_counts,
                                 uint16_t whole)
{
    uint16_t part = part_counts;
    uint32_t scaled = value;

    while (part > whole) { // 16 times at most, also if whole is 0
        part >>= 1;
        scaled <<= 1;
    }
    if (scaled > SCALED_MAX) {
        scaled = SCALED_MAX;
    }
    if (part < whole) {
        return scaled * share(part, whole);
    }
    return scaled << 8;
}

// From there to the most that is allowed it is at most twice that. The products
// are below 2^31.
bool fixpid_autotune_same_share(uint16_t on, uint16_t steps, uint16_t others_on,
                                uint16_t others, uint16_t allowed)
{
    const uint32_t most = (uint32_t)(uint16_t)(on + allowed) * others;
    const uint32_t there = (uint32_t)others_on * steps;

    if (there > most) {
        return false;
    }
    return (most - there) <= ((uint32_t)(uint16_t)(allowed << 1) * others);
}

static uint16_t smaller(uint16_t a, uint16_t b)
{
    return (a < b) ? a : b;
}

static uint16_t range_of(FIXPID_DATA const struct fixpid_autotune *self)
{
    return (uint16_t)((uint16_t)SELF.config.output_max -
                      (uint16_t)SELF.config.output_min);
}

// So much of a relay, but not more than the output range.
static uint16_t within_range(FIXPID_DATA const struct fixpid_autotune *self,
                             uint32_t relay_counts)
{
    const uint16_t range = range_of(self);

    return (relay_counts > range) ? range : (uint16_t)relay_counts;
}

// From the centre to the nearer end of the range.
static uint16_t room(FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t centre = (uint16_t)SELF.centre;

    return smaller((uint16_t)(centre - (uint16_t)SELF.config.output_min),
                   (uint16_t)((uint16_t)SELF.config.output_max - centre));
}

// A third of a relay, which is three halves: 21759 at most.
static uint16_t third(uint16_t relay_counts)
{
    return (uint16_t)(((uint32_t)relay_counts * 85u) >> 8);
}

// Two at least, or the lopsided relays would not differ.
static void set_half(FIXPID_DATA struct fixpid_autotune *self, uint16_t half)
{
    SELF.half = (half < 2u) ? 2u : half;
}

// What the hysteresis leaves of the largest swing, both sides together:
// 0..14245 counts
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
    const uint16_t two_bands = (uint16_t)(band << 1);
    const uint16_t four_bands = (uint16_t)(band << 2);  // 6144 at most
    uint16_t edge = (uint16_t)((overshoot * 59u) >> 8); // 30208 at most

    if (overshoot < four_bands) {
        edge = (uint16_t)((uint16_t)(four_bands + two_bands) -
                          (uint16_t)overshoot);
        edge >>= 1; // above a band
    } else {
        if (edge < band) {
            edge = band;
        }
    }
    SELF.edge = edge;
}

// What overshoots the hysteresis on each side is in proportion to the drive
// that is left on that side. So where the setpoint cuts the overshoot, the
// output that holds it cuts the relay: true of every lag with every dead time.
// The relay switched on both sides, so that each side overshoots by 1 at least,
// and its output still is the low one.
void fixpid_autotune_fit_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    const uint16_t low = (uint16_t)SELF.output;
    const uint16_t relay_counts =
        (uint16_t)((uint16_t)fixpid_autotune_level(self, SELF.state, AT_HIGH) -
                   low);
    const uint16_t below =
        (uint16_t)(fixpid_negated((uint16_t)SELF.lowest) - SELF.edge);
    const uint16_t over =
        (uint16_t)((uint16_t)SELF.highest - SELF.edge + below);
    const uint32_t held_q8 = in_proportion_q8(relay_counts, below, over);
    uint16_t next;

    SELF.centre = (int16_t)(uint16_t)(low + (uint16_t)((held_q8 + 128u) >> 8));
    next = within_range(
        self,
        in_proportion_q8(relay_counts, largest_overshoot(self), over) >> 8);
    set_half(self, smaller(third(next), room(self)));
    next = within_range(self, (uint16_t)(SELF.half + (SELF.half << 1)));
    fit_edge(self, in_proportion_q8(over, next, relay_counts) >> 8);
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
            set_half(self, third((uint16_t)(range_of(self) >> 3)));
        }
    }
    fixpid_autotune_drive(self);
}

void fixpid_autotune_widen_relay(FIXPID_DATA struct fixpid_autotune *self)
{
    if (SELF.half < HALF_DOUBLED) {
        SELF.half = (uint16_t)(SELF.half << 1);
    }
    SELF.centre = SELF.output;
    // one half away: high of the second phase, low of the first
    SELF.centre = fixpid_autotune_level(
        self, (uint8_t)(PHASE_FIRST + SELF.side), SELF.side);
    SELF.state = PHASE_CENTRE;
    fixpid_autotune_drive(self);
}
