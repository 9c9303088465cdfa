// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_table.h"
#include "numbers.h"
#include "numbers_control.h"
#include "rows_table.h"
#include "table_in_flash.h"

#ifdef CALLS_DEFINED
#include "reference_control.h"
#endif

#ifndef POINTS
#define POINTS 24u
#endif

enum { POINT, VERDICT, LOOKUP };

static struct fixpid_table_point points[POINTS];
static struct fixpid_table table = {points, 0};
static bool defined; // whether its points are in order, or one or none

// Points in flash, where an AVR reads them in another way: its runs and rises
// go up to the longest.
static const struct fixpid_table_point steep_points[] PROGMEM = {
    {INT16_MIN, INT16_MAX},
    {-32760, -5},
    {-3000, 20000},
    {-2999, -20000},
    {-2000, -20000},
    {-1500, -1},
    {-1000, 0},
    {-900, 77},
    {-800, 100},
    {-700, -32000},
    {-600, 32000},
    {-50, 31},
    {-49, 32},
    {-3, 33},
    {0, 0},
    {4, 1},
    {9, 0},
    {100, 12345},
    {1000, 12346},
    {1001, -12346},
    {2000, 3},
    {2005, 4},
    {2007, 5},
    {INT16_MAX, -5},
};
static const struct fixpid_table steep = FIXPID_TABLE(steep_points);
static const struct fixpid_table_point long_points[] PROGMEM = {
    {INT16_MIN, INT16_MIN}, {INT16_MAX, INT16_MAX}};
static const struct fixpid_table longest = FIXPID_TABLE(long_points);

static bool is_table(void)
{
    const bool valid = fixpid_table_valid(&table);

    calls_answer(valid ? 1u : 0u,
                 DEFINED(reference_table_valid(&table), valid) ? 1u : 0u);
    return valid;
}

// What a table out of order gives is not defined.
static void look_up(int16_t x)
{
    const uint32_t y = (uint16_t)fixpid_table_at(&table, x);

    calls_answer(
        y, DEFINED(defined ? (uint16_t)reference_table_at(&table, x) : y, y));
}

// On the host, where there is a definition, it reads them like any others.
static void look_up_in_flash(const struct fixpid_table *one, int16_t x)
{
    const uint32_t y = (uint16_t)fixpid_table_at_P(one, x);

    calls_answer(y, DEFINED((uint16_t)reference_table_at(one, x), y));
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        switch (rows_kind[row]) {
        case POINT:
            if (row == 0u || rows_kind[row - 1u] != POINT) {
                table.count = 0;
            }
            points[table.count].x = rows_x[row];
            points[table.count].y = rows_y[row];
            table.count++;
            break;
        case VERDICT:
            if (rows_x[row] == 0) {
                table.count = 0;
            }
            (void)is_table();
            break;
        default:
            defined = true;
            look_up(rows_x[row]);
            break;
        }
    }
}

static void new_table(void)
{
    table.count = numbers_table_points(points, POINTS);
    defined = is_table() || table.count < 2u;
}

void calls_random(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (i == 0u || numbers_one_in(20)) {
            new_table();
        }
        look_up(numbers_table_x(points, table.count));
        look_up_in_flash(&steep, numbers_int16());
        look_up_in_flash(&longest, numbers_int16());
    }
}
