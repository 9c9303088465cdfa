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

static unsigned share_is;

uint8_t one_share(uint16_t part, uint16_t whole)
{
    pre(part < whole);
    return (uint8_t)share_is;
}

// The part is halved, and the value doubled, until the whole is no less; what
// is missing then is its share. Of all shares those with one bit are taken, as
// a solver is slow at other products. By contract: share (one_share).
void prove_proportion(void)
{
    const uint16_t value = nondet_uint16();
    const uint16_t part = nondet_uint16();
    const uint16_t whole = nondet_uint16();
    const unsigned bit = nondet_uint8();
    unsigned turns = 0;
    number scaled;

    assume(whole >= 1u);
    assume(bit < 8u);
    share_is = 1u << bit;
    while (floor_by(part, turns) > whole) {
        turns++;
    }
    scaled = lesser((number)value << turns, 131072);
    scaled <<= (floor_by(part, turns) < whole) ? bit : 8u;
    claim(in_proportion_q8(value, part, whole) == scaled);
}

// The same for the same; of a part that is below the whole at most 255/256 of
// the value, and 131072 of any.
uint32_t __CPROVER_uninterpreted_proportion(uint16_t value, uint16_t part,
                                            uint16_t whole);

static uint32_t assume_proportion(uint16_t value, uint16_t part, uint16_t whole)
{
    const uint32_t p = __CPROVER_uninterpreted_proportion(value, part, whole);

    assume(p <= (uint32_t)131072 << 8);
    assume((part >= whole) || (p <= ((uint32_t)value << 8) - value));
    return p;
}

uint32_t in_proportion_q8_contract(uint16_t value, uint16_t part,
                                   uint16_t whole)
{
    pre(whole >= 1u);
    return assume_proportion(value, part, whole);
}

static number proportion(number value, number part, number whole)
{
    return assume_proportion(unsigned16(value), unsigned16(part),
                             unsigned16(whole));
}

static number range_as_defined(const struct fixpid_autotune *x)
{
    return (number)x->config.output_max - x->config.output_min;
}

// What the hysteresis leaves of the largest swing.
static number overshoot_wanted(const struct fixpid_autotune *x)
{
    const number swing = (x->config.swing != 0u)
                             ? x->config.swing
                             : floor_by((number)x->config.measurement_max -
                                            x->config.measurement_min,
                                        3);

    return swing - floor_by(swing, 3) - floor_by(swing, 4);
}

// 3/13 of what the relay will overshoot, and by the noise a swing of six times
// its band at least.
static number edge_for(const struct fixpid_autotune *x, number reached)
{
    const number band = asked_by_noise(x);
    const number edge = greater(band, floor_by(reached * 59, 8));

    return (reached < 6 * band) ? greater(edge, floor_by(6 * band - reached, 1))
                                : edge;
}

void prove_edge(void)
{
    const uint32_t reached = nondet_uint32();
    struct fixpid_autotune defined;

    assume(reached <= 131072u);
    c = nondet_autotune();
    assume(autotune_has_noise(&c));
    defined = c;
    defined.edge = unsigned16(edge_for(&c, reached));
    fit_edge(&c, reached);
    claim_same(&c, &defined);
    claim(inside(c.edge, 1, 30208));
}

void prove_third(void)
{
    const uint16_t relay = nondet_uint16();

    claim(greater(third(relay), 2) == third_of(relay));
    claim(third(relay) <= 21759u);
}

// What edge_for and a third are of a number; the same of the same.
uint16_t __CPROVER_uninterpreted_edge(uint32_t reached);
uint16_t __CPROVER_uninterpreted_third(uint16_t relay);

static uint16_t assume_edge(uint32_t reached)
{
    const uint16_t edge = __CPROVER_uninterpreted_edge(reached);

    assume((edge >= 1u) && (edge <= 30208u));
    return edge;
}

void fit_edge_contract(struct fixpid_autotune *self, uint32_t reached)
{
    pre(autotune_has_noise(self) && (reached <= 131072u));
    self->edge = assume_edge(reached);
}

static uint16_t assume_third(uint16_t relay)
{
    const uint16_t third = __CPROVER_uninterpreted_third(relay);

    assume(third <= 21759u);
    return third;
}

uint16_t third_contract(uint16_t relay)
{
    return assume_third(relay);
}

// Where the setpoint cuts the overshoot, the output that holds it cuts the
// relay. By contract: in_proportion_q8, third, fit_edge.
void prove_recentre(void)
{
    struct fixpid_autotune defined;
    number low;
    number relay;
    number below;
    number over;
    number range;
    number room;
    number half;

    c = nondet_autotune();
    assume(autotune_may_recentre(&c));
    defined = c;
    range = range_as_defined(&c);
    low = low_output(&c, c.state);
    relay = high_output(&c, c.state) - low;
    below = -(number)c.lowest - c.edge;
    over = (number)c.highest - c.lowest - (2 * (number)c.edge);
    defined.centre =
        signed16(low + floor_by(proportion(relay, below, over) + 128, 8));
    room = lesser((number)defined.centre - c.config.output_min,
                  (number)c.config.output_max - defined.centre);
    half = assume_third(unsigned16(lesser(
        floor_by(proportion(relay, overshoot_wanted(&c), over), 8), range)));
    half = lesser(greater(half, 2), greater(room, 2));
    defined.half = unsigned16(half);
    defined.edge = assume_edge((uint32_t)floor_by(
        proportion(over, lesser(3 * half, range), relay), 8));
    fixpid_autotune_fit_relay(&c);
    claim_same(&c, &defined);
    claim(inside(over, 2, 65534) && inside(below, 1, over - 1));
    claim(inside(c.centre, low, low + relay));
}

void fixpid_autotune_fit_relay_contract(struct fixpid_autotune *self)
{
    pre(autotune_may_recentre(self));
    take_part(&centre_part, self, 0);
}

// Of numbers that are powers of two, as a solver is slow at other products.
void prove_same_share(void)
{
    for (unsigned i = 0; i < 15u; i++) {
        for (unsigned j = 0; j < 15u; j++) {
            const uint16_t on = nondet_uint16();
            const uint16_t others_on = nondet_uint16();
            const uint16_t allowed = nondet_uint16();
            const number apart = ((number)on << i) - ((number)others_on << j);

            assume(on <= 32767u);
            assume(others_on <= 32767u);
            assume(allowed <= 1024u);
            claim(fixpid_autotune_same_share(on, (uint16_t)(1u << j), others_on,
                                             (uint16_t)(1u << i), allowed) ==
                  (size_of(apart) <= ((number)allowed << i)));
        }
    }
}

bool fixpid_autotune_same_share_contract(uint16_t on, uint16_t steps,
                                         uint16_t others_on, uint16_t others,
                                         uint16_t allowed)
{
    pre((on <= 32767u) && (steps <= 32767u) && (others_on <= 32767u) &&
        (others <= 32767u) && (allowed <= 1024u));
    return same_share(on, steps, others_on, others, allowed);
}

// By contract: fixpid_autotune_same_share.
void prove_alike(void)
{
    const uint16_t before = nondet_uint16();

    assume(before <= 65534u);
    c = nondet_autotune();
    assume(autotune_may_compare(&c));
    claim(regular(&c, before) == is_alike(&c, before));
}

bool regular_contract(const struct fixpid_autotune *self, uint16_t before)
{
    struct fixpid_autotune same = *self;

    pre(autotune_may_compare(self) && (before <= 65534u));
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
    alike_part.open = true;
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
