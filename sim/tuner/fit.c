// SPDX-License-Identifier: MIT
#include "fit.h"

#include <math.h>

#define LOWEST (-32768)
#define HIGHEST 32767

// A line is followed from some y of each x where a point may stand: so many,
// evenly over what is allowed there.
#define CHOICES 11
#define BEGINNINGS 15

// A line ends as far as it can or a little before: at so many places, apart by
// a part of its length.
#define ENDS 10
#define PARTS 80

// What does not come near the farthest is dropped: so much of the way from the
// last point.
#define NEAR 0.12

#define HALVINGS 40
#define FINE 1e-4 // of the error, where halving ends

static int64_t floor_div(int64_t a, int64_t b)
{
    const int64_t quotient = a / b;
    return ((a % b) < 0) ? (quotient - 1) : quotient;
}

static int64_t ceil_div(int64_t a, int64_t b)
{
    return -floor_div(-a, b);
}

// Over every x, by the table itself.
static double error_of(const struct fit *self)
{
    const struct fixpid_table table = {self->points, (uint8_t)self->count};
    double most = 0.0;

    for (int32_t x = self->first; x <= self->last; x++) {
        const int16_t y = fixpid_table_at(&table, (int16_t)x);
        most = fmax(most, fabs(y - self->f[x - self->first]));
    }
    return most;
}

// ---- One line ----

// Twice the height of the line's upper or lower end at t above y0: the table
// rounds half up, so the line may be from low - 1/2 to below high + 1/2.
static int64_t upper(const struct fit *self, struct fit_place from, int32_t t)
{
    return (2 * (int64_t)(self->high[from.at + t] - from.y)) + 1;
}

static int64_t lower(const struct fit *self, struct fit_place from, int32_t t)
{
    return (2 * (int64_t)(self->low[from.at + t] - from.y)) - 1;
}

// Follows all lines from a place at once, as a cone of slopes, until none is
// left. Each t gets the two that bound it, of those before; 0 is no bound.
// Returns the last t.
static int32_t follow(struct fit *self, struct fit_place from)
{
    const int32_t most = self->last - self->first - from.at;
    int64_t over = 0;
    int64_t under = 0;
    int32_t steep = 0;
    int32_t flat = 0;

    for (int32_t t = 1; t <= most; t++) {
        self->steepest[t] = steep;
        self->flattest[t] = flat;
        // |2 dy + 1| < 2^18 and t < 2^16: products are below 2^34.
        const int64_t up = upper(self, from, t);
        const int64_t down = lower(self, from, t);
        if ((steep == 0) || ((up * steep) < (over * t))) {
            over = up;
            steep = t;
        }
        if ((flat == 0) || ((down * flat) > (under * t))) {
            under = down;
            flat = t;
        }
        if ((under * steep) >= (over * flat)) {
            return t;
        }
    }
    return most;
}

// The least and the greatest y at which a line of the cone may end at t; none
// where the least is greater.
struct ends {
    int32_t low;
    int32_t high;
};

static struct ends ends_at(const struct fit *self, struct fit_place from,
                           int32_t t)
{
    struct ends y = {self->low[from.at + t], self->high[from.at + t]};
    const int32_t steep = self->steepest[t];
    const int32_t flat = self->flattest[t];

    if (steep != 0) {
        const int64_t most =
            ceil_div(upper(self, from, steep) * t, 2 * (int64_t)steep) - 1;
        y.high = (most + from.y < y.high) ? (int32_t)(most + from.y) : y.high;
    }
    if (flat != 0) {
        const int64_t least =
            ceil_div(lower(self, from, flat) * t, 2 * (int64_t)flat);
        y.low = (least + from.y > y.low) ? (int32_t)(least + from.y) : y.low;
    }
    return y;
}

// ---- The places of one point ----

static bool before(const struct fit_place *a, const struct fit_place *b)
{
    return (a->at != b->at) ? (a->at > b->at) : (a->y > b->y);
}

// Where a place belongs among those that are kept, in their order; FIT_KEPT
// where there is no room for it or it is there already.
static int32_t room_for(const struct fit_place *all, int32_t kept,
                        const struct fit_place *found)
{
    int32_t to = kept;

    while ((to > 0) && before(found, &all[to - 1])) {
        to--;
    }
    return ((to > 0) && !before(&all[to - 1], found)) ? FIT_KEPT : to;
}

// Keeps the farthest places, each once.
static void keep(struct fit *self, int stage, struct fit_place found)
{
    struct fit_place *const all = self->places[stage];
    const int32_t to = room_for(all, self->kept[stage], &found);

    if (to == FIT_KEPT) {
        return;
    }
    self->kept[stage] += (self->kept[stage] < FIT_KEPT) ? 1 : 0;
    for (int32_t i = self->kept[stage] - 1; i > to; i--) {
        all[i] = all[i - 1];
    }
    all[to] = found;
}

static void keep_some(struct fit *self, int stage, struct fit_place found,
                      struct ends y, int choices)
{
    for (int i = 0; (i < choices) && (y.low <= y.high); i++) {
        found.y = y.low + (((y.high - y.low) * i) + ((choices - 1) / 2)) /
                              (choices - 1);
        keep(self, stage, found);
    }
}

// All ends of the lines from one place of the stage before.
static void keep_ends(struct fit *self, int stage, int32_t index)
{
    const struct fit_place from = self->places[stage - 1][index];
    const int32_t end = self->last - self->first;
    int32_t t = follow(self, from);
    struct ends y = ends_at(self, from, t);

    while ((y.low > y.high) && (t > 1)) {
        t--;
        y = ends_at(self, from, t);
    }
    keep_some(self, stage, (struct fit_place){from.at + t, 0, index}, y,
              CHOICES);
    // Places that lines from elsewhere end at, too, are the same ones.
    const int32_t part = (t > PARTS) ? (t / PARTS) : 1;
    int32_t at = ((from.at + t) / part) * part;
    for (int i = 0; (i < ENDS) && (at > from.at) && (from.at + t < end); i++) {
        keep_some(self, stage, (struct fit_place){at, 0, index},
                  ends_at(self, from, at - from.at), CHOICES);
        at -= part;
    }
}

// Drops what is far behind the farthest. What does not come to the end is of no
// use if another does.
static void drop_far(struct fit *self, int stage)
{
    const struct fit_place *const all = self->places[stage];
    const int32_t behind =
        self->places[stage - 1][self->kept[stage - 1] - 1].at;
    const int32_t farthest = all[0].at;
    int32_t least = farthest - (int32_t)(NEAR * (farthest - behind));

    if (farthest == (self->last - self->first)) {
        least = farthest;
    }
    while (all[self->kept[stage] - 1].at < least) {
        self->kept[stage]--;
    }
}

// ---- The search ----

// False where the error leaves the table nothing at some x.
static bool bound(struct fit *self, double error)
{
    for (int32_t i = 0; i <= (self->last - self->first); i++) {
        const double low = fmax(ceil(self->f[i] - error), LOWEST);
        const double high = fmin(floor(self->f[i] + error), HIGHEST);
        if (low > high) {
            return false;
        }
        self->low[i] = (int32_t)low;
        self->high[i] = (int32_t)high;
    }
    return true;
}

// The points that lead to that place of the last stage which is nearest to the
// function.
static void take(struct fit *self, int stage)
{
    const double wanted = self->f[self->last - self->first];
    int32_t best = 0;

    for (int32_t i = 1; i < self->kept[stage]; i++) {
        const struct fit_place *const all = self->places[stage];
        if (fabs(all[i].y - wanted) < fabs(all[best].y - wanted)) {
            best = i;
        }
    }
    self->count = stage + 1;
    for (int i = stage; i >= 0; i--) {
        const struct fit_place *const place = &self->places[i][best];
        self->points[i].x = (int16_t)(place->at + self->first);
        self->points[i].y = (int16_t)place->y;
        best = place->from;
    }
}

// Points within the error, if so many at most are found: in the result.
static bool reach(struct fit *self, double error, int most)
{
    if (!bound(self, error)) {
        return false;
    }
    self->kept[0] = 0;
    keep_some(self, 0, (struct fit_place){0, 0, 0},
              (struct ends){self->low[0], self->high[0]}, BEGINNINGS);
    for (int stage = 1; stage < most; stage++) {
        self->kept[stage] = 0;
        for (int32_t i = 0; i < self->kept[stage - 1]; i++) {
            keep_ends(self, stage, i);
        }
        drop_far(self, stage);
        if (self->places[stage][0].at == (self->last - self->first)) {
            take(self, stage);
            self->error = error_of(self);
            return true;
        }
    }
    return false;
}

static bool legal(const struct fit *self)
{
    bool good = (self->first < self->last) && (self->first >= LOWEST) &&
                (self->last <= HIGHEST);

    for (int32_t i = 0; good && (i <= (self->last - self->first)); i++) {
        // No number is in no range.
        good = (self->f[i] >= (LOWEST - 0.5)) && (self->f[i] < (HIGHEST + 0.5));
    }
    return good;
}

// Halves what is between an error that is reached, of the result, and one that
// is not. The result is always the best so far.
static void halve(struct fit *self, int most)
{
    double low = 0.0;

    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + self->error) / 2.0;
        if ((self->error - low) < (FINE * self->error)) {
            break;
        }
        if (!reach(self, middle, most)) {
            low = middle;
        }
    }
}

bool fit_least(struct fit *self, int most)
{
    if (!legal(self) || (most < 2) || (most > FIT_POINTS) ||
        !reach(self, 65536.0, most)) {
        return false;
    }
    halve(self, most);
    return true;
}

static bool reach_within(struct fit *self, double error)
{
    return legal(self) && (error >= 0.0) && reach(self, error, FIT_POINTS);
}

// With the error alone to go by, the farthest ends are not always those that
// need the fewest points in all: fewer are tried until the error is missed.
bool fit_within(struct fit *self, double error)
{
    if (!reach_within(self, error)) {
        return false;
    }
    int most = self->count;
    while ((most > 2) && fit_least(self, most - 1) && (self->error <= error)) {
        most = self->count;
    }
    return (fit_least(self, most) && (self->error <= error)) ||
           reach_within(self, error);
}
