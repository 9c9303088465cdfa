// SPDX-License-Identifier: MIT
// The divisions by hand of fixpid_reaction: one turn of each, from any values
// that a turn can begin with.
#include "prove.h"

#include "fixpid_reaction.h"

static bool ratio_turn(uint32_t *bits, uint32_t *rest, uint8_t *turn,
                       uint32_t b, uint8_t places);
static bool ninetieths_turn(uint16_t *sum, uint8_t *wholes, uint8_t *turn,
                            uint16_t part, uint16_t whole);

// What the file's other loops have for them. They are not run here.
static uint32_t bits, rest, b;
static uint8_t turn, places;

// clang-format would make other macros of them.
// clang-format off
#define for(head) for (head) if (ratio_turn(&bits, &rest, &turn, b, places))
#include "reaction/fixpid_reaction_result.c"
#undef for
#define for(head) for (head) if (ninetieths_turn(&sum, &wholes, &turn, part, whole))
#include "reaction/fixpid_reaction_more.c"
#undef for
// clang-format on

// Where the turn began that is proved.
static struct {
    number turns; // to go
    number rest;
    number quotient;
    number next; // bit of the dividend
    number sum;
    number wholes;
} began;

static number dividend;

// The dividend's bits that have not yet left; its zeros come last.
static number kept_bits(number turns, number zeros)
{
    return (turns > zeros) ? (turns - zeros) : 0;
}

// Domain: a turn of a division by hand: the rest is below the divisor, unless
// that is 0, and the upper bits are those of the dividend that are left.
static bool reaction_may_divide(number all, number left, number turns,
                                number divisor, number zeros)
{
    const number kept = kept_bits(turns, zeros);

    return inside(turns, 1, 32 + zeros) && (kept <= 32) &&
           (floor_by(all, (unsigned)(32 - kept)) == (dividend & ones(kept))) &&
           ((divisor == 0) || (left < divisor));
}

// Long division: the rest and the next bit of the dividend are the next rest,
// and the divisor if it goes into them, as 0 always does.
static bool is_next(number quotient, number left, number divisor)
{
    const bool goes = (quotient & 1) != 0;
    const number next = (began.rest * 2) + began.next;

    return (floor_by(quotient, 1) == began.quotient) &&
           ((divisor == 0) ? goes : (left == next - (goes ? divisor : 0)));
}

static bool ratio_turn(uint32_t *all, uint32_t *left, uint8_t *turns,
                       uint32_t divisor, uint8_t zeros)
{
    number kept = kept_bits(*turns, zeros);

    claim(reaction_may_divide(*all, *left, *turns, divisor, zeros));
    claim(begins() ? ((*turns == 32u + zeros) && (*left == 0u))
                   : ((*turns == began.turns - 1) &&
                      is_next(*all & ones(32 - kept), *left, divisor)));
    any_turn();
    *all = nondet_uint32();
    *left = nondet_uint32();
    *turns = nondet_uint8();
    assume(reaction_may_divide(*all, *left, *turns, divisor, zeros));
    kept = kept_bits(*turns, zeros);
    began.turns = *turns;
    began.rest = *left;
    began.quotient = *all & ones(32 - kept);
    began.next =
        (kept == 0) ? 0 : (floor_by(dividend, (unsigned)(kept - 1)) & 1);
    return true;
}

// floor(a 2^zeros / divisor), or 2^32 - 1 where that does not hold it.
void prove_ratio(void)
{
    const uint32_t a = nondet_uint32();
    const uint32_t divisor = nondet_uint32();
    const uint8_t zeros = nondet_uint8();
    number found;
    bool goes;

    assume(divisor <= (uint32_t)1 << 31);
    assume(zeros <= 30u);
    dividend = a;
    found = ratio(a, divisor, zeros);
    goes = (began.rest * 2) + began.next >= divisor;
    if ((began.turns <= zeros) && (began.quotient >= (number)1 << 31)) {
        claim(found == UINT32_MAX);
    } else if (began.turns == 1) {
        claim(found == (began.quotient * 2) + (goes ? 1 : 0));
    }
}

// Domain: a turn of 90 additions: the sum is below the whole, and no more
// wholes were taken out of it than turns are done.
static bool reaction_may_add(number sum, number wholes, number turns,
                             number whole)
{
    return inside(turns, 1, 90) && (sum < whole) && (wholes + turns <= 90);
}

static bool ninetieths_turn(uint16_t *sum, uint8_t *wholes, uint8_t *turns,
                            uint16_t part, uint16_t whole)
{
    const number more = (number)*wholes - began.wholes;

    claim(reaction_may_add(*sum, *wholes, *turns, whole));
    claim(begins() ? ((*sum == 0u) && (*wholes == 0u) && (*turns == 90u))
                   : ((*turns == began.turns - 1) && inside(more, 0, 1) &&
                      (*sum == began.sum + part - ((more == 1) ? whole : 0))));
    any_turn();
    *sum = nondet_uint16();
    *wholes = nondet_uint8();
    *turns = nondet_uint8();
    assume(reaction_may_add(*sum, *wholes, *turns, whole));
    began.turns = *turns;
    began.sum = *sum;
    began.wholes = *wholes;
    return true;
}

// Domain: the part is below the whole.
static bool reaction_is_part(number part, number whole)
{
    return part < whole;
}

// 90 times the part has so many wholes.
void prove_ninetieths(void)
{
    const uint16_t part = nondet_uint16();
    const uint16_t whole = nondet_uint16();
    number found;

    assume(reaction_is_part(part, whole));
    found = ninetieths(part, whole);
    claim((began.turns == 1) &&
          (found == began.wholes + ((began.sum + part >= whole) ? 1 : 0)));
}
