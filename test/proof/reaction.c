// SPDX-License-Identifier: MIT
// fixpid_reaction: it starts, a step of any bytes is defined and puts out what
// it may, a started experiment stays one and ends, and what it tells is within
// its range. That each part is its equation is for the tests (unproved.txt).
#include "prove.h"

#include "fixpid_pid.h"
#include "fixpid_reaction.h"

#include "reaction/fixpid_reaction.c"
#include "reaction/fixpid_reaction_block.c"
#include "reaction/fixpid_reaction_result.c"

static bool ninetieths_turn(uint16_t *sum, uint8_t *wholes, uint8_t *turn);

// clang-format would make another macro of it.
// clang-format off
#define for(head) for (head) if (ninetieths_turn(&sum, &wholes, &turn))
// clang-format on
#include "reaction/fixpid_reaction_more.c"
#undef for

struct fixpid_reaction c; // of any bytes, where a proof begins
struct fixpid_reaction nondet_reaction(void);
struct fixpid_reaction_config nondet_reaction_config(void);
struct fixpid_reaction_process nondet_process(void);
struct fixpid_pid_gains nondet_pid_gains(void);

// `state` of an experiment that runs; others are a status, of one that is over.
enum { LISTENS = 1, HEATS = 9 };

static bool listens(const struct fixpid_reaction *x)
{
    return x->state == LISTENS;
}

static bool heats(const struct fixpid_reaction *x)
{
    return x->state >= HEATS;
}

static number size_of(number x)
{
    return (x < 0) ? -x : x;
}

static number greater(number a, number b)
{
    return (a > b) ? a : b;
}

// The pattern as a signed number.
static number pattern(uint16_t bits)
{
    return (bits < 0x8000u) ? bits : (number)bits - 65536;
}

static bool same_config(const struct fixpid_reaction *a,
                        const struct fixpid_reaction *b)
{
    return (a->output_rest == b->output_rest) &&
           (a->output_drive == b->output_drive) && (a->stop == b->stop) &&
           (a->timeout_steps == b->timeout_steps);
}

// ---- What an experiment can be ----

static bool legal_reaction(const struct fixpid_reaction *x)
{
    return (x->output_rest != x->output_drive) &&
           inside(x->timeout_steps, 1, 32767);
}

// The stop and the start are mirrored alike.
static number reach_of(const struct fixpid_reaction *x)
{
    return clamp((number)x->stop - x->start, 0, 16384);
}

static number places_of(const struct fixpid_reaction *x)
{
    return x->scale & 7u;
}

// So many deviations of up to 511.
static number farthest_times(number steps)
{
    return (steps << 9) - steps;
}

static bool sound_listening(const struct fixpid_reaction *x)
{
    const number done = 32 - (number)x->left;

    return inside(x->left, 1, 32) && (places_of(x) == 0) && (x->blocks == 0u) &&
           (x->doubled == 0u) && (x->sum == 0u) && (x->band == 0u) &&
           (x->record[7] == 0u) && inside(pattern(x->record[0]), -511, 0) &&
           inside(x->record[1], 0, 511) &&
           (size_of(pattern(x->record[2])) <=
            farthest_times(clamp(done, 0, 16))) &&
           (size_of(x->base) <= farthest_times(greater(done - 16, 0)));
}

// A record, whose blocks are means of counts up to 32767.
static bool sound_record(const struct fixpid_reaction *x)
{
    bool sound = inside(places_of(x), 0, 4) && inside(x->doubled, 0, 12) &&
                 ((reach_of(x) << places_of(x)) <= 16384) &&
                 inside(x->band, 0, 1022) &&
                 (size_of(x->base) <= farthest_times(16));

    for (unsigned i = 0; i < 8u; i++) {
        sound = sound && ((i >= x->blocks) || (x->record[i] <= 32767u));
    }
    return sound;
}

static bool sound_heating(const struct fixpid_reaction *x)
{
    const number length = (number)1 << (x->doubled & 15u);
    const number done = length - x->left;

    return sound_record(x) && (reach_of(x) > 0) && inside(x->blocks, 0, 8) &&
           ((x->blocks > 0u) || (x->record[7] == 0u)) &&
           ((x->doubled == 0u) || (x->blocks >= 4u)) &&
           ((x->blocks < 8u) || ((x->doubled < 12u) && (x->left == length))) &&
           inside(x->left, 1, length) && (x->sum <= (done << 15) - done);
}

// What init makes of any bytes, and a step keeps.
// Domain: it was refused, or the configuration is legal and it is over, or so
// many readings can have made its record.
static bool reaction_is_sound(const struct fixpid_reaction *x)
{
    if (x->state == FIXPID_REACTION_REFUSED) {
        return true;
    }
    if (listens(x)) {
        return legal_reaction(x) && sound_listening(x);
    }
    if (heats(x)) {
        return legal_reaction(x) && sound_heating(x);
    }
    return legal_reaction(x) &&
           ((x->state != FIXPID_REACTION_DONE) ||
            (sound_record(x) && inside(x->blocks, 6, 8) && (x->doubled > 0u)));
}

// ---- It starts ----

static void claim_started(bool legal)
{
    uint32_t all = c.blocks | c.doubled | (c.scale & 0x7Fu) | c.band | c.sum;

    for (unsigned i = 0; i < 8u; i++) {
        all |= c.record[i];
    }
    claim((all == 0u) && (c.left == 32u) && (c.start == 0) && (c.base == 0));
    claim(c.state == (legal ? LISTENS : FIXPID_REACTION_REFUSED));
    claim(fixpid_reaction_status(&c) == c.state);
    claim(reaction_is_sound(&c));
}

// Of any bytes; and reset makes the same of any of its configuration.
void prove_init(void)
{
    struct fixpid_reaction_config config = nondet_reaction_config();
    struct fixpid_reaction was;
    bool legal;
    bool down;

    config.reverse = any_bool;
    legal = (config.output_rest != config.output_drive) &&
            (config.timeout_steps <= 32767u);
    down = (config.output_drive < config.output_rest) != config.reverse;
    c = nondet_reaction();
    claim(fixpid_reaction_init(&c, &config) == legal);
    claim_started(legal);
    claim((c.output_rest == config.output_rest) &&
          (c.output_drive == config.output_drive));
    claim(c.timeout_steps ==
          ((config.timeout_steps == 0u) ? 1000u : config.timeout_steps));
    claim(!legal || ((c.scale == (down ? 0x80u : 0u)) &&
                     (c.stop == (down ? (-1 - config.measurement_stop)
                                      : config.measurement_stop))));
    was = c;
    c = nondet_reaction();
    c.state = legal ? (c.state | 1u) : FIXPID_REACTION_REFUSED;
    c.output_rest = was.output_rest;
    c.output_drive = was.output_drive;
    c.timeout_steps = was.timeout_steps;
    was = c;
    fixpid_reaction_reset(&c);
    claim_started(legal);
    claim(same_config(&c, &was));
    claim((c.scale & 0x80u) == (was.scale & 0x80u));
}

// ---- A step ----

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
    const bool halves = heats(x) && (x->blocks >= 8u);
    const number left = halves ? (2 * (number)x->left) : x->left;

    return ((left - 1) & 0xFFFF) + 1;
}

// Of any bytes: nothing undefined, the output and the status are those of the
// state, one that is over stays so, and each ends: the next step is one of
// fewer that are left of the block, or of a block of fewer that are left.
void prove_total(void)
{
    struct fixpid_reaction was;
    number out;

    c = nondet_reaction();
    was = c;
    out = fixpid_reaction_step(&c, nondet_int16());
    claim(same_config(&c, &was));
    if (heats(&c)) {
        claim(out == was.output_drive);
        claim(fixpid_reaction_status(&c) == FIXPID_REACTION_RUNNING);
    } else {
        claim(out ==
              ((c.state == FIXPID_REACTION_REFUSED) ? 0 : was.output_rest));
        claim(fixpid_reaction_status(&c) == c.state);
    }
    if (!listens(&was) && !heats(&was)) {
        claim(c.state == was.state);
    } else if (listens(&c)) {
        claim(listens(&was) && (steps_to_go(&c) < steps_to_go(&was)));
    } else if (heats(&was) && heats(&c)) {
        claim((blocks_to_go(&c) < blocks_to_go(&was)) ||
              ((blocks_to_go(&c) == blocks_to_go(&was)) &&
               (steps_to_go(&c) < steps_to_go(&was))));
        claim(inside(blocks_to_go(&was), 1, 56));
    }
}

// Steps since the heat-up began.
static number age_of(const struct fixpid_reaction *x)
{
    return ((number)x->blocks << x->doubled) + ((number)1 << x->doubled) -
           x->left;
}

// An experiment stays one, and ends: it listens for 32 steps, and heats for
// 32768 at most.
void prove_kept(void)
{
    struct fixpid_reaction was;

    c = nondet_reaction();
    assume(reaction_is_sound(&c));
    was = c;
    (void)fixpid_reaction_step(&c, nondet_int16());
    claim(reaction_is_sound(&c));
    if (listens(&c)) {
        claim(listens(&was) && (c.left == was.left - 1));
    } else if (heats(&c)) {
        claim(age_of(&c) == (heats(&was) ? (age_of(&was) + 1) : 0));
        claim(age_of(&c) < 32768);
    } else {
        claim(listens(&was) || heats(&was) || (c.state == was.state));
    }
}

// ---- What it tells ----

// Domain: a turn of 90 additions: no more wholes were taken out than turns are
// done.
static bool reaction_may_add(number wholes, number turns)
{
    return inside(turns, 1, 90) && (wholes + turns <= 90);
}

static bool ninetieths_turn(uint16_t *sum, uint8_t *wholes, uint8_t *turn)
{
    claim(reaction_may_add(*wholes, *turn));
    any_turn();
    *sum = nondet_uint16();
    *wholes = nondet_uint8();
    *turn = nondet_uint8();
    assume(reaction_may_add(*wholes, *turn));
    return true;
}

// Of any bytes; to 8 while it listens and from there to 98 while it heats, if
// it is an experiment.
void prove_progress(void)
{
    number done;

    c = nondet_reaction();
    done = fixpid_reaction_progress(&c);
    claim(inside(done, 0, 100));
    if (listens(&c)) {
        claim((done <= 8) || !reaction_is_sound(&c));
    } else if (heats(&c)) {
        claim(inside(done, 8, 98));
    } else {
        claim(done == 100);
    }
}

static bool same_process(const struct fixpid_reaction_process *a,
                         const struct fixpid_reaction_process *b)
{
    return (a->slope_q24 == b->slope_q24) && (a->dead_q4 == b->dead_q4) &&
           (a->noise_q4 == b->noise_q4);
}

// Of any bytes, there is one of what is done, and otherwise nothing is written.
void prove_model(void)
{
    const struct fixpid_reaction_process before = nondet_process();
    struct fixpid_reaction_process process = before;
    struct fixpid_reaction was;

    c = nondet_reaction();
    was = c;
    if (fixpid_reaction_model(&c, &process)) {
        claim(was.state == FIXPID_REACTION_DONE);
        claim(process.noise_q4 == ((4u * was.band) & 0xFFFFu));
    } else {
        claim(was.state != FIXPID_REACTION_DONE);
        claim(same_process(&process, &before));
    }
}

static bool same_gains(const struct fixpid_pid_gains *a,
                       const struct fixpid_pid_gains *b)
{
    return (a->kp_q8 == b->kp_q8) && (a->ki_q24 == b->ki_q24) &&
           (a->kd_q8 == b->kd_q8) &&
           (a->derivative_filter == b->derivative_filter);
}

// Any quotient: that it is defined is proved of the model.
uint32_t ratio_contract(uint32_t a, uint32_t b, uint8_t places)
{
    (void)a;
    (void)b;
    pre(places <= 30u);
    return nondet_uint32();
}

// Of any bytes: gains are within their ranges, of one that is done and for a
// rule and a robustness that exist, and otherwise nothing is written. By
// contract: ratio.
void prove_result(void)
{
    const struct fixpid_pid_gains before = nondet_pid_gains();
    const uint8_t rule = nondet_uint8();
    const uint8_t robustness = nondet_uint8();
    struct fixpid_pid_gains gains = before;

    c = nondet_reaction();
    if (fixpid_reaction_result(&c, rule, robustness, &gains)) {
        claim(c.state == FIXPID_REACTION_DONE);
        claim((rule <= 1u) && inside(robustness, 8, 64));
        claim((gains.kp_q8 <= 32767u) && (gains.kd_q8 <= 32255u));
        claim(inside(gains.ki_q24, 8, 0x7FFF0000));
        claim(gains.derivative_filter <= 7u);
        claim((rule == 1u) ||
              ((gains.kd_q8 == 0u) && (gains.derivative_filter == 0u)));
    } else {
        claim(same_gains(&gains, &before));
    }
}
