// SPDX-License-Identifier: MIT
// What the proofs of fixpid_reaction share: the rules of its header, in whole
// numbers, and what an experiment can be.
#ifndef PROOF_REACTION_H
#define PROOF_REACTION_H
#include "prove.h"

#include "fixpid_pid.h"
#include "fixpid_reaction.h"

struct fixpid_reaction c; // of any bytes, where a proof begins
struct fixpid_reaction nondet_reaction(void);

// `state` of an experiment that runs; below are those that are over.
enum { LISTENS = 1, HEATS = 9 };

// An experiment as the rules speak of it.
struct curve {
    unsigned state; // a status, LISTENS or HEATS
    number blocks, doubled, places, left, start, base, band, sum;
    number m[8]; // while it listens: the lowest, the highest, the first half
};

static number greater(number a, number b)
{
    return (a > b) ? a : b;
}

static number size_of(number x)
{
    return (x < 0) ? -x : x;
}

// The pattern as a signed number.
static number pattern(uint16_t bits)
{
    return (bits < 0x8000u) ? bits : (number)bits - 65536;
}

static bool leads_down(const struct fixpid_reaction *x)
{
    return (x->scale & 0x80u) != 0u;
}

// Readings are kept upside down where the heat-up leads down.
static number mirrored(const struct fixpid_reaction *x, number reading)
{
    return leads_down(x) ? (-1 - reading) : reading;
}

static struct curve curve_of(const struct fixpid_reaction *x)
{
    struct curve at = {
        .state = (x->state > HEATS) ? HEATS : x->state,
        .blocks = x->blocks,
        .doubled = x->doubled & 15u,
        .places = x->scale & 7u,
        .left = x->left,
        .start = mirrored(x, x->start),
        .base = x->base,
        .band = x->band,
        .sum = x->sum,
    };

    for (unsigned i = 0; i < 8u; i++) {
        at.m[i] = (at.state == LISTENS) ? pattern(x->record[i]) : x->record[i];
    }
    return at;
}

static bool same_config(const struct fixpid_reaction *a,
                        const struct fixpid_reaction *b)
{
    return (a->output_rest == b->output_rest) &&
           (a->output_drive == b->output_drive) && (a->stop == b->stop) &&
           (a->timeout_steps == b->timeout_steps) &&
           (leads_down(a) == leads_down(b));
}

// What counts of it: of one that is over only how it ended, or all of it if
// there are gains.
static bool same_curve(const struct curve *a, const struct curve *b)
{
    const number blocks = (a->state == LISTENS) ? 3 : a->blocks;
    bool same = (a->blocks == b->blocks) && (a->doubled == b->doubled) &&
                (a->places == b->places) && (a->left == b->left) &&
                (a->start == b->start) && (a->base == b->base) &&
                (a->band == b->band) && (a->sum == b->sum);

    for (unsigned i = 0; i < 8u; i++) {
        same = same && ((i >= blocks) || (a->m[i] == b->m[i]));
    }
    if ((a->state != LISTENS) && (a->state != HEATS) &&
        (a->state != FIXPID_REACTION_DONE)) {
        same = true;
    }
    return same && (a->state == b->state);
}

// Counts from the start, positive where the heat-up leads.
static number forward_of(const struct curve *at, number y)
{
    const number risen = clamp(y - at->start, -32767, 32767);

    return leads_down(&c) ? -risen : risen;
}

static number reach_of(const struct curve *at)
{
    return clamp(forward_of(at, mirrored(&c, c.stop)), 0, 16384);
}

static number needed_by(const struct curve *at)
{
    return (at->band + 1) << (2 + at->places);
}

// ---- Listening ----

static void rule_begin(struct curve *at)
{
    const number reach = reach_of(at);

    at->band = at->m[1] - at->m[0];
    at->left = 1;
    at->state = HEATS;
    if (at->base - at->m[2] > (5 * at->band) + 16) {
        at->state = FIXPID_REACTION_MOVING;
    } else if (reach == 0) {
        at->state = FIXPID_REACTION_LIMIT;
    }
    for (unsigned i = 1; i <= 4u; i++) {
        at->places = ((reach << i) <= 16384) ? i : at->places;
    }
}

// Whether all of them are there.
static bool rule_listen(struct curve *at, number y)
{
    number x;

    at->start = (at->left == 32) ? y : at->start;
    x = forward_of(at, y);
    if (size_of(x) > 511) {
        at->state = FIXPID_REACTION_MOVING;
        return false;
    }
    at->m[0] = (x < at->m[0]) ? x : at->m[0];
    at->m[1] = (x > at->m[1]) ? x : at->m[1];
    if (at->left > 16) {
        at->m[2] += x;
    } else {
        at->base += x;
    }
    at->left--;
    return at->left == 0;
}

// ---- Heating ----

// How much the record rises, each time over two blocks.
struct slopes {
    number last, steepest, before; // before: without the last two
};

static struct slopes slopes_of(const struct curve *at)
{
    struct slopes found = {0};
    number older = 0;

    for (unsigned j = 2; j < 8u; j++) {
        if (j < at->blocks) {
            found.last = greater(at->m[j] - at->m[j - 2u], 0);
            found.before = older;
            older = found.steepest;
            found.steepest = greater(found.last, older);
        }
    }
    return found;
}

static unsigned rule_slope(const struct curve *at, const struct slopes *slopes,
                           number rise)
{
    const number need = needed_by(at);
    const number grown = at->m[at->blocks - 1] - at->m[at->blocks - 2];

    if (2 * slopes->last <= slopes->steepest) {
        return (rise >= 2 * need) ? FIXPID_REACTION_LEVELS_OFF : HEATS;
    }
    return ((slopes->steepest >= need) &&
            (slopes->last <= slopes->before + floor_by(slopes->before, 3)) &&
            (grown > floor_by(slopes->steepest, 2)))
               ? FIXPID_REACTION_DONE
               : HEATS;
}

// What the next block may bring.
static number coming_of(const struct curve *at, const struct slopes *slopes)
{
    const number more = greater(slopes->last - slopes->before, 0);

    return floor_by(slopes->steepest, 4) +
           ((at->blocks >= 5) ? floor_by(more, 4) : 0);
}

static unsigned rule_judge(const struct curve *at, const struct slopes *slopes)
{
    const number n = at->blocks;
    const number need = needed_by(at);
    const number origin = reach_of(at) << at->places;
    const number newest = at->m[n - 1];
    const number rise = greater(newest - origin, 0);
    unsigned said = HEATS;

    if (origin - newest > greater(floor_by(origin, 2), need)) {
        return FIXPID_REACTION_WRONG_WAY;
    }
    if ((n >= 6) && (at->doubled >= 1)) {
        said = rule_slope(at, slopes, rise);
    }
    if (said != HEATS) {
        return said;
    }
    if (coming_of(at, slopes) * (n + 1) >= floor_by(origin, 3)) {
        return FIXPID_REACTION_LIMIT;
    }
    if ((n == 8) && (at->doubled == 12)) {
        return FIXPID_REACTION_TOO_SLOW;
    }
    return ((rise < 2 * need) && ((n << at->doubled) >= c.timeout_steps))
               ? FIXPID_REACTION_NO_MOVEMENT
               : HEATS;
}

static void rule_halve(struct curve *at)
{
    for (unsigned i = 0; i < 4u; i++) {
        at->m[i] = floor_by(at->m[2u * i] + at->m[(2u * i) + 1u], 1);
    }
    at->blocks = 4;
    at->doubled++;
    at->left *= 2;
}

// Up to the verdict.
static void rule_block(struct curve *at)
{
    at->m[at->blocks & 7] = floor_by(at->sum, (unsigned)at->doubled);
    at->blocks++;
    at->sum = 0;
    at->left = (number)1 << at->doubled;
}

// Whether the block is full.
static bool rule_heat(struct curve *at, number y)
{
    const number reach = reach_of(at);
    number x = forward_of(at, y);

    if (x >= reach) {
        at->state = FIXPID_REACTION_LIMIT;
        return false;
    }
    x = greater(x, -reach);
    if ((at->band == 0) && (x != 0)) {
        at->band = clamp(size_of(x), 1, 1022);
    }
    at->sum += (x + reach) << at->places;
    at->left--;
    return at->left == 0;
}

// ---- What an experiment can be ----

static bool legal_reaction(const struct fixpid_reaction *x)
{
    return (x->output_rest != x->output_drive) &&
           inside(x->timeout_steps, 1, 32767);
}

// So many deviations of up to 511.
static number farthest_times(number steps)
{
    return (steps << 9) - steps;
}

static bool sound_listening(const struct curve *at)
{
    const number done = 32 - at->left;

    return inside(at->left, 1, 32) && (at->places == 0) && (at->blocks == 0) &&
           (at->doubled == 0) && (at->sum == 0) && (at->band == 0) &&
           (at->m[7] == 0) && inside(at->m[0], -511, 0) &&
           inside(at->m[1], 0, 511) &&
           (size_of(at->m[2]) <= farthest_times(clamp(done, 0, 16))) &&
           (size_of(at->base) <= farthest_times(greater(done - 16, 0)));
}

static bool sound_blocks(const struct curve *at)
{
    bool sound =
        inside(at->band, 0, 1022) && (size_of(at->base) <= farthest_times(16));

    for (unsigned i = 0; i < 8u; i++) {
        sound = sound && ((i >= at->blocks) || (at->m[i] <= 32767));
    }
    return sound;
}

// A record, whose blocks are means of counts up to 32767.
static bool sound_record(const struct curve *at)
{
    return inside(at->places, 0, 4) && inside(at->doubled, 0, 12) &&
           ((reach_of(at) << at->places) <= 16384) && sound_blocks(at);
}

// What may come into a block: counts up to 32767 of so many steps.
static bool sound_sum(const struct curve *at, number steps)
{
    return at->sum <= (steps << 15) - steps;
}

static bool sound_heating(const struct curve *at)
{
    const number length = (number)1 << at->doubled;

    return sound_record(at) && (reach_of(at) > 0) && inside(at->blocks, 0, 8) &&
           ((at->blocks > 0) || (at->m[7] == 0)) &&
           ((at->doubled == 0) || (at->blocks >= 4)) &&
           ((at->blocks < 8) || ((at->doubled < 12) && (at->left == length))) &&
           inside(at->left, 1, length) && sound_sum(at, length - at->left);
}

// What init makes of any bytes, and a step keeps.
// Domain: it was refused, or the configuration is legal and it is over, or so
// many readings can have made its record.
static bool reaction_is_sound(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);

    if (at.state == FIXPID_REACTION_REFUSED) {
        return true;
    }
    if (!legal_reaction(x) || (x->doubled > 15u)) {
        return false;
    }
    if (at.state == LISTENS) {
        return sound_listening(&at);
    }
    if (at.state == HEATS) {
        return sound_heating(&at);
    }
    return (at.state != FIXPID_REACTION_DONE) ||
           (sound_record(&at) && inside(at.blocks, 6, 8) && (at.doubled > 0));
}

// Domain: the record of a heat-up: its blocks are at most 32767, the noise's
// band is at most 1022, and the mean at rest is within 511.
static bool reaction_has_record(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);

    return (at.state == FIXPID_REACTION_DONE) && inside(at.blocks, 0, 8) &&
           sound_blocks(&at);
}

// Domain: a sound experiment that listens.
static bool reaction_is_listening(const struct fixpid_reaction *x)
{
    return (x->state == LISTENS) && reaction_is_sound(x);
}

// Domain: a sound experiment that heats.
static bool reaction_is_heating(const struct fixpid_reaction *x)
{
    return (x->state >= HEATS) && reaction_is_sound(x);
}

// Domain: a sound experiment that is done: its record rises in two blocks.
static bool reaction_is_done(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);
    const struct slopes slopes = slopes_of(&at);

    return (x->state == FIXPID_REACTION_DONE) && reaction_is_sound(x) &&
           (slopes.steepest > 0);
}

// What the parts rely on. Those before them show it where they are called.

// Domain: the end of the listening: none of its deviations was above 511.
static bool reaction_may_begin(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);

    return (at.state == LISTENS) && (at.places == 0) && (at.blocks == 0) &&
           inside(at.m[0], -511, 0) && inside(at.m[1], 0, 511) &&
           (size_of(at.m[2]) <= farthest_times(16)) &&
           (size_of(at.base) <= farthest_times(16));
}

// Domain: a block of a heat-up that is full: it is the eighth at most.
static bool reaction_may_end_block(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);

    return (at.state == HEATS) && legal_reaction(x) && (x->doubled <= 12u) &&
           sound_record(&at) && (reach_of(&at) > 0) &&
           inside(at.blocks, 0, 7) && sound_sum(&at, (number)1 << at.doubled);
}

// Domain: a heat-up with a new block: a block has 2^doubled steps.
static bool reaction_may_judge(const struct fixpid_reaction *x)
{
    const struct curve at = curve_of(x);

    return (at.state == HEATS) && legal_reaction(x) && (x->doubled <= 12u) &&
           sound_record(&at) && (reach_of(&at) > 0) &&
           inside(at.blocks, 1, 8) && (at.left == (number)1 << at.doubled);
}

#endif
