// SPDX-License-Identifier: MIT
// The numbers of a model with the least error: a grid, and from its best place
// for each dead time Nelder and Mead's simplex.
#include <math.h>

#include "parts.h"

#define DEADS 10
#define TURNS 60
#define FINE 1e-9
#define FAR (2.5 * 1.4826) // times the median of sizes: what is far away

struct corner {
    struct numbers at;
    double error;
};

// With a dead time that is too late anything fits: the lines before it, which
// answer to a drive that nobody has seen.
static struct corner corner_at(const struct task *task, struct numbers at)
{
    const bool late = fabs(at.x[1]) >= model_latest(task->record, task->start);
    return (struct corner){at, late ? 1e300 : model_error(task, at)};
}

// The first sides of a simplex: parts of the lag.
static struct numbers sides_of(const struct task *task, struct numbers at,
                               double part)
{
    const struct identify_plant p = model_plant(task->kind, at);
    const double span = task->record->span;
    const bool integrating = task->kind == IDENTIFY_INTEGRATING;
    const double scale =
        integrating ? (p.lag2 + p.dead + (0.001 * span)) : p.lag;
    return (struct numbers){
        {integrating ? (part * scale) : part, part * fmin(scale, 0.1 * span),
         (task->kind == IDENTIFY_RINGING) ? (0.3 * part) : (part * scale)}};
}

// The least error first.
static void sort(struct corner *corners, int n)
{
    for (int i = 1; i < n; i++) {
        const struct corner one = corners[i];
        int to = i;
        for (; (to > 0) && (corners[to - 1].error > one.error); to--) {
            corners[to] = corners[to - 1];
        }
        corners[to] = one;
    }
}

static struct corner better(struct corner a, struct corner b)
{
    return (b.error < a.error) ? b : a;
}

// A corner on the line from the worst of n + 1 through the middle of the
// others, so many times as far behind it.
static struct corner beyond(const struct task *task,
                            const struct corner *corners, int n, double far)
{
    struct numbers at = {{0.0}};
    for (int k = 0; k < n; k++) {
        for (int c = 0; c < n; c++) {
            at.x[k] += corners[c].at.x[k] * (1.0 + far) / n;
        }
        at.x[k] -= far * corners[n].at.x[k];
    }
    return corner_at(task, at);
}

// Where else to look after a first try behind the middle; 0: nowhere.
static double other_place(double error, const struct corner *corners, int n)
{
    return (error < corners[0].error)       ? 2.0
           : (error < corners[n - 1].error) ? 0.0
           : (error < corners[n].error)     ? 0.5
                                            : -0.5;
}

// One turn of the simplex.
static void turn(const struct task *task, struct corner *corners, int n)
{
    struct corner one = beyond(task, corners, n, 1.0);
    const double far = other_place(one.error, corners, n);
    if (far != 0.0) {
        one = better(one, beyond(task, corners, n, far));
    }
    if (one.error < corners[n].error) {
        corners[n] = one;
    } else { // all towards the best
        for (int c = 1; c <= n; c++) {
            struct numbers at = corners[c].at;
            for (int k = 0; k < n; k++) {
                at.x[k] = (at.x[k] + corners[0].at.x[k]) / 2.0;
            }
            corners[c] = corner_at(task, at);
        }
    }
    sort(corners, n + 1);
}

// Until the corners' errors are within a part of the least.
static struct corner lowest(const struct task *task, struct numbers from,
                            double part, double tolerance)
{
    const struct numbers sides = sides_of(task, from, part);
    const int n = model_numbers(task->kind);
    struct corner corners[NUMBERS + 1];
    corners[0] = corner_at(task, from);
    for (int k = 0; k < n; k++) {
        struct numbers at = from;
        at.x[k] += sides.x[k];
        corners[k + 1] = corner_at(task, at);
    }
    sort(corners, n + 1);
    for (int i = 0; i < TURNS; i++) {
        if (corners[n].error <= (1.0 + tolerance) * corners[0].error) {
            break;
        }
        turn(task, corners, n);
    }
    return corners[0];
}

// Lags from 0.002 to about 3 of the recording, and with each of them thirds:
// of a second lag by the first one, or a damping.
struct grid {
    double factor;
    double third[3];
    int lags;
    int thirds;
};

// The best place of a grid, for one of the dead times, which are parts of the
// lag or of the recording.
static struct corner best_place(const struct task *task, int dead)
{
    static const double OF_LAG[DEADS] = {0.0, 0.1, 0.3, 1.0, 3.0};
    static const double OF_SPAN[DEADS] = {0.0,  0.0,  0.0,  0.0, 0.0,
                                          0.01, 0.03, 0.08, 0.2, 0.4};
    static const struct grid GRIDS[IDENTIFY_KINDS] = {
        [IDENTIFY_FIRST] = {1.8, {0.0}, 13, 1},
        [IDENTIFY_SECOND] = {1.8, {0.08, 0.4, 0.9}, 13, 3},
        [IDENTIFY_INTEGRATING] = {1.8, {0.0}, 13, 1},
        [IDENTIFY_RINGING] = {1.25, {0.1, 0.3, 0.6}, 33, 3}};
    const struct grid *const grid = &GRIDS[task->kind];
    const double span = task->record->span;
    const bool ringing = task->kind == IDENTIFY_RINGING;
    const bool integrating = task->kind == IDENTIFY_INTEGRATING;
    struct corner best = {{{0.0}}, 1e300};
    double lag = 0.002 * span;
    for (int i = 0; i < grid->lags; i++) {
        const double time = (OF_LAG[dead] * lag) + (OF_SPAN[dead] * span);
        for (int k = 0; (k < grid->thirds) && (time < 0.6 * span); k++) {
            const double third = grid->third[k] * (ringing ? 1.0 : lag);
            const struct numbers at = {
                {integrating ? lag : log(lag), time, third}};
            best = better(best, corner_at(task, at));
        }
        lag *= grid->factor;
    }
    return best;
}

// A search from the best place of all finds aliases: of another dead time, and
// of a gain with the other sign.
struct numbers search_all(const struct task *task)
{
    struct corner best = {{{0.0}}, 1e300};
    for (int dead = 0; dead < DEADS; dead++) {
        const struct corner place = best_place(task, dead);
        best = better(best, lowest(task, place.at, 0.3, 1e-4));
    }
    return lowest(task, best.at, 0.1, FINE).at;
}

// Huber's weights: what is far away counts by its distance, not its square.
static void weigh(struct lines *in)
{
    static double sizes[IDENTIFY_LINES];
    int n = 0;
    for (int i = 0; i < in->n; i++) {
        if (in->heavy[i] > 0.0) {
            sizes[n++] = fabs(in->left[i]);
        }
    }
    const double far = (n > 0) ? (FAR * nth(sizes, n, n / 2)) : 0.0;
    for (int i = 0; i < in->n; i++) {
        const double size = fabs(in->left[i]);
        const bool is_far = (far > 0.0) && (size > far) && (in->heavy[i] > 0.0);
        in->weight[i] = in->use[i] * (is_far ? (far / size) : 1.0);
    }
}

void search_unweigh(struct lines *lines)
{
    for (int i = 0; i < lines->n; i++) {
        lines->weight[i] = lines->use[i];
    }
}

void search_weigh(const struct task *task, const struct identify_plant *plant)
{
    for (int i = 0; i < 4; i++) { // the linear part moves with the weights
        (void)model_project(task, plant);
        weigh(task->lines);
    }
}

struct numbers search_near(const struct task *task, struct numbers from,
                           double part)
{
    search_unweigh(task->lines);
    for (int i = 0; i < 2; i++) {
        const struct identify_plant plant = model_plant(task->kind, from);
        search_weigh(task, &plant);
        from = lowest(task, from, part, FINE).at;
    }
    return from;
}
