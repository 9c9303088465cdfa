// SPDX-License-Identifier: MIT
// Both functions, over READ, which reads what a pointer points at. An AVR has
// them twice, so that this file has no include guard.
#include "fixpid_table_arith.h"

bool fixpid_table_valid(const struct fixpid_table *self)
{
    uint8_t i;

    FIXPID_ASSERT(self != 0);
    if (self->count < 2u) {
        return false;
    }
    for (i = 1; i < self->count; i++) {
        if (READ(&self->points[i - 1u].x) >= READ(&self->points[i].x)) {
            return false;
        }
    }
    return true;
}

// The search keeps points[low].x <= x < points[high].x, even if the points
// between are not in order: the run is never 0. At most 253 points are between
// the first and the last one, and none after eight halvings.
int16_t fixpid_table_at(const struct fixpid_table *self, int16_t x)
{
    const struct fixpid_table_point *points;
    uint8_t low = 0;
    uint8_t high;
    uint8_t turn;
    int16_t x0;

    FIXPID_ASSERT(self != 0);
    points = self->points;
    if (self->count == 0u) {
        return 0;
    }
    high = (uint8_t)(self->count - 1u);
    if (x <= READ(&points[0].x)) {
        return READ(&points[0].y);
    }
    if (x >= READ(&points[high].x)) {
        return READ(&points[high].y);
    }
    for (turn = 8; turn != 0u; turn--) {
        const uint8_t middle = (uint8_t)(low + ((uint8_t)(high - low) >> 1));

        if (middle == low) {
            break;
        }
        if (x < READ(&points[middle].x)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    x0 = READ(&points[low].x);
    return height_at(READ(&points[low].y), READ(&points[high].y),
                     fixpid_difference(x, x0),
                     fixpid_difference(READ(&points[high].x), x0));
}

#undef READ
