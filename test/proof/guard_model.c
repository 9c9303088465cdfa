// SPDX-License-Identifier: MIT
// fixpid_guard_from_model against the rule of its header, whatever the
// quotients are, and its division turn by turn: a solver is slow at quotients.
#include "prove.h"

#include "fixpid_guard.h"

struct fixpid_guard_config nondet_guard_config(void);
struct fixpid_guard_model nondet_guard_model(void);

struct two_words;
static bool at_turn(struct two_words *value, uint32_t *rest, uint8_t *turn,
                    uint32_t divisor);

// clang-format would make another macro of it.
// clang-format off
#define for(head) for (head) if (at_turn(value, &rest, &turn, divisor))
// clang-format on
#include "guard/fixpid_guard_more.c"
#undef for

struct two_words nondet_wide(void);

static uint64_t bits_of(const struct two_words *value)
{
    return ((uint64_t)value->high << 32) | value->low;
}

// floor(a / b), of which is known here only that it is one function, and at
// most a.
uint64_t __CPROVER_uninterpreted_floor(uint64_t a, uint32_t b);

static number assume_floor(number a, number b)
{
    const uint64_t q = __CPROVER_uninterpreted_floor((uint64_t)a, (uint32_t)b);

    assume(q <= (uint64_t)a);
    return (number)q;
}

void divide_wide_contract(struct two_words *value, uint32_t divisor)
{
    number q;

    pre(divisor != 0u);
    pre(value->high <= 0x7FFFFFFFu);
    q = assume_floor((number)bits_of(value), divisor);
    value->high = (uint32_t)floor_by(q, 32);
    value->low = (uint32_t)q;
}

// ceil(x / 2^bits)
static number ceil_by(number x, unsigned bits)
{
    return -floor_by(-x, bits);
}

static number band_by_rule(const struct fixpid_guard_model *model)
{
    const number noise = ceil_by(8 * (number)model->noise_q4 + 4 * 16, 4);
    const number swing = (model->gain_q8 == UINT32_MAX)
                             ? 0
                             : ceil_by(2 * (number)model->gain_q8, 8);

    if (model->band != 0u) {
        return model->band;
    }
    return (swing > noise) ? swing : noise;
}

// floor((8 bands * band - 1 / 2^24) / slope / range), or more than any patience
// has; of which is known here only that it is one function.
uint32_t __CPROVER_uninterpreted_way(uint32_t slope_q24, uint16_t range,
                                     uint16_t band, uint8_t bands);

uint32_t way_for_contract(uint32_t slope_q24, uint16_t range, uint16_t band,
                          uint8_t bands)
{
    pre((slope_q24 != 0u) && (range != 0u) && (bands != 0u));
    pre(inside(band, 1, 32767));
    return __CPROVER_uninterpreted_way(slope_q24, range, band, bands);
}

// In eighths of a step, of which 2 L has dead_q4, each rounded up: ceil(a / b)
// is floor((a - 1) / b) + 1, and ceil((n + x) / 8) of a whole n is
// ceil((n + ceil(x)) / 8).
static number patience_by_rule(const struct fixpid_guard_model *model,
                               number band, number range)
{
    const uint8_t bands = (model->bands == 0u) ? 20u : model->bands;
    const number way =
        (number)__CPROVER_uninterpreted_way(model->slope_q24, (uint16_t)range,
                                            (uint16_t)band, bands) +
        1;
    const number patience = ceil_by((number)model->dead_q4 + way, 3);

    return (patience < 4) ? 4 : patience;
}

uint32_t counts_in_contract(uint8_t bands, uint16_t band)
{
    pre(inside(band, 1, 32767));
    return assume_product(band, bands, 32767u * 255u);
}

// By contract: divide_wide, counts_in.
void prove_way(void)
{
    const uint32_t slope_q24 = nondet_uint32();
    const uint16_t range = nondet_uint16();
    const uint16_t band = nondet_uint16();
    const uint8_t bands = nondet_uint8();
    number way;

    assume(inside(slope_q24, 1, UINT32_MAX));
    assume(inside(range, 1, UINT16_MAX));
    assume(inside(band, 1, 32767));
    assume(inside(bands, 1, UINT8_MAX));
    way = (number)counts_in_contract(bands, band) * 8 * 0x1000000 - 1;
    way = assume_floor(assume_floor(way, slope_q24), range);
    claim(way_for(slope_q24, range, band, bands) == clamp(way, 0, UINT32_MAX));
}

static bool same_config(const struct fixpid_guard_config *a,
                        const struct fixpid_guard_config *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->measurement_min == b->measurement_min) &&
           (a->measurement_max == b->measurement_max) &&
           (a->reach_min == b->reach_min) && (a->reach_max == b->reach_max) &&
           (a->band == b->band) && (a->patience == b->patience) &&
           (a->reverse == b->reverse) && (a->noisy == b->noisy);
}

// By contract: way_for.
void prove_from_model(void)
{
    const struct fixpid_guard_model model = nondet_guard_model();
    struct fixpid_guard_config config = nondet_guard_config();
    struct fixpid_guard_config expected;
    const number range = (number)config.output_max - config.output_min;
    const number band = band_by_rule(&model);
    bool accepted = false;

    config.reverse = any_bool;
    config.noisy = any_bool;
    expected = config;
    if ((range > 0) && (model.slope_q24 != 0u) && (band <= 32767)) {
        const number patience = patience_by_rule(&model, band, range);

        accepted = patience <= 32767;
        if (accepted) {
            expected.band = (uint16_t)band;
            expected.patience = (uint16_t)patience;
            expected.noisy = (model.noise_q4 >= 16u) && (patience >= 16);
        }
    }
    claim(fixpid_guard_from_model(&config, &model) == accepted);
    claim(same_config(&config, &expected));
}

static uint64_t dividend;

// Where the turn began that is proved.
static struct {
    number turns; // to go
    number rest;
    uint64_t quotient;
    number next; // bit of the dividend
} began;

static uint64_t lowest(number bits)
{
    return (bits == 64) ? ~(uint64_t)0 : (((uint64_t)1 << bits) - 1u);
}

// The upper bits, as many as there are turns, are the dividend's.
static bool is_divided(const struct two_words *value, number rest, number turns,
                       number divisor)
{
    return inside(turns, 1, 64) && (rest < divisor) &&
           ((bits_of(value) >> (64 - turns)) == (dividend & lowest(turns)));
}

// Domain: a turn of a division by hand: the rest is below the divisor, and the
// upper bits are those of the dividend.
static bool guard_may_divide(const struct two_words *value, number rest,
                             number turns, number divisor)
{
    return is_divided(value, rest, turns, divisor);
}

// Long division: the rest and the next bit of the dividend are the next rest,
// and the divisor if it goes into them.
static bool is_next(const struct two_words *value, number rest, number turns,
                    number divisor)
{
    const uint64_t quotient = bits_of(value) & lowest(64 - turns);
    const number taken = ((quotient & 1u) != 0u) ? divisor : 0;

    return (turns == began.turns - 1) && ((quotient >> 1) == began.quotient) &&
           (rest == (began.rest * 2) + began.next - taken);
}

static bool at_turn(struct two_words *value, uint32_t *rest, uint8_t *turn,
                    uint32_t divisor)
{
    claim(is_divided(value, *rest, *turn, divisor) &&
          (begins() ? ((*turn == 64u) && (*rest == 0u))
                    : is_next(value, *rest, *turn, divisor)));
    any_turn();
    *value = nondet_wide();
    *rest = nondet_uint32();
    *turn = nondet_uint8();
    assume(guard_may_divide(value, *rest, *turn, divisor));
    began.turns = *turn;
    began.rest = *rest;
    began.quotient = bits_of(value) & lowest(64 - (number)*turn);
    began.next = (number)((dividend >> (*turn - 1u)) & 1u);
    return true;
}

// The last turn leaves the quotient.
void prove_divide(void)
{
    struct two_words value = nondet_wide();
    const uint32_t divisor = nondet_uint32();
    number rest;
    uint64_t quotient;

    assume(inside(divisor, 1, UINT32_MAX));
    dividend = bits_of(&value);
    divide_wide(&value, divisor);
    rest = (began.rest * 2) + began.next;
    quotient = (began.quotient * 2u) + ((rest >= (number)divisor) ? 1u : 0u);
    claim(began.turns == 1);
    claim(bits_of(&value) == quotient);
}
