// SPDX-License-Identifier: MIT
// The four kinds of plant: what they make of the drive, and the least squares
// of what is linear in them.
#include <math.h>

#include "parts.h"

// Times the noise's square, for a line that answers to the drive from before
// the recording.
#define UNSEEN 2.5
#define SLOTS 4 // lengths of a step that a motion remembers

// What a step of this length leaves of a and of b, and what of one goes to the
// other.
struct slot {
    double step;
    double keep_a;
    double keep_b;
    double turn;
};

// A plant of gain 1 in motion: a and b are its lags, or the real and imaginary
// part of an oscillation; of an integrator a is the integral.
struct motion {
    const struct identify_plant *plant;
    double a;
    double b;
    double end_a; // where they end with a drive of 1
    double end_b;
    double grows; // a, each second
    double of_a;  // the measurement is of_a a + of_b b
    double of_b;
    double shortest; // difference of steps that counts
    struct slot slots[SLOTS];
    int oldest;
};

static double column[COLUMNS][IDENTIFY_LINES];

int model_numbers(int kind)
{
    return ((kind == IDENTIFY_SECOND) || (kind == IDENTIFY_RINGING)) ? 3 : 2;
}

struct identify_plant model_plant(int kind, struct numbers at)
{
    struct identify_plant p = {.kind = kind, .gain = 1.0};
    const double lag = exp(limited(at.x[0], -60.0, 60.0));
    const double third = fabs(at.x[2]);
    p.dead = fabs(at.x[1]);
    if (kind == IDENTIFY_SECOND) { // equal lags by ones that nearly are
        p.lag = fmax(lag, third);
        p.lag2 = fmin(fmin(lag, third), 0.999 * p.lag);
    } else if (kind == IDENTIFY_INTEGRATING) {
        p.lag2 = fabs(at.x[0]);
    } else {
        p.lag = lag;
        p.damping =
            (kind == IDENTIFY_RINGING) ? limited(third, 0.005, 0.97) : 0.0;
    }
    return p;
}

// ---- In motion ----

static struct motion motion_of(const struct identify_plant *p, double span)
{
    struct motion m = {.plant = p, .end_a = 1.0, .end_b = 1.0, .of_a = 1.0};
    m.shortest = 1e-9 * span;
    for (int k = 0; k < SLOTS; k++) {
        m.slots[k].step = -1.0;
    }
    if (p->kind == IDENTIFY_SECOND) {
        m.of_a = p->lag / (p->lag - p->lag2);
        m.of_b = 1.0 - m.of_a;
    } else if (p->kind == IDENTIFY_INTEGRATING) {
        m.end_a = 0.0;
        m.grows = 1.0;
        m.of_b = -p->lag2;
    } else if (p->kind == IDENTIFY_RINGING) {
        m.end_b = 0.0;
        m.of_b = p->damping / sqrt(1.0 - squared(p->damping));
    }
    return m;
}

static double left_after(double step, double lag)
{
    return (lag > 0.0) ? exp(-fmin(step / lag, 600.0)) : 0.0;
}

static struct slot slot_of(const struct identify_plant *p, double step)
{
    struct slot s = {step, left_after(step, p->lag), left_after(step, p->lag2),
                     0.0};
    if (p->kind == IDENTIFY_INTEGRATING) {
        s.keep_a = 1.0;
    } else if (p->kind == IDENTIFY_RINGING) {
        const double left = left_after(step, p->lag / p->damping);
        const double angle = sqrt(1.0 - squared(p->damping)) * step / p->lag;
        s.keep_a = left * cos(angle);
        s.keep_b = s.keep_a;
        s.turn = left * sin(angle);
    }
    return s;
}

// From one time to another with a drive. Most steps are as long as one of the
// last. Returns the time at which it is.
static double advance(struct motion *m, double now, double then, double drive)
{
    const double step = then - now;
    int k = 0;
    if (!(step > 0.0)) {
        return now;
    }
    while ((k < SLOTS) && !(fabs(step - m->slots[k].step) <= m->shortest)) {
        k++;
    }
    if (k == SLOTS) {
        k = m->oldest;
        m->oldest = (k + 1) % SLOTS;
        m->slots[k] = slot_of(m->plant, step);
    }
    const struct slot *const s = &m->slots[k];
    const double end_a = m->end_a * drive;
    const double end_b = m->end_b * drive;
    const double a = m->a - end_a;
    const double b = m->b - end_b;
    m->a = end_a + (s->keep_a * a) - (s->turn * b) + (m->grows * step * drive);
    m->b = end_b + (s->keep_b * b) + (s->turn * a);
    return then;
}

double model_before(const struct task *task)
{
    return (task->start == IDENTIFY_COLD) ? 0.0 : task->record->before;
}

double model_latest(const struct record *record, int start)
{
    return ((start >= IDENTIFY_MOVING) ? 0.4 : 0.8) * record->span;
}

// The answer to all moves of the drive, at rest before them.
static void answer(const struct task *task, const struct identify_plant *plant,
                   double *to)
{
    const struct record *const r = task->record;
    const struct lines *const in = task->lines;
    const double before = model_before(task);
    struct motion m = motion_of(plant, r->span);
    double now = 0.0;
    double drive = 0.0;
    int next = 0;
    for (int i = 0; i < in->n; i++) {
        while ((next < r->moves) && (r->at[next] + plant->dead <= in->t[i])) {
            now = advance(&m, now, r->at[next] + plant->dead, drive);
            drive = r->to[next++] - before;
        }
        now = advance(&m, now, in->t[i], drive);
        to[i] = (m.of_a * m.a) + (m.of_b * m.b);
    }
}

// What is left of a start that was not at rest. Returns how many columns.
static int remains(const struct task *task, const struct identify_plant *plant,
                   double *first, double *second)
{
    const struct lines *const in = task->lines;
    const double span = task->record->span;
    const bool even = (plant->kind == IDENTIFY_INTEGRATING) ||
                      (task->start == IDENTIFY_DRIFTING);
    struct motion m = motion_of(plant, span);
    m.a = 1.0;
    m.b = (plant->kind == IDENTIFY_RINGING) ? 0.0 : 1.0;
    for (int i = 0; i < in->n; i++) {
        (void)advance(&m, in->t[(i > 0) ? (i - 1) : 0], in->t[i], 0.0);
        first[i] = even ? ((in->t[i] - in->t[0]) / span) : m.a;
        second[i] = m.b;
    }
    return ((plant->kind == IDENTIFY_FIRST) || even) ? 1 : 2;
}

// ---- The linear part ----

double model_product(const struct lines *lines, const double *a,
                     const double *b)
{
    const double *const heavy = lines->heavy;
    double even = 0.0; // neither sum waits for the other
    double odd = 0.0;
    for (int i = 1; i < lines->n; i += 2) {
        even += heavy[i - 1] * a[i - 1] * b[i - 1];
        odd += heavy[i] * a[i] * b[i];
    }
    const int last = lines->n - 1;
    return even + odd +
           ((last % 2 == 0) ? heavy[last] * a[last] * b[last] : 0.0);
}

static void subtract(int n, double factor, const double *part, double *from)
{
    for (int i = 0; i < n; i++) {
        from[i] -= factor * part[i];
    }
}

// Lines before the dead time answer to a drive that nobody has seen, if the
// plant was moving: they cost something and count nothing.
static void begin(const struct task *task, double dead, struct projection *got)
{
    struct lines *const in = task->lines;
    const double square = UNSEEN * squared(task->record->noise);
    const double from = (task->start == IDENTIFY_MOVING) ? dead : 0.0;
    for (int i = 0; i < in->n; i++) {
        column[0][i] = 1.0;
        in->left[i] = in->y[i];
        in->heavy[i] = (in->t[i] < from) ? 0.0 : in->weight[i];
        got->weights += in->weight[i];
        got->square += square * (in->weight[i] - in->heavy[i]);
    }
}

// Makes column k orthogonal to those before it, twice for the rounding. Keeps
// their parts of it in r, and returns the square of what is left of it: of a
// column that the others can make nothing.
static double orthogonal(const struct lines *in, int k, const double *square,
                         double r[COLUMNS][COLUMNS])
{
    const double before = model_product(in, column[k], column[k]);
    for (int turn = 0; turn < 2 * k; turn++) {
        const int j = turn % k;
        if (square[j] > 0.0) {
            const double part =
                model_product(in, column[j], column[k]) / square[j];
            r[j][k] += part;
            subtract(in->n, part, column[j], column[k]);
        }
    }
    const double after = model_product(in, column[k], column[k]);
    return (after > (1e-14 * before)) ? after : 0.0;
}

struct projection model_project(const struct task *task,
                                const struct identify_plant *plant)
{
    struct lines *const in = task->lines;
    struct projection got = {0};
    double r[COLUMNS][COLUMNS] = {{0.0}};
    double square[COLUMNS];
    begin(task, plant->dead, &got);
    got.columns = 2;
    if (task->start >= IDENTIFY_MOVING) {
        got.columns += remains(task, plant, column[1], column[2]);
    }
    answer(task, plant, column[got.columns - 1]);
    for (int k = 0; k < got.columns; k++) {
        square[k] = orthogonal(in, k, square, r);
        if (square[k] > 0.0) {
            got.factor[k] = model_product(in, column[k], in->left) / square[k];
            subtract(in->n, got.factor[k], column[k], in->left);
        }
    }
    for (int k = got.columns - 1; k >= 0; k--) {
        for (int j = k + 1; j < got.columns; j++) {
            got.factor[k] -= r[k][j] * got.factor[j];
        }
    }
    got.square += model_product(in, in->left, in->left);
    got.fresh = square[got.columns - 1];
    return got;
}

double model_error(const struct task *task, struct numbers at)
{
    const struct identify_plant plant = model_plant(task->kind, at);
    const struct projection got = model_project(task, &plant);
    return sqrt(got.square / got.weights);
}
