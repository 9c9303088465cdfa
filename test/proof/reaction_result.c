// SPDX-License-Identifier: MIT
// What an experiment of fixpid_reaction comes to: the tangent, the process and
// the gains are the equations of its header in whole numbers, whatever their
// quotients are, which reaction_turns.c has.
#include "reaction.h"

#include "reaction/fixpid_reaction.c"
#include "reaction/fixpid_reaction_result.c"

struct fixpid_pid_gains nondet_pid_gains(void);
struct fixpid_reaction_process nondet_process(void);

uint16_t fixpid_reaction_scaled_contract(const struct fixpid_reaction *self,
                                         uint16_t counts)
{
    return (uint16_t)((uint32_t)counts << (self->scale & 7u));
}

// floor(a 2^places / b), of which is known here only that it is one function.
uint32_t __CPROVER_uninterpreted_ratio(uint32_t a, uint32_t b, uint8_t places);

uint32_t ratio_contract(uint32_t a, uint32_t b, uint8_t places)
{
    pre((b <= (uint32_t)1 << 31) && (places <= 30u));
    return __CPROVER_uninterpreted_ratio(a, b, places);
}

static number ratio_of(number a, number b, number places)
{
    claim(inside(a, 0, UINT32_MAX) && inside(b, 0, UINT32_MAX));
    return __CPROVER_uninterpreted_ratio((uint32_t)a, (uint32_t)b,
                                         (uint8_t)places);
}

// Where the record has risen most in two blocks, the first of equals, and by
// how much.
struct steepest {
    number place, rise;
};

static struct steepest steepest_of(const struct curve *at)
{
    struct steepest found = {.place = 2};

    for (unsigned j = 2; j < 8u; j++) {
        const number rise = at->m[j] - at->m[j - 2u];

        if ((j < at->blocks) && (rise > found.rise)) {
            found.place = j;
            found.rise = rise;
        }
    }
    return found;
}

// Of any bytes, too, it is a place of the record.
void prove_steepest(void)
{
    uint16_t rise = nondet_uint16();
    struct curve at;
    struct steepest wanted;
    number from;

    c = nondet_reaction();
    at = curve_of(&c);
    from = steepest(&c, &rise);
    claim(inside(from, 0, 5));
    if (c.state != LISTENS) {
        wanted = steepest_of(&at);
        claim((from == wanted.place - 2) && (rise == wanted.rise));
    }
}

// What the slope, carried back to where the output changed, misses the start
// by, with half the band and one and a half steps of slope; in quarters. The
// tangent goes through the middle of three blocks, whose sum is twice the
// lowest and the middle one and the rise.
static number height_by_rule(const struct curve *at, number place, number rise,
                             number origin)
{
    const number *const m = &at->m[place];
    // A solver is slow at products of other widths than the code's.
    number height = (int32_t)rise * (int32_t)(uint8_t)(place - 1);

    height = 2 * (height + (2 * origin) - m[-2] - m[-1]);
    height += floor_by(at->base * ((number)1 << at->places), 2);
    return greater(height, 0) + (at->band << (at->places + 1)) +
           floor_by(3 * rise, (unsigned)at->doubled);
}

static uint16_t origin_is;

uint16_t fixpid_reaction_origin_contract(const struct fixpid_reaction *self)
{
    (void)self;
    return origin_is;
}

// Of each length of a block and each scale. By contract:
// fixpid_reaction_scaled, fixpid_reaction_origin.
void prove_height(void)
{
    for (unsigned form = 0; form < 12u; form++) {
        const uint8_t place = nondet_uint8();
        struct curve at;
        number rise;
        number wanted;

        assume(inside(place, 2, 7));
        c = nondet_reaction();
        c.scale = (uint8_t)(form % 5u);
        c.doubled = (uint8_t)(form + 1u);
        assume(reaction_has_record(&c));
        origin_is = (uint16_t)clamp(nondet_uint16(), 0, 16384);
        at = curve_of(&c);
        rise = at.m[place] - at.m[place - 2u];
        if ((place < at.blocks) && (rise >= 0)) {
            wanted = height_by_rule(&at, place, rise, origin_is);
            claim(height_of(&c, (uint8_t)(place - 2u), (uint16_t)rise) ==
                  wanted);
            claim(wanted < (number)1 << 20);
        }
    }
}

uint8_t steepest_contract(const struct fixpid_reaction *self, uint16_t *rise)
{
    const struct curve at = curve_of(self);
    const struct steepest found = steepest_of(&at);

    *rise = (uint16_t)found.rise;
    return (uint8_t)(found.place - 2);
}

static number height_is;

uint32_t height_of_contract(const struct fixpid_reaction *self, uint8_t from,
                            uint16_t rise)
{
    pre(inside(from, 0, 5) &&
        (rise == self->record[from + 2u] - self->record[from]));
    return (uint32_t)height_is;
}

// Of factors that are powers of two, as a solver is slow at other products. By
// contract: steepest, height_of, ratio.
void prove_tangent(void)
{
    for (unsigned bits = 8; bits <= 10u; bits++) {
        struct fixpid_reaction_process process = nondet_process();
        struct steepest steep;
        struct curve at;
        number change;
        number height;
        number kp;

        c = nondet_reaction();
        assume(reaction_is_done(&c));
        at = curve_of(&c);
        steep = steepest_of(&at);
        height_is = clamp(nondet_uint32(), 0, ((number)1 << 20) - 1);
        height = floor_by(height_is << bits, 8);
        change = size_of((number)c.output_drive - c.output_rest);
        kp = take_tangent(&c, (uint16_t)(1u << bits), &process);
        claim(kp == ratio_of(change, height, at.places + 10));
        claim(process.slope_q24 ==
              ratio_of(steep.rise, change, 23 - at.doubled - at.places));
        claim(process.dead_q4 == ratio_of(height, steep.rise, at.doubled + 3));
        claim(process.noise_q4 == 4 * at.band);
    }
}

static struct {
    number factor;
    uint32_t kp;
    struct fixpid_reaction_process process;
} tangent;

uint32_t take_tangent_contract(const struct fixpid_reaction *self,
                               uint16_t factor,
                               struct fixpid_reaction_process *process)
{
    claim((self->state == FIXPID_REACTION_DONE) && (factor == tangent.factor));
    *process = tangent.process;
    return tangent.kp;
}

static bool same_process(const struct fixpid_reaction_process *a,
                         const struct fixpid_reaction_process *b)
{
    return (a->slope_q24 == b->slope_q24) && (a->dead_q4 == b->dead_q4) &&
           (a->noise_q4 == b->noise_q4);
}

// Of any bytes. By contract: take_tangent.
void prove_model(void)
{
    const struct fixpid_reaction_process before = nondet_process();
    struct fixpid_reaction_process process = before;
    bool done;

    c = nondet_reaction();
    done = c.state == FIXPID_REACTION_DONE;
    tangent.factor = 256;
    tangent.process = nondet_process();
    claim(fixpid_reaction_model(&c, &process) == done);
    claim(same_process(&process, done ? &tangent.process : &before));
}

static bool legal_gains(number kp, number ki, number kd)
{
    return (kp <= 32767) && inside(ki, 8, 0x7FFF0000) && (kd <= 32255);
}

// `delays` is 2.52 delays at SAFE, x 16.
static bool pi_by_rule(number kp, number delays, struct fixpid_pid_gains *gains)
{
    const number ki = ratio_of(kp, 3 * delays, 20);

    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = (uint32_t)ki;
    gains->kd_q8 = 0;
    gains->derivative_filter = 0;
    return legal_gains(kp, ki, 0);
}

// `kp` has one bit, as a solver is slow at other products.
static bool pid_by_rule(unsigned bit, number delays,
                        struct fixpid_pid_gains *gains)
{
    const number kp = ((number)1 << bit) + (((number)1 << bit) >> 2);
    const number ki = ratio_of(kp, 2 * delays, 20);
    unsigned filter = 1;
    number rest;
    number kd;

    for (number lag = floor_by(delays, 10); (lag > 1) && (filter < 7u);
         filter++) {
        lag = floor_by(lag, 1);
    }
    rest = floor_by(delays, filter);
    kd = floor_by((rest << bit) + ((bit < 2u) ? 0 : (rest << (bit - 2u))), 7);
    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = (uint32_t)ki;
    gains->kd_q8 = (uint16_t)kd;
    gains->derivative_filter = (uint8_t)filter;
    return (rest <= 65535) && legal_gains(kp, ki, kd);
}

static void claim_gains(const struct fixpid_pid_gains *gains,
                        const struct fixpid_pid_gains *wanted)
{
    claim((gains->kp_q8 == wanted->kp_q8) &&
          (gains->ki_q24 == wanted->ki_q24) &&
          (gains->kd_q8 == wanted->kd_q8) &&
          (gains->derivative_filter == wanted->derivative_filter));
}

// Of any bytes: there are gains of one that is done, for a rule and robustness
// that exist, and otherwise nothing is written. By contract: take_tangent,
// ratio.
void prove_result(void)
{
    const struct fixpid_pid_gains before = nondet_pid_gains();
    const uint8_t rule = nondet_uint8();
    const uint8_t robustness = nondet_uint8();
    struct fixpid_pid_gains wanted = before;
    struct fixpid_pid_gains gains = before;
    bool given;

    c = nondet_reaction();
    tangent.factor = 19 * ((number)robustness + 18);
    tangent.process = nondet_process();
    tangent.kp = nondet_uint32();
    given = (c.state == FIXPID_REACTION_DONE) && (tangent.kp <= 32767u) &&
            (tangent.process.dead_q4 < (uint32_t)1 << 26) && (rule <= 1u) &&
            inside(robustness, 8, 64);
    if (fixpid_reaction_result(&c, rule, robustness, &gains)) {
        claim(given && legal_gains(gains.kp_q8, gains.ki_q24, gains.kd_q8));
        claim(gains.derivative_filter <= 7u);
        given = (rule != FIXPID_REACTION_PI) ||
                pi_by_rule(tangent.kp, tangent.process.dead_q4, &wanted);
        claim(given);
    } else {
        claim(!given || (rule != FIXPID_REACTION_PI) ||
              !pi_by_rule(tangent.kp, tangent.process.dead_q4, &wanted));
        wanted = before;
    }
    if (!given || (rule == FIXPID_REACTION_PI)) {
        claim_gains(&gains, &wanted);
    }
}

// By contract: ratio.
void prove_result_pid(void)
{
    for (unsigned bit = 0; bit < 15u; bit++) {
        const struct fixpid_pid_gains before = nondet_pid_gains();
        const uint32_t delays = nondet_uint32();
        struct fixpid_pid_gains wanted = before;
        struct fixpid_pid_gains gains = before;
        bool given;

        assume(delays < ((number)1 << 26));
        given = pid_by_rule(bit, delays, &wanted);
        wanted = given ? wanted : before;
        claim(take_gains(&gains, 1, (uint32_t)1 << bit, delays) == given);
        claim_gains(&gains, &wanted);
    }
}

// Of any bytes that are done: nothing undefined. By contract: ratio.
void prove_total_result(void)
{
    struct fixpid_reaction_process process;
    struct fixpid_pid_gains gains;

    c = nondet_reaction();
    (void)fixpid_reaction_model(&c, &process);
    (void)fixpid_reaction_result(&c, nondet_uint8(), nondet_uint8(), &gains);
}
