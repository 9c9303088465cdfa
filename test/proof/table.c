// SPDX-License-Identifier: MIT
// fixpid_table against its header, whatever its quotients are: those are for
// its unit tests, because a solver is slow at products and quotients.
#include "prove.h"

#include "fixpid_table.h"

#include "table/fixpid_table.c"

#define MOST 6

static struct fixpid_table_point points[MOST];

static struct fixpid_table any_table(void)
{
    struct fixpid_table table = {points, nondet_uint8()};

    assume(table.count <= MOST);
    for (unsigned i = 0; i < MOST; i++) {
        points[i].x = nondet_int16();
        points[i].y = nondet_int16();
    }
    return table;
}

static bool in_order(const struct fixpid_table *table)
{
    for (unsigned i = 1; i < table->count; i++) {
        if (points[i].x <= points[i - 1].x) {
            return false;
        }
    }
    return true;
}

// floor(rise * part / run + 1/2), of which is known here only that it is one
// function, is 0..rise, and all or nothing at the ends.
uint16_t __CPROVER_uninterpreted_rise(uint16_t rise, uint16_t part,
                                      uint16_t run);

static uint16_t part_of(number rise, number part, number run)
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
    pre(run >= 1);
    pre(part <= run);
    return part_of(rise, part, run);
}

// A line rises from its lower end.
static number height(struct fixpid_table_point a, struct fixpid_table_point b,
                     number x)
{
    const number run = (number)b.x - a.x;

    return (a.y <= b.y)
               ? (number)a.y + part_of((number)b.y - a.y, x - a.x, run)
               : (number)b.y + part_of((number)a.y - b.y, b.x - x, run);
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

    assume(in_order(&table));
    y = fixpid_table_at(&table, x);
    claim((table.count != 0) || (y == 0));
    assume(i < table.count);
    if ((i == 0) && (x <= points[0].x)) {
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
          ((table.count >= 2) && in_order(&table)));
}

// Whatever it divides, it ends and does nothing undefined.
void prove_rise_at(void)
{
    const uint16_t run = nondet_uint16();
    const uint16_t part = nondet_uint16();

    assume((run >= 1) && (part <= run));
    (void)rise_at(nondet_uint16(), part, run);
}
