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

// floor(256 part / whole), from what is left of 256 part: its bits, the highest
// first.
void prove_share(void)
{
    const uint16_t part = nondet_uint16();
    const uint16_t whole = nondet_uint16();
    number quotient;

    assume(part < whole);
    quotient = share(part, whole);
    claim(
        inside(((number)part << 8) - (quotient * whole), 0, (number)whole - 1));
}

// The same for the same, and no more is known of it.
uint8_t __CPROVER_uninterpreted_share(uint16_t part, uint16_t whole);

uint8_t share_contract(uint16_t part, uint16_t whole)
{
    pre(part < whole);
    return __CPROVER_uninterpreted_share(part, whole);
}

// The relay is doubled as often as the wanted overshoot is halved, until it is
// at most the one seen; then by the share that it is of it.
static number amplitude_of(number wanted, number over, number relay)
{
    number amplitude = 131072;
    number times = 0;

    while (floor_by(wanted, (unsigned)times) > over) {
        times++;
    }
    amplitude = lesser(relay << times, amplitude);
    wanted = floor_by(wanted, (unsigned)times);
    if (wanted == over) {
        return amplitude;
    }
    return floor_by(amplitude * __CPROVER_uninterpreted_share((uint16_t)wanted,
                                                              (uint16_t)over),
                    8);
}

// By contract: share.
void prove_amplitude(void)
{
    const uint16_t wanted = nondet_uint16();
    const uint16_t over = nondet_uint16();
    const uint16_t relay = nondet_uint16();

    assume(inside(wanted, 1, 36864));
    assume(inside(over, 2, 65534));
    claim(amplitude_for(wanted, over, relay) ==
          amplitude_of(wanted, over, relay));
}

uint32_t __CPROVER_uninterpreted_amplitude(uint16_t wanted, uint16_t over,
                                           uint16_t relay);

uint32_t amplitude_for_contract(uint16_t wanted, uint16_t over, uint16_t relay)
{
    pre(inside(wanted, 1, 36864));
    pre(inside(over, 2, 65534));
    return __CPROVER_uninterpreted_amplitude(wanted, over, relay);
}

// Where the setpoint cuts the overshoot, the output that holds it cuts the
// relay. By contract: share, amplitude_for.
void prove_recentre(void)
{
    struct fixpid_autotune defined;
    number low;
    number relay;
    number below;
    number over;
    number wanted;
    number part;
    number amplitude;

    c = nondet_autotune();
    assume(inside(c.state, IN_FIND, IN_CENTRE));
    assume(ready_to_end(&c, 0));
    assume(!fresh(&c));
    defined = c;
    low = low_output(&c, c.state);
    relay = high_output(&c, c.state) - low;
    below = -(number)c.lowest - c.edge;
    over = (number)c.highest - c.lowest - (2 * (number)c.edge);
    wanted = swing_wanted(&c);
    wanted = (wanted < 2 * (number)c.edge) ? c.edge : (wanted - c.edge);
    part = __CPROVER_uninterpreted_share((uint16_t)below, (uint16_t)over);
    defined.centre = signed16(low + floor_by((relay * part) + 128, 8));
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
    pre(inside(self->state, IN_FIND, IN_CENTRE));
    pre(ready_to_end(self, 0));
    some_relay(self);
}

// By contract: recentre.
void prove_cycle(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(ready_to_end(&c, deviation));
    defined = c;
    end_as_defined(&defined, deviation);
    fixpid_autotune_end_cycle(&c, deviation);
    claim_same(&c, &defined);
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
