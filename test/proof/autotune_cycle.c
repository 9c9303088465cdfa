// SPDX-License-Identifier: MIT
// What fixpid_autotune does at the end of a cycle, part by part: it is what
// autotune.h says in whole numbers, and where the next relay's centre lies.
#include "autotune.h"

static bool share_turn(uint8_t *quotient, uint16_t *rest, uint8_t *bit,
                       uint16_t whole);

// clang-format would make another macro of it.
// clang-format off
#define for(head) for (head) if (share_turn(&quotient, &rest, &bit, whole))
// clang-format on
#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_relay.c"
#undef for

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

// Where the turn began that is proved.
static struct {
    number bits; // that are there
    number rest;
    number quotient;
} began;

static number whole_of;

static bool is_shared(number rest, number bits)
{
    return inside(bits, 0, 8) && (rest < whole_of);
}

// Long division: twice the rest is the next one, and the whole if it goes into
// it.
static bool is_next(number rest, number quotient, number bits)
{
    return (bits == began.bits + 1) &&
           (floor_by(quotient, 1) == began.quotient) &&
           (rest == (began.rest * 2) - (((quotient & 1) != 0) ? whole_of : 0));
}

// The bits before the quotient's are shifted out.
static bool share_turn(uint8_t *quotient, uint16_t *rest, uint8_t *bit,
                       uint16_t whole)
{
    claim((whole == whole_of) && is_shared(*rest, *bit) &&
          (begins() ? ((*bit == 0u) && (*rest == began.rest))
                    : is_next(*rest, *quotient & ones(*bit), *bit)));
    any_turn();
    *quotient = nondet_uint8();
    *rest = nondet_uint16();
    *bit = nondet_uint8();
    assume(autotune_may_share(*rest, *bit, whole_of));
    began.bits = *bit;
    began.rest = *rest;
    began.quotient = *quotient & ones(*bit);
    return true;
}

// floor(256 part / whole)
void prove_share(void)
{
    const uint16_t part = nondet_uint16();
    number found;

    whole_of = nondet_uint16();
    assume(autotune_is_part(part, whole_of));
    began.rest = part;
    found = share(part, (uint16_t)whole_of);
    claim((began.bits == 7) &&
          (found == (began.quotient * 2) + (began.rest * 2 >= whole_of)));
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

// D * share / 256, to the nearest: at most D.
uint16_t __CPROVER_uninterpreted_counts(uint16_t counts, uint8_t part);

static uint16_t assume_counts(uint16_t counts, uint8_t part)
{
    const uint16_t found = __CPROVER_uninterpreted_counts(counts, part);

    assume(found <= counts);
    return found;
}

uint16_t counts_of_contract(uint16_t counts, uint8_t part)
{
    return assume_counts(counts, part);
}

// At most D with any share. Of a share with one bit it is the equation; a
// solver is slow at other products.
void prove_counts(void)
{
    const uint16_t counts = nondet_uint16();
    const unsigned bit = nondet_uint8();

    claim(counts_of(counts, nondet_uint8()) <= counts);
    assume(bit < 8u);
    claim(counts_of(counts, (uint8_t)(1u << bit)) ==
          floor_by(((number)counts << bit) + 128, 8));
}

static unsigned share_is;

uint8_t one_share(uint16_t part, uint16_t whole)
{
    pre(part < whole);
    return (uint8_t)share_is;
}

// The swing that is wanted is halved, and the relay doubled, until a relay
// overshoots by no less; what is missing then is its share. Of all shares those
// with one bit are taken, as a solver is slow at other products. By contract:
// share (one_share).
void prove_amplitude(void)
{
    const uint16_t wanted = nondet_uint16();
    const uint16_t over = nondet_uint16();
    const uint16_t relay = nondet_uint16();
    const unsigned bit = nondet_uint8();
    unsigned turns = 0;
    number amplitude;

    assume(inside(wanted, 1, 36864));
    assume(inside(over, 2, 65534));
    assume(bit < 8u);
    share_is = 1u << bit;
    while (floor_by(wanted, turns) > over) {
        turns++;
    }
    amplitude = lesser((number)relay << turns, 131072);
    if (floor_by(wanted, turns) < over) {
        amplitude = floor_by(amplitude << bit, 8);
    }
    claim(amplitude_for(wanted, over, relay) == amplitude);
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
    assume(autotune_may_recentre(&c));
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
    claim(autotune_has_relay(&c));
}

void recentre_contract(struct fixpid_autotune *self)
{
    pre(autotune_may_recentre(self));
    take_part(&centre_part, self, 0);
}

void prove_alike(void)
{
    const uint16_t before = nondet_uint16();

    c = nondet_autotune();
    assume(autotune_may_compare(&c));
    claim(regular(&c, before) == is_alike(&c, before));
}

bool regular_contract(const struct fixpid_autotune *self, uint16_t before)
{
    struct fixpid_autotune same = *self;

    pre(autotune_may_compare(self));
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
    assume(autotune_may_end(&c, deviation));
    defined = c;
    alike_part.open = true;
    end_as_defined(&defined, deviation);
    fixpid_autotune_end_cycle(&c, deviation);
    claim_same(&c, &defined);
    claim(!centre_part.due && !alike_part.due);
}

void prove_lost(void)
{
    const uint8_t phase = nondet_uint8();
    struct fixpid_autotune defined;

    assume(inside(phase, IN_CENTRE, IN_THIRD));
    c = nondet_autotune();
    c.state = phase;
    assume(autotune_has_relay(&c));
    defined = c;
    lost_as_defined(&defined);
    fixpid_autotune_find_again(&c);
    claim_same(&c, &defined);
}
