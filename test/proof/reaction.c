// SPDX-License-Identifier: MIT
// A step of fixpid_reaction, part by part and as the whole that the parts make:
// it is what reaction.h says in whole numbers, keeps what an experiment can be,
// and ends.
#include "reaction.h"

#include "reaction/fixpid_reaction.c"
#include "reaction/fixpid_reaction_block.c"
#include "reaction/fixpid_reaction_more.c"

struct fixpid_reaction_config nondet_reaction_config(void);
struct rises nondet_rises(void);

// A part of a step that is proved by itself: the code must hand to it what the
// definition does, and gets what the definition gets, which is anything.
struct part {
    bool due;
    number reading;
    struct curve before;
    struct fixpid_reaction after;
};

static struct part begin_part, block_part, listen_part, heat_part;

// Any experiment with the configuration of c.
static struct fixpid_reaction another(void)
{
    struct fixpid_reaction x = nondet_reaction();

    x.output_rest = c.output_rest;
    x.output_drive = c.output_drive;
    x.stop = c.stop;
    x.timeout_steps = c.timeout_steps;
    x.scale = (uint8_t)((x.scale & 0x7Fu) | (c.scale & 0x80u));
    return x;
}

static void hand_to(struct part *part, struct curve *at, number reading)
{
    part->due = true;
    part->reading = reading;
    part->before = *at;
    part->after = another();
    *at = curve_of(&part->after);
}

static void take(struct part *part, struct fixpid_reaction *self,
                 number reading)
{
    const struct curve at = curve_of(self);

    claim(part->due && (part->reading == reading));
    claim(same_curve(&at, &part->before));
    *self = part->after;
    part->due = false;
}

// Whether the code has made of it what the definition has.
static void claim_curve(const struct curve *wanted,
                        const struct fixpid_reaction *was)
{
    const struct curve found = curve_of(&c);

    claim(same_curve(wanted, &found));
    claim(same_config(was, &c));
}

// Of any bytes.
void prove_scaled(void)
{
    for (unsigned scale = 0; scale < 128u; scale++) {
        const uint16_t counts = nondet_uint16();
        const number scaled = ((number)counts << (scale & 7u)) & 0xFFFF;

        c = nondet_reaction();
        c.scale = (uint8_t)scale;
        claim(fixpid_reaction_scaled(&c, counts) == scaled);
        c.scale = (uint8_t)(scale + 128u);
        claim(fixpid_reaction_scaled(&c, counts) == scaled);
    }
}

uint16_t fixpid_reaction_scaled_contract(const struct fixpid_reaction *self,
                                         uint16_t counts)
{
    return (uint16_t)((uint32_t)counts << (self->scale & 7u));
}

// Where the listening ends the output changes, unless the reading coasts.
void prove_begin(void)
{
    struct fixpid_reaction was;
    struct curve wanted;

    c = nondet_reaction();
    assume(reaction_may_begin(&c));
    was = c;
    wanted = curve_of(&c);
    rule_begin(&wanted);
    fixpid_reaction_begin(&c);
    claim_curve(&wanted, &was);
}

void fixpid_reaction_begin_contract(struct fixpid_reaction *self)
{
    pre(reaction_may_begin(self));
    take(&begin_part, self, 0);
}

// By contract: fixpid_reaction_begin.
void prove_listen(void)
{
    const int16_t measurement = nondet_int16();
    struct fixpid_reaction was;
    struct curve wanted;

    c = nondet_reaction();
    assume(reaction_is_listening(&c));
    was = c;
    wanted = curve_of(&c);
    if (rule_listen(&wanted, measurement)) {
        hand_to(&begin_part, &wanted, 0);
    }
    listen(&c, (int16_t)mirrored(&c, measurement));
    claim_curve(&wanted, &was);
    claim(!begin_part.due);
}

void prove_halve(void)
{
    struct fixpid_reaction was;
    struct curve wanted;

    c = nondet_reaction();
    assume(reaction_is_heating(&c));
    was = c;
    wanted = curve_of(&c);
    rule_halve(&wanted);
    fixpid_reaction_halve(&c);
    claim_curve(&wanted, &was);
}

// Of any bytes in up to eight blocks.
void prove_slopes(void)
{
    for (unsigned blocks = 0; blocks <= 8u; blocks++) {
        struct curve at;
        struct slopes slopes;
        struct rises rises = nondet_rises();

        c = nondet_reaction();
        c.state = HEATS;
        c.blocks = (uint8_t)blocks;
        at = curve_of(&c);
        slopes = slopes_of(&at);
        measure(&c, &rises);
        claim(rises.last == slopes.last);
        claim(rises.steepest == slopes.steepest);
        claim(rises.before == slopes.before);
    }
}

static struct rises measured;

void measure_contract(const struct fixpid_reaction *self, struct rises *rises)
{
    pre(self->blocks <= 8u);
    *rises = measured;
}

// By contract: fixpid_reaction_scaled, measure.
void prove_judge(void)
{
    struct curve at;
    struct slopes slopes;

    c = nondet_reaction();
    assume(reaction_may_judge(&c));
    at = curve_of(&c);
    slopes.last = clamp(nondet_uint16(), 0, 32767);
    slopes.steepest = clamp(nondet_uint16(), 0, 32767);
    slopes.before = clamp(nondet_uint16(), 0, 32767);
    measured.last = (uint16_t)slopes.last;
    measured.steepest = (uint16_t)slopes.steepest;
    measured.before = (uint16_t)slopes.before;
    claim(judge(&c, (uint16_t)at.m[at.blocks - 1]) == rule_judge(&at, &slopes));
}

static struct {
    bool due;
    uint8_t verdict;
    struct curve curve;
} judgement;

uint8_t judge_contract(const struct fixpid_reaction *self, uint16_t newest)
{
    const struct curve at = curve_of(self);

    pre(reaction_may_judge(self) && (newest == at.m[at.blocks - 1]));
    claim(judgement.due && same_curve(&at, &judgement.curve));
    judgement.due = false;
    return judgement.verdict;
}

// By contract: judge.
void prove_block(void)
{
    struct fixpid_reaction was;
    struct curve wanted;

    c = nondet_reaction();
    assume(reaction_may_end_block(&c));
    was = c;
    wanted = curve_of(&c);
    rule_block(&wanted);
    judgement.due = true;
    judgement.curve = wanted;
    judgement.verdict = (uint8_t)clamp(nondet_uint8(), 2, HEATS);
    fixpid_reaction_end_block(&c);
    wanted.state = judgement.verdict;
    claim_curve(&wanted, &was);
    claim(!judgement.due);
}

void fixpid_reaction_end_block_contract(struct fixpid_reaction *self)
{
    pre(reaction_may_end_block(self));
    take(&block_part, self, 0);
}

// By contract: fixpid_reaction_scaled, fixpid_reaction_end_block.
void prove_heat(void)
{
    const int16_t measurement = nondet_int16();
    struct fixpid_reaction was;
    struct curve wanted;

    c = nondet_reaction();
    assume(reaction_is_heating(&c));
    was = c;
    wanted = curve_of(&c);
    if (wanted.blocks == 8) {
        rule_halve(&wanted);
    }
    if (rule_heat(&wanted, measurement)) {
        hand_to(&block_part, &wanted, 0);
    }
    heat(&c, (int16_t)mirrored(&c, measurement));
    claim_curve(&wanted, &was);
    claim(!block_part.due);
}

void listen_contract(struct fixpid_reaction *self, int16_t reading)
{
    pre(reaction_is_listening(self));
    take(&listen_part, self, mirrored(self, reading));
}

void heat_contract(struct fixpid_reaction *self, int16_t reading)
{
    pre(reaction_is_heating(self));
    take(&heat_part, self, mirrored(self, reading));
}

// The output and the status are those of the state that comes next. By
// contract: listen, heat.
void prove_step(void)
{
    const int16_t measurement = nondet_int16();
    struct fixpid_reaction was;
    struct curve wanted;
    number out;

    c = nondet_reaction();
    assume(reaction_is_sound(&c));
    was = c;
    wanted = curve_of(&c);
    if (wanted.state == LISTENS) {
        hand_to(&listen_part, &wanted, measurement);
    } else if (wanted.state == HEATS) {
        hand_to(&heat_part, &wanted, measurement);
    }
    out = fixpid_reaction_step(&c, measurement);
    claim_curve(&wanted, &was);
    claim(!listen_part.due && !heat_part.due);
    if (wanted.state == HEATS) {
        claim(out == c.output_drive);
        claim(fixpid_reaction_status(&c) == FIXPID_REACTION_RUNNING);
    } else {
        claim(out ==
              ((wanted.state == FIXPID_REACTION_REFUSED) ? 0 : c.output_rest));
        claim(fixpid_reaction_status(&c) == wanted.state);
    }
}

// As `block` and `judge` have it: one that ends as DONE has six blocks at
// least, of two steps or more, and the last block of all is one.
void fixpid_reaction_end_block_soundly(struct fixpid_reaction *self)
{
    struct curve at = curve_of(self);
    const unsigned verdict = nondet_uint8();

    pre(reaction_may_end_block(self));
    self->record[at.blocks & 7] = (uint16_t)clamp(nondet_uint16(), 0, 32767);
    self->blocks = (uint8_t)(at.blocks + 1);
    self->left = (uint16_t)(1u << at.doubled);
    self->sum = 0;
    self->state = FIXPID_REACTION_LIMIT;
    if ((verdict >= HEATS) && ((at.blocks < 7) || (at.doubled < 12))) {
        self->state = HEATS;
    } else if ((at.blocks >= 5) && (at.doubled > 0)) {
        self->state = FIXPID_REACTION_DONE;
    }
}

// Steps since the heat-up began.
static number age_of(const struct curve *at)
{
    return (at->blocks << at->doubled) + ((number)1 << at->doubled) - at->left;
}

// An experiment stays one, and ends: it listens for 32 steps, and heats for
// 32768 at most. By contract: fixpid_reaction_scaled, fixpid_reaction_end_block
// (fixpid_reaction_end_block_soundly).
void prove_kept(void)
{
    struct curve was;
    struct curve is;

    c = nondet_reaction();
    assume(reaction_is_sound(&c));
    was = curve_of(&c);
    (void)fixpid_reaction_step(&c, nondet_int16());
    is = curve_of(&c);
    claim(reaction_is_sound(&c));
    if (is.state == LISTENS) {
        claim((was.state == LISTENS) && (is.left == was.left - 1));
    } else if (is.state == HEATS) {
        claim(age_of(&is) == ((was.state == HEATS) ? (age_of(&was) + 1) : 0));
        claim(age_of(&is) < 32768);
    } else {
        claim((was.state == LISTENS) || (was.state == HEATS) ||
              (is.state == was.state));
    }
}

static void claim_started(bool legal)
{
    const struct curve at = curve_of(&c);
    number all =
        at.blocks | at.doubled | at.places | at.base | at.band | at.sum;

    for (unsigned i = 0; i < 8u; i++) {
        all |= at.m[i];
    }
    claim((all == 0) && (at.left == 32) && (c.start == 0));
    claim(at.state == (legal ? LISTENS : FIXPID_REACTION_REFUSED));
    claim(fixpid_reaction_status(&c) == at.state);
    claim(reaction_is_sound(&c));
}

// Of any bytes; and reset makes the same.
void prove_init(void)
{
    struct fixpid_reaction_config config = nondet_reaction_config();
    bool legal;

    config.reverse = any_bool;
    legal = (config.output_rest != config.output_drive) &&
            (config.timeout_steps <= 32767u);
    c = nondet_reaction();
    claim(fixpid_reaction_init(&c, &config) == legal);
    claim_started(legal);
    if (nondet_bool()) {
        c = another();
        c.state = legal ? nondet_uint8() | 1u : FIXPID_REACTION_REFUSED;
        fixpid_reaction_reset(&c);
        claim_started(legal);
    }
    claim((c.output_rest == config.output_rest) &&
          (c.output_drive == config.output_drive));
    claim(c.timeout_steps ==
          ((config.timeout_steps == 0u) ? 1000u : config.timeout_steps));
    claim(!legal ||
          (leads_down(&c) ==
           ((config.output_drive < config.output_rest) != config.reverse)));
    claim(mirrored(&c, c.stop) == config.measurement_stop);
}

// The blocks that can still come. Eight are four of twice the length, and there
// are no more than eight of 2^12 steps; `doubled` begins anew behind 255.
static number blocks_to_go(const struct fixpid_reaction *x)
{
    const number doubled =
        (x->blocks < 8u) ? x->doubled : ((x->doubled + 1u) & 0xFFu);
    const number blocks = (x->blocks < 8u) ? x->blocks : 4;

    return (8 - blocks) + (4 * greater(12 - doubled, 0));
}

// Those of the block, or of the listening; 0 is 65536.
static number steps_to_go(const struct fixpid_reaction *x)
{
    const bool halves = (x->state >= HEATS) && (x->blocks >= 8u);
    const number left = halves ? (2 * (number)x->left) : x->left;

    return ((left - 1) & 0xFFFF) + 1;
}

// floor(90 part / whole), which reaction_turns.c has.
uint8_t __CPROVER_uninterpreted_ninetieths(uint16_t part, uint16_t whole);

static uint8_t assume_ninetieths(uint16_t part, uint16_t whole)
{
    const uint8_t n = __CPROVER_uninterpreted_ninetieths(part, whole);

    assume((n <= 90u) && ((part != 0u) || (n == 0u)));
    return n;
}

uint8_t ninetieths_contract(uint16_t part, uint16_t whole)
{
    pre(part < whole);
    return assume_ninetieths(part, whole);
}

// To 8 while it listens, to 98 at a clear movement. By contract:
// fixpid_reaction_scaled, ninetieths.
void prove_progress(void)
{
    struct curve at;
    number need;
    number risen = 0;
    number done;

    c = nondet_reaction();
    assume(reaction_is_sound(&c));
    at = curve_of(&c);
    done = fixpid_reaction_progress(&c);
    if (at.state == LISTENS) {
        claim(done == floor_by(32 - at.left, 2));
    } else if (at.state == HEATS) {
        need = needed_by(&at);
        if (at.blocks > 0) {
            risen = at.m[at.blocks - 1] - (reach_of(&at) << at.places);
        }
        risen = floor_by(greater(risen, 0), 1);
        claim(done ==
              ((risen >= need)
                   ? 98
                   : (8 + assume_ninetieths((uint16_t)risen, (uint16_t)need))));
        claim(inside(done, 8, 98));
    } else {
        claim(done == 100);
    }
}

// Of any bytes: nothing undefined, the output is one of the configuration or 0,
// one that is over stays so, and each ends: the next step is one of fewer that
// are left of the block, or of a block of fewer that are left. By contract:
// fixpid_reaction_scaled.
void prove_total(void)
{
    struct fixpid_reaction was;
    number out;

    c = nondet_reaction();
    was = c;
    out = fixpid_reaction_step(&c, nondet_int16());
    claim((out == 0) || (out == was.output_rest) || (out == was.output_drive));
    claim((c.output_rest == was.output_rest) &&
          (c.output_drive == was.output_drive) && (c.stop == was.stop) &&
          (c.timeout_steps == was.timeout_steps));
    if ((was.state != LISTENS) && (was.state < HEATS)) {
        claim(c.state == was.state);
    } else if (c.state == LISTENS) {
        claim((was.state == LISTENS) && (steps_to_go(&c) < steps_to_go(&was)));
    } else if ((was.state >= HEATS) && (c.state >= HEATS)) {
        claim((blocks_to_go(&c) < blocks_to_go(&was)) ||
              ((blocks_to_go(&c) == blocks_to_go(&was)) &&
               (steps_to_go(&c) < steps_to_go(&was))));
        claim(inside(blocks_to_go(&was), 1, 56));
    }
}
