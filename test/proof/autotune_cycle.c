// SPDX-License-Identifier: MIT
// What fixpid_autotune does at the end of a cycle, part by part: it is what
// autotune.h says in whole numbers, and where the next relay's centre lies.
#include "autotune.h"

#include "autotune/fixpid_autotune_cycle.c"

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
    assume(sound_relay(&c));
    was = c;
    low = low_output(&c, phase);
    high = high_output(&c, phase);
    claim(fixpid_autotune_level(&c, phase, LOW_SIDE) == low);
    claim(fixpid_autotune_level(&c, phase, HIGH_SIDE) == high);
    claim(fixpid_autotune_span(&c, phase) == high - low);
    claim(high > low);
    claim_same(&c, &was);
}

// The same for the same, and no more is known of it.
uint8_t __CPROVER_uninterpreted_share(uint16_t part, uint16_t whole);

uint8_t share_contract(uint16_t part, uint16_t whole)
{
    pre(part < whole);
    return __CPROVER_uninterpreted_share(part, whole);
}

uint32_t __CPROVER_uninterpreted_amplitude(uint16_t wanted, uint16_t over,
                                           uint16_t relay);

uint32_t amplitude_for_contract(uint16_t wanted, uint16_t over, uint16_t relay)
{
    pre(inside(wanted, 1, 36864));
    pre(inside(over, 2, 65534));
    return __CPROVER_uninterpreted_amplitude(wanted, over, relay);
}

// D * share / 256, to the nearest: at most D, as D * 255 + 128 is below
// 256 (D + 1). This is argued, as a solver is slow at it.
uint16_t __CPROVER_uninterpreted_counts(uint16_t counts, uint8_t part);

uint16_t counts_of_contract(uint16_t counts, uint8_t part)
{
    const uint16_t found = __CPROVER_uninterpreted_counts(counts, part);

    assume(found <= counts);
    return found;
}

// It has switched on both sides.
static bool ready_to_recentre(const struct fixpid_autotune *x)
{
    return legal_config(&x->config) && inside(x->state, IN_FIND, IN_CENTRE) &&
           sound_relay(x) && (x->noise <= 32736u) && inside(x->edge, 1, 6912) &&
           is_deviation(x->highest) && is_deviation(x->lowest) &&
           ((number)x->highest > x->edge) && (x->lowest < -(number)x->edge);
}

// Where the setpoint cuts the overshoot, the output that holds it cuts the
// relay. By contract: share, amplitude_for, counts_of.
void prove_recentre(void)
{
    struct fixpid_autotune defined;
    number low;
    number relay;
    number below;
    number over;
    number wanted;
    uint8_t part;
    number amplitude;

    c = nondet_autotune();
    assume(ready_to_recentre(&c));
    defined = c;
    low = low_output(&c, c.state);
    relay = high_output(&c, c.state) - low;
    below = -(number)c.lowest - c.edge;
    over = (number)c.highest - c.lowest - (2 * (number)c.edge);
    wanted = swing_wanted(&c);
    wanted = (wanted < 2 * (number)c.edge) ? c.edge : (wanted - c.edge);
    part = __CPROVER_uninterpreted_share((uint16_t)below, (uint16_t)over);
    defined.centre = signed16(low + counts_of_contract((uint16_t)relay, part));
    amplitude = lesser(__CPROVER_uninterpreted_amplitude(
                           (uint16_t)wanted, (uint16_t)over, (uint16_t)relay),
                       (number)c.config.output_max - c.config.output_min);
    defined.half = unsigned16(greater(floor_by(amplitude * 85, 8), 2));
    recentre(&c);
    claim_same(&c, &defined);
    claim(inside(over, 2, 65534) && inside(below, 1, over - 1));
    c.state++;
    claim(sound_relay(&c));
}

void recentre_contract(struct fixpid_autotune *self)
{
    pre(ready_to_recentre(self));
    take_part(&centre_part, self, 0);
}

// In the third phase the cycle is in the sums, and has a half at high.
static bool ready_to_compare(const struct fixpid_autotune *x)
{
    return inside(x->state, IN_FIRST, IN_THIRD) &&
           inside(x->config.cycles, 1, 4) && (x->averaged < x->config.cycles) &&
           (x->last_period >= x->elapsed);
}

void prove_alike(void)
{
    const uint16_t before = nondet_uint16();

    c = nondet_autotune();
    assume(ready_to_compare(&c));
    claim(regular(&c, before) == is_alike(&c, before));
}

bool regular_contract(const struct fixpid_autotune *self, uint16_t before)
{
    struct fixpid_autotune same = *self;

    pre(ready_to_compare(self));
    alike_part.after = same;
    take_part(&alike_part, &same, before);
    return alike;
}

// By contract: recentre, regular.
void prove_cycle(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(ready_to_end(&c, deviation));
    defined = c;
    alike_part.open = true;
    end_as_defined(&defined, deviation);
    fixpid_autotune_end_cycle(&c, deviation);
    claim_same(&c, &defined);
    claim(!centre_part.due && !alike_part.due);
}

void prove_lost(void)
{
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(inside(c.state, IN_CENTRE, IN_THIRD));
    assume(sound_relay(&c));
    defined = c;
    lost_as_defined(&defined);
    fixpid_autotune_find_again(&c);
    claim_same(&c, &defined);
}
