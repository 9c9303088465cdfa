// SPDX-License-Identifier: MIT
// What fixpid_autotune does at the end of a cycle, part by part: it is what
// autotune.h says in whole numbers, and where the next relay's centre lies.
#include "autotune.h"

#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_relay.c"

// The outputs of every relay, and how far they are apart.
void prove_level(void)
{
    const uint8_t phase = nondet_uint8();
    struct fixpid_autotune was;
    number low;
    number high;

    c = nondet_autotune();
    assume(inside(phase, IN_FIND, IN_THIRD));
    c.state = phase;
    assume(autotune_has_relay(&c));
    was = c;
    low = low_output(&c, phase);
    high = high_output(&c, phase);
    claim(fixpid_autotune_level(&c, phase, LOW_SIDE) == low);
    claim(fixpid_autotune_level(&c, phase, HIGH_SIDE) == high);
    claim(fixpid_autotune_span(&c, phase) == high - low);
    claim(high > low);
    claim_same(&c, &was);
}

// At most 255/256 of the value for a part that is below the whole, and 131072
// for any.
static number most_q8(uint16_t value, uint16_t part, uint16_t whole)
{
    return (part < whole) ? (((number)value << 8) - value)
                          : ((number)131072 << 8);
}

void prove_proportion(void)
{
    const uint16_t value = nondet_uint16();
    const uint16_t part = nondet_uint16();
    const uint16_t whole = nondet_uint16();

    assume(whole >= 1u);
    claim(in_proportion_q8(value, part, whole) <= most_q8(value, part, whole));
}

uint32_t in_proportion_q8_contract(uint16_t value, uint16_t part,
                                   uint16_t whole)
{
    pre(whole >= 1u);
    return (uint32_t)clamp(nondet_uint32(), 0, most_q8(value, part, whole));
}

// The next relay is within the range. By contract: in_proportion_q8.
void prove_recentre(void)
{
    struct fixpid_autotune was;
    number low;
    number high;

    c = nondet_autotune();
    assume(autotune_may_recentre(&c));
    was = c;
    low = low_output(&c, c.state);
    high = high_output(&c, c.state);
    fixpid_autotune_fit_relay(&c);
    claim(inside(c.centre, low, high));
    claim(inside(c.half, 2, 21759));
    claim(inside(c.edge, 1, 30208));
    was.centre = c.centre;
    was.half = c.half;
    was.edge = c.edge;
    claim_same(&c, &was);
}

void fixpid_autotune_fit_relay_contract(struct fixpid_autotune *self)
{
    pre(autotune_may_recentre(self));
    take_part(&centre_part, self, 0);
}

bool fixpid_autotune_same_share_contract(uint16_t on, uint16_t steps,
                                         uint16_t others_on, uint16_t others,
                                         uint16_t allowed)
{
    pre((on <= 32767u) && (steps <= 32767u) && (others_on <= 32767u) &&
        (others <= 32767u) && (allowed <= 1024u));
    return same_share(on, steps, others_on, others, allowed);
}

bool regular_contract(const struct fixpid_autotune *self, uint16_t before)
{
    struct fixpid_autotune same = *self;

    pre(before <= 65534u);
    alike_part.after = same;
    take_part(&alike_part, &same, before);
    return alike;
}

// By contract: fixpid_autotune_fit_relay, fixpid_autotune_same_share, regular.
void prove_cycle(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_may_end(&c, deviation));
    defined = c;
    end_as_defined(&defined, deviation);
    fixpid_autotune_end_cycle(&c, deviation);
    claim_same(&c, &defined);
    claim(!centre_part.due && !alike_part.due);
}

// Of a relay at low and at high.
void prove_lost(void)
{
    for (unsigned side = LOW_SIDE; side <= HIGH_SIDE; side++) {
        struct fixpid_autotune defined;

        c = nondet_autotune();
        c.side = (uint8_t)side;
        assume(autotune_may_lose(&c));
        defined = c;
        lost_as_defined(&defined);
        fixpid_autotune_lose_cycle(&c);
        claim_same(&c, &defined);
    }
}
