// SPDX-License-Identifier: MIT
// The points of a fixpid_table that follow a function best: what Python's
// fixpid.table and the tuner page compute.
//
// The caller has the function's values at all whole x from first to last in f,
// and gets points of whole numbers, which need not lie on the function. The
// error is the largest distance between the function and what the table
// returns, over all these x.
//
// It is a search, not a proof that there are no better points. It needs neither
// a heap nor functions of the system, and is the same on every machine whose
// double is IEEE 754's.
#ifndef FIT_H
#define FIT_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_table.h"

#define FIT_WIDTH 65536 // values of x
#define FIT_POINTS 255  // of a table
#define FIT_KEPT 300    // ends that a search keeps for each point of the table

// A place that a point may have, and the one before it that leads there.
struct fit_place {
    int32_t at; // x - first
    int32_t y;
    int32_t from;
};

struct fit {
    double f[FIT_WIDTH]; // at first, first + 1, .. last
    int32_t first;
    int32_t last;

    // The result.
    struct fixpid_table_point points[FIT_POINTS];
    int32_t count;
    double error;

    // Of the search. Where the table may be at each x, both included; of the
    // line that is followed, the x so far that bound its slope.
    int32_t low[FIT_WIDTH];
    int32_t high[FIT_WIDTH];
    int32_t steepest[FIT_WIDTH];
    int32_t flattest[FIT_WIDTH];
    struct fit_place places[FIT_POINTS][FIT_KEPT];
    int32_t kept[FIT_POINTS];
};

// The least error with so many points at most, 2..255. False where f leaves the
// range of int16_t or is no number, or where first, last or most are illegal.
bool fit_least(struct fit *self, int most);

// The fewest points within this error, and the least error with so many. False
// also where 255 points do not do.
bool fit_within(struct fit *self, double error);

#endif
