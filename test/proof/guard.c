// SPDX-License-Identifier: MIT
// fixpid_guard against the rules of its header.
#include "prove.h"

#include "fixpid_guard.h"

struct fixpid_guard c; // of any bytes, where a proof begins
struct fixpid_guard nondet_guard(void);
struct fixpid_guard_config nondet_guard_config(void);

#include "guard/fixpid_guard.c"

// Of the band around the setpoint.
enum { WITHIN, LOWER, UPPER };

// A guard as the rules speak of it.
struct rules {
    number last, run, hold, count, mark, anchor, swings, strikes;
    unsigned zone, end, outside; // WITHIN, LOWER or UPPER
    unsigned flags;
};

// The pattern as a signed number.
static number counted(const struct fixpid_guard *x)
{
    return (x->count < 0x8000u) ? x->count : (number)x->count - 65536;
}

static struct rules rules_of(const struct fixpid_guard *x)
{
    const struct rules rules = {
        .last = x->last,
        .run = x->run,
        .hold = x->hold,
        .count = counted(x),
        .mark = x->mark,
        .anchor = x->anchor,
        .swings = x->swings,
        .strikes = x->strikes,
        .zone = x->state & 3u,
        .end = (x->state >> 4) & 3u,
        .outside = (x->state >> 2) & 3u,
        .flags = x->flags,
    };

    return rules;
}

static bool same_rules(const struct rules *a, const struct rules *b)
{
    return (a->last == b->last) && (a->run == b->run) && (a->hold == b->hold) &&
           (a->count == b->count) && (a->mark == b->mark) &&
           (a->anchor == b->anchor) && (a->swings == b->swings) &&
           (a->strikes == b->strikes) && (a->zone == b->zone) &&
           (a->end == b->end) && (a->outside == b->outside) &&
           (a->flags == b->flags);
}

static bool same_config(const struct fixpid_guard *a,
                        const struct fixpid_guard *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->measurement_min == b->measurement_min) &&
           (a->measurement_max == b->measurement_max) &&
           (a->reach_min == b->reach_min) && (a->reach_max == b->reach_max) &&
           (a->band == b->band) && (a->patience == b->patience) &&
           ((a->state & 0xC0u) == (b->state & 0xC0u));
}

static bool legal_guard(const struct fixpid_guard *x)
{
    return (x->output_min < x->output_max) &&
           (x->measurement_min < x->measurement_max) &&
           (x->measurement_min <= x->reach_min) &&
           (x->reach_max <= x->measurement_max) && inside(x->band, 1, 32767) &&
           ((number)x->reach_max - x->reach_min > 2 * (number)x->band) &&
           inside(x->patience, 2, 32767);
}

// What init establishes and every function keeps.
// Domain: the configuration is legal, the zones exist, and each count is below
// the end at which it raises a flag or begins again.
static bool guard_is_sound(const struct fixpid_guard *x)
{
    const struct rules at = rules_of(x);
    const number patience = x->patience;

    return legal_guard(x) && (at.zone != 3u) && (at.end != 3u) &&
           (at.outside != 3u) && (at.run < 2 * patience) && (at.swings < 12) &&
           (at.strikes < 4) &&
           inside(at.count, (at.zone == WITHIN) ? 1 - patience : 0,
                  patience - 1);
}

static number apart(number a, number b)
{
    return (a < b) ? (b - a) : (a - b);
}

static void rule_range(struct rules *at, number y)
{
    if (inside(y, c.measurement_min, c.measurement_max)) {
        at->strikes = 0;
    } else if (++at->strikes == 4) {
        at->strikes = 0;
        at->flags |= (y < c.measurement_min) ? FIXPID_GUARD_SENSOR_LOW
                                             : FIXPID_GUARD_SENSOR_HIGH;
    }
}

static void rule_frozen(struct rules *at, number y, number u)
{
    const number quarter =
        floor_by((number)c.output_max - (number)c.output_min, 2);

    if ((y != at->last) || !inside(y, c.reach_min, c.reach_max)) {
        at->last = y;
        at->run = 0;
    } else if (at->run < c.patience) {
        at->run++;
        at->hold = (at->run == c.patience) ? u : at->hold;
    } else if (((c.state & 0x40u) != 0u) || (apart(u, at->hold) > quarter)) {
        if (++at->run >= 2 * (number)c.patience) {
            at->run = 0;
            at->flags |= FIXPID_GUARD_FROZEN;
        }
    }
}

static void rule_swings(struct rules *at, number r)
{
    if (at->zone == WITHIN) {
        return;
    }
    at->flags &= ~(unsigned)FIXPID_GUARD_SETTLED;
    if (apart(r, at->anchor) > c.band) {
        at->anchor = r;
        at->swings = 0;
    } else if ((at->outside != WITHIN) && (at->outside != at->zone)) {
        if (++at->swings == 12) {
            at->swings = 0;
            at->flags |= FIXPID_GUARD_OSCILLATING;
        }
    }
    at->outside = at->zone;
}

static void rule_zone(struct rules *at, number goal, number r, number y)
{
    const number band =
        (at->zone == WITHIN) ? (number)c.band : floor_by(c.band, 1);
    unsigned zone = WITHIN;

    if (goal - y > band) {
        zone = LOWER;
    } else if (y - goal > band) {
        zone = UPPER;
    }
    if (zone != at->zone) {
        at->zone = zone;
        at->mark = y;
        at->count = 0;
        rule_swings(at, r);
    }
}

static void rule_alarm(struct rules *at, unsigned end)
{
    at->count = 0;
    at->flags |=
        (end == LOWER) ? FIXPID_GUARD_NOT_RISING : FIXPID_GUARD_NOT_FALLING;
}

static void rule_outside(struct rules *at, number y, unsigned end)
{
    const number nearer = (at->zone == LOWER) ? (y - at->mark) : (at->mark - y);

    if (nearer >= c.band) {
        at->mark = y;
        at->count = 0;
        return;
    }
    if (nearer < 0) {
        at->mark = y;
    }
    if ((end == at->zone) && (++at->count >= c.patience)) {
        rule_alarm(at, end);
    }
}

static void rule_inside(struct rules *at, unsigned end)
{
    if (end != WITHIN) {
        if ((at->count > 0) || (end != at->end)) {
            at->count = 0;
        }
        at->end = end;
        if (--at->count <= -(number)c.patience) {
            rule_alarm(at, end);
        }
    } else if (++at->count >= c.patience) {
        at->count = 0;
        at->swings = 0;
        at->outside = WITHIN;
        at->flags |= FIXPID_GUARD_SETTLED;
    }
}

static unsigned end_by_rule(number u)
{
    const bool reverse = (c.state & 0x80u) != 0u;

    if (u >= c.output_max) {
        return reverse ? UPPER : LOWER;
    }
    if (u <= c.output_min) {
        return reverse ? LOWER : UPPER;
    }
    return WITHIN;
}

static void rule_step(struct rules *at, number r, number y, number u)
{
    const number goal = clamp(r, c.reach_min, c.reach_max);
    const unsigned end = end_by_rule(u);

    rule_range(at, y);
    rule_frozen(at, y, u);
    rule_zone(at, goal, r, y);
    if (at->zone != WITHIN) {
        rule_outside(at, y, end);
    } else {
        rule_inside(at, ((goal == r) && (goal != y)) ? end : WITHIN);
    }
}

void prove_step(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    const int16_t output = nondet_int16();
    struct fixpid_guard was;
    struct rules wanted;
    struct rules found;
    unsigned flags;

    c = nondet_guard();
    assume(guard_is_sound(&c));
    was = c;
    wanted = rules_of(&c);
    rule_step(&wanted, setpoint, measurement, output);
    flags = fixpid_guard_step(&c, setpoint, measurement, output);
    found = rules_of(&c);
    claim(same_rules(&wanted, &found));
    claim(flags == wanted.flags);
    claim(fixpid_guard_flags(&c) == flags);
    claim(same_config(&was, &c));
    claim(guard_is_sound(&c));
    // An alarm that is set stays.
    claim((was.flags & (uint8_t)~FIXPID_GUARD_SETTLED & ~flags) == 0u);
}

static bool at_rest(const struct fixpid_guard *x)
{
    const struct rules rest = {0};
    const struct rules at = rules_of(x);

    return same_rules(&rest, &at);
}

// A range of which both ends are 0 is another one.
static bool is_taken(number low, number high, number asked_low,
                     number asked_high, number other_low, number other_high)
{
    if ((asked_low == 0) && (asked_high == 0)) {
        return (low == other_low) && (high == other_high);
    }
    return (low == asked_low) && (high == asked_high);
}

void prove_init(void)
{
    struct fixpid_guard_config config = nondet_guard_config();
    bool accepted;

    config.reverse = any_bool;
    config.noisy = any_bool;
    c = nondet_guard();
    accepted = fixpid_guard_init(&c, &config);
    claim(at_rest(&c));
    claim(is_taken(c.measurement_min, c.measurement_max, config.measurement_min,
                   config.measurement_max, INT16_MIN, INT16_MAX));
    claim(is_taken(c.reach_min, c.reach_max, config.reach_min, config.reach_max,
                   c.measurement_min, c.measurement_max));
    claim((c.output_min == config.output_min) &&
          (c.output_max == config.output_max) && (c.band == config.band));
    claim(((c.state & 0x80u) != 0u) == config.reverse);
    claim(((c.state & 0x40u) != 0u) == config.noisy);
    claim(c.patience == (accepted ? config.patience : 0u));
    if (accepted) {
        claim(guard_is_sound(&c));
        claim(fixpid_guard_flags(&c) == 0u);
    } else {
        claim(fixpid_guard_step(&c, 0, 0, 0) == FIXPID_GUARD_REFUSED);
        claim(fixpid_guard_flags(&c) == FIXPID_GUARD_REFUSED);
        c.patience = config.patience;
        claim(!legal_guard(&c));
    }
}

void prove_setters(void)
{
    struct fixpid_guard was;
    struct rules wanted;
    struct rules found;

    c = nondet_guard();
    was = c;
    if (nondet_bool()) {
        fixpid_guard_reset(&c);
        claim(at_rest(&c));
    } else {
        fixpid_guard_acknowledge(&c);
        wanted = rules_of(&was);
        wanted.flags &= FIXPID_GUARD_SETTLED;
        wanted.count = 0;
        wanted.run = 0;
        wanted.swings = 0;
        wanted.strikes = 0;
        found = rules_of(&c);
        claim(same_rules(&wanted, &found));
    }
    claim(same_config(&was, &c));
    claim(!guard_is_sound(&was) || guard_is_sound(&c));
}

void prove_refused(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();

    c = nondet_guard();
    c.patience = 0;
    if (nondet_bool()) {
        fixpid_guard_reset(&c);
    } else if (nondet_bool()) {
        fixpid_guard_acknowledge(&c);
    }
    claim(fixpid_guard_step(&c, setpoint, measurement, nondet_int16()) ==
          FIXPID_GUARD_REFUSED);
    claim(fixpid_guard_flags(&c) == FIXPID_GUARD_REFUSED);
}

// Of any bytes: nothing undefined. The configuration stays.
void prove_total(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_guard was;

    c = nondet_guard();
    was = c;
    (void)fixpid_guard_step(&c, setpoint, measurement, nondet_int16());
    claim(same_config(&was, &c));
    (void)fixpid_guard_flags(&c);
}
