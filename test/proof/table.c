// SPDX-License-Identifier: MIT
// fixpid_table against its header, whatever its quotients are; and of chips
// that divide by hand the quotient and the product, turn by turn. Where a
// compiler divides, the code is the equation.
#include "prove.h"

#include "fixpid_table.h"

// clang-format would make another macro of each.
// clang-format off
#ifdef _PIC14
static bool product_turn(uint32_t *sum, uint8_t *turn);
#define for(head) for (head) if (product_turn((uint32_t *)&sum, &turn))
#else
static bool rise_turn(uint16_t *rest, uint16_t *low, uint8_t *turn,
                      uint16_t run);
#define for(head) for (head) if (rise_turn(&rest, &low, &turn, run))
#endif
// clang-format on
#include "table/fixpid_table_arith.h"
#undef for

#include "table/fixpid_table.c"

#define MOST 6

static struct fixpid_table_point points[MOST];

static struct fixpid_table any_table(void)
{
    const uint8_t count = nondet_uint8();
    const struct fixpid_table table = {points, count};

    assume(count <= MOST);
    for (unsigned i = 0; i < MOST; i++) {
        points[i].x = nondet_int16();
        points[i].y = nondet_int16();
    }
    return table;
}

// Domain: each point has a greater x than the one before.
static bool table_is_in_order(const struct fixpid_table *table)
{
    for (unsigned i = 1; i < table->count; i++) {
        if (points[i].x <= points[i - 1].x) {
            return false;
        }
    }
    return true;
}

// Domain: the run is at least 1, and the part at most the run.
static bool table_is_part(number part, number run)
{
    return (run >= 1) && (part <= run);
}

// floor(rise * part / run + 1/2), of which is known here only that it is one
// function, is 0..rise, and all or nothing at the ends.
uint16_t __CPROVER_uninterpreted_rise(uint16_t rise, uint16_t part,
                                      uint16_t run);

static uint16_t assume_part(number rise, number part, number run)
{
    const uint16_t q = __CPROVER_uninterpreted_rise(
        (uint16_t)rise, (uint16_t)part, (uint16_t)run);

    assume(q <= rise);
    assume((part != 0) || (q == 0));
    assume((part != run) || (q == rise));
    return q;
}

uint16_t rise_at_contract(uint16_t rise, uint16_t part, uint16_t run)
{
    pre(table_is_part(part, run));
    return assume_part(rise, part, run);
}

// A line rises from its lower end.
static number height(struct fixpid_table_point a, struct fixpid_table_point b,
                     number x)
{
    const number run = (number)b.x - a.x;

    return (a.y <= b.y)
               ? (number)a.y + assume_part((number)b.y - a.y, x - a.x, run)
               : (number)b.y + assume_part((number)a.y - b.y, b.x - x, run);
}

static bool between_two(const struct fixpid_table *table, number y)
{
    for (unsigned i = 1; i < table->count; i++) {
        const number a = points[i - 1].y;
        const number b = points[i].y;

        if (inside(y, a, b) || inside(y, b, a)) {
            return true;
        }
    }
    return false;
}

// At or before the first of points in order, at or after the last one, and
// between any two neighbours. By contract: rise_at.
void prove_at(void)
{
    const struct fixpid_table table = any_table();
    const int16_t x = nondet_int16();
    const uint8_t i = nondet_uint8();
    int16_t y;

    assume(table_is_in_order(&table));
    y = fixpid_table_at(&table, x);
    claim((table.count != 0) || (y == 0));
    if ((table.count != 0) && (x <= points[0].x)) {
        claim(y == points[0].y);
    }
    if ((i == table.count - 1) && (x >= points[i].x)) {
        claim(y == points[i].y);
    }
    if ((i + 1 < table.count) && (x >= points[i].x) && (x < points[i + 1].x)) {
        claim(y == height(points[i], points[i + 1], x));
    }
}

// Of points in any order: it ends, reads none but them, divides by none but
// runs, and gives a y between two neighbours. By contract: rise_at.
void prove_disorder(void)
{
    const struct fixpid_table table = any_table();
    const int16_t y = fixpid_table_at(&table, nondet_int16());

    claim((table.count < 2) || between_two(&table, y));
}

// Two points or more, in order.
void prove_valid(void)
{
    const struct fixpid_table table = any_table();

    claim(fixpid_table_valid(&table) ==
          ((table.count >= 2) && table_is_in_order(&table)));
}

// Whatever it divides, it ends and does nothing undefined.
void prove_rise_at(void)
{
    const uint16_t run = nondet_uint16();
    const uint16_t part = nondet_uint16();

    assume(table_is_part(part, run));
    (void)rise_at(nondet_uint16(), part, run);
}

#if defined(_PIC14) || defined(_PIC18)
// Where the turn began that is proved.
static struct {
    number turns; // to go
    number rest;
    number quotient;
    number next; // bit of the dividend
    number sum;  // a times the bits of b that are done
    number bit;  // of b
} began;

static number run_of;
static number dividend;

// rise * part, with a part of the run at most: it may be any such number.
uint32_t __CPROVER_uninterpreted_dividend(uint16_t a, uint16_t b);

static uint32_t assume_dividend(uint16_t a, uint16_t b)
{
    const uint32_t p = __CPROVER_uninterpreted_dividend(a, b);

    assume(p <= (run_of << 16) - run_of);
    return p;
}

uint32_t product_contract(uint16_t a, uint16_t b)
{
    const uint32_t p = assume_dividend(a, b);

    dividend = p + floor_by(run_of, 1);
    return p;
}

// Of the quotient there are 16 - turns bits, of the dividend's lower half the
// others.
static bool is_divided(number rest, number low, number turns)
{
    return inside(turns, 0, 16) && (rest < run_of) &&
           (floor_by(low, (unsigned)(16 - turns)) == (dividend & ones(turns)));
}

// Domain: a turn of a division by hand: the rest is below the run, and the
// lower bits are those of the dividend.
static bool table_may_divide(number rest, number low, number turns)
{
    return (turns != 0) && is_divided(rest, low, turns);
}

// Long division: the rest and the next bit of the dividend are the next rest,
// and the run if it goes into them.
static bool is_next(number rest, number quotient, number turns)
{
    return (turns == began.turns - 1) &&
           (floor_by(quotient, 1) == began.quotient) &&
           (rest == (began.rest * 2) + began.next -
                        (((quotient & 1) != 0) ? run_of : 0));
}

static bool rise_turn(uint16_t *rest, uint16_t *low, uint8_t *turn,
                      uint16_t run)
{
    claim((run == run_of) && is_divided(*rest, *low, *turn) &&
          (begins() ? ((*turn == 16u) && (*rest == floor_by(dividend, 16)))
                    : is_next(*rest, *low & ones(16 - (number)*turn), *turn)));
    any_turn();
    *rest = nondet_uint16();
    *low = nondet_uint16();
    *turn = nondet_uint8();
    assume(table_may_divide(*rest, *low, *turn));
    began.turns = *turn;
    began.rest = *rest;
    began.quotient = *low & ones(16 - (number)*turn);
    began.next = floor_by(dividend, *turn - 1u) & 1;
    return true;
}

// floor(rise * part / run + 1/2). By contract: product.
void prove_rise(void)
{
    const uint16_t run = nondet_uint16();
    const uint16_t part = nondet_uint16();
    number found;

    assume(table_is_part(part, run));
    run_of = run;
    found = rise_at(nondet_uint16(), part, run);
    claim((began.turns == 1) &&
          (found ==
           (began.quotient * 2) + ((began.rest * 2) + began.next >= run)));
}

// A product of bytes, of which is known that it is one function.
uint16_t __CPROVER_uninterpreted_bytes(uint8_t a, uint8_t b);

static uint16_t assume_bytes(uint8_t a, uint8_t b)
{
    const uint16_t p = __CPROVER_uninterpreted_bytes(a, b);

    assume(p <= 255u * 255u);
    return p;
}

uint16_t fixpid_8x8_contract(uint8_t a, uint8_t b)
{
    return assume_bytes(a, b);
}

static uint16_t a;
static uint16_t b;

// a * b by the bits of b: 16 - turns are done, the others are below the sum.
static bool is_multiplied(number sum, number turns)
{
    return inside(turns, 0, 16) &&
           ((sum & ones(turns)) == floor_by(b, (unsigned)(16 - turns)));
}

// Domain: a turn of a product by hand: the lower bits are those of b that are
// left.
static bool table_may_multiply(number sum, number turns)
{
    return (turns != 0) && is_multiplied(sum, turns);
}

static bool product_turn(uint32_t *sum, uint8_t *turn)
{
    claim(is_multiplied(*sum, *turn) &&
          (begins() ? ((*turn == 16u) && (floor_by(*sum, 16) == 0))
                    : ((*turn == began.turns - 1) &&
                       (floor_by(*sum, *turn) ==
                        began.sum +
                            (began.bit * ((number)a << (16 - began.turns)))))));
    any_turn();
    *sum = nondet_uint32();
    *turn = nondet_uint8();
    assume(table_may_multiply(*sum, *turn));
    began.turns = *turn;
    began.sum = floor_by(*sum, *turn);
    began.bit = *sum & 1;
    return true;
}

#ifdef _PIC14
// By the bits of one.
void prove_product_by_bits(void)
{
    number found;

    a = nondet_uint16();
    b = nondet_uint16();
    found = product(a, b);
    claim((began.turns == 1) &&
          (found == began.sum + (began.bit * ((number)a << 15))));
}
#else
// By the bytes of both. By contract: fixpid_8x8.
void prove_product_by_bytes(void)
{
    const uint8_t low_a = nondet_uint8();
    const uint8_t low_b = nondet_uint8();
    const uint8_t high_a = nondet_uint8();
    const uint8_t high_b = nondet_uint8();

    claim(product((uint16_t)(((unsigned)high_a << 8) | low_a),
                  (uint16_t)(((unsigned)high_b << 8) | low_b)) ==
          ((number)fixpid_8x8_contract(high_a, high_b) << 16) +
              ((number)fixpid_8x8_contract(high_a, low_b) << 8) +
              ((number)fixpid_8x8_contract(low_a, high_b) << 8) +
              fixpid_8x8_contract(low_a, low_b));
}
#endif
#endif
