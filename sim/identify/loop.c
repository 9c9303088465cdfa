// SPDX-License-Identifier: MIT
#include "loop.h"

#include <math.h>

#include "parts.h"

#define PI 3.14159265358979323846
#define NONE (-1.0)
#define SIZE (LOOP_STATES + 1) // the states and the input
#define INPUT LOOP_STATES
#define WIDEST 1.05 // from one angle to the next, where the loop is followed

struct number {
    double re;
    double im;
};

struct matrix {
    double of[SIZE][SIZE];
};

// x[n + 1] - x[n] = change x[n] + now u[n - steps] + before u[n - steps - 1],
// and the polynomials of z - 1 that this is from u to y.
struct sampled {
    int states;
    int steps;
    struct matrix change;
    double now[LOOP_STATES];
    double before[LOOP_STATES];
    double top[LOOP_STATES];
    double top_before[LOOP_STATES];
    double bottom[LOOP_STATES];
    const double *c;
    const struct loop_controller *controller;
};

static struct number product(struct number a, struct number b)
{
    return (struct number){(a.re * b.re) - (a.im * b.im),
                           (a.re * b.im) + (a.im * b.re)};
}

static struct number quotient(struct number a, struct number b)
{
    const double square = (b.re * b.re) + (b.im * b.im);
    return (struct number){((a.re * b.re) + (a.im * b.im)) / square,
                           ((a.im * b.re) - (a.re * b.im)) / square};
}

static double size_of(struct number a)
{
    return sqrt((a.re * a.re) + (a.im * a.im));
}

// z^-n at an angle.
static struct number back(double angle, int n)
{
    return (struct number){cos(angle * n), -sin(angle * n)};
}

// 1 - z^-n, as exact at small angles.
static struct number change(double angle, int n)
{
    const double half = sin(angle * n / 2.0);
    return (struct number){2.0 * half * half, sin(angle * n)};
}

// --- The plant -------------------------------------------------------------

void loop_plant_second_order(struct loop_plant *to, const double a[3],
                             double gain)
{
    to->c[0] = 1.0;
    if (a[2] > 0.0) {
        to->states = 2;
        to->a[0][1] = 1.0;
        to->a[1][0] = -a[0] / a[2];
        to->a[1][1] = -a[1] / a[2];
        to->b[1] = gain / a[2];
    } else {
        to->states = 1;
        to->a[0][0] = -a[0] / a[1];
        to->b[0] = gain / a[1];
    }
}

void loop_plant_of(struct loop_plant *to, const struct identify_plant *from,
                   double unit_per_count, double drive_per_count)
{
    double a[3];

    identify_denominator(from, a);
    *to = (struct loop_plant){.dead = from->dead,
                              .scale = from->lag + from->lag2 + from->dead};
    if (from->kind == IDENTIFY_RINGING) {
        to->scale = (from->lag / fmax(from->damping, 0.05)) + from->dead;
    } else if (from->kind == IDENTIFY_INTEGRATING) {
        to->scale = 2.0 * (from->dead + from->lag2);
    }
    loop_plant_second_order(to, a,
                            from->gain * drive_per_count / unit_per_count);
}

// product a b + share c
static struct matrix combined(const struct matrix *a, const struct matrix *b,
                              double product, const struct matrix *c,
                              double share)
{
    struct matrix to;
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) {
            double sum = 0.0;
            for (int k = 0; k < SIZE; k++) {
                sum += a->of[i][k] * b->of[k][j];
            }
            to.of[i][j] = (product * sum) + (share * c->of[i][j]);
        }
    }
    return to;
}

// How the states change in some seconds, and by an input of 1 meanwhile:
// exp - 1, by Taylor's series of a part of it that is below 1/8, doubled again.
static struct matrix moved(const struct loop_plant *plant, double seconds)
{
    struct matrix rates = {{{0.0}}};
    struct matrix sum = rates;
    double largest = 0.0;
    double part = seconds;
    int doublings = 0;

    for (int i = 0; i < plant->states; i++) {
        double row = fabs(plant->b[i]);
        for (int j = 0; j < plant->states; j++) {
            rates.of[i][j] = plant->a[i][j];
            row += fabs(plant->a[i][j]);
        }
        rates.of[i][INPUT] = plant->b[i];
        largest = fmax(largest, row);
    }
    while ((largest * part > 0.125) && (doublings < 60)) {
        part /= 2.0;
        doublings++;
    }
    for (int k = 16; k > 0; k--) {
        sum = combined(&rates, &sum, part / k, &rates, part / k);
    }
    for (int i = 0; i < doublings; i++) {
        sum = combined(&sum, &sum, 1.0, &sum, 2.0);
    }
    return sum;
}

// c m b
static double through(const struct sampled *s, const struct matrix *m,
                      const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < s->states; i++) {
        for (int j = 0; j < s->states; j++) {
            sum += s->c[i] * m->of[i][j] * b[j];
        }
    }
    return sum;
}

// The polynomials, by Leverrier's method. Of a slow plant z - 1 is small, and
// polynomials of z would lose all digits.
static void divide(struct sampled *s)
{
    struct matrix m = {{{0.0}}};
    double last = 1.0;
    for (int k = 0; k < s->states; k++) {
        double trace = 0.0;
        for (int i = 0; i < s->states; i++) {
            m.of[i][i] += last;
        }
        s->top[k] = through(s, &m, s->now);
        s->top_before[k] = through(s, &m, s->before);
        m = combined(&s->change, &m, 1.0, &m, 0.0);
        for (int i = 0; i < s->states; i++) {
            trace += m.of[i][i];
        }
        last = -trace / (k + 1);
        s->bottom[k] = last;
    }
}

static void sample(struct sampled *s, const struct loop_plant *plant,
                   double step_s)
{
    s->states = plant->states;
    s->c = plant->c;
    s->steps = (int)floor((plant->dead / step_s) + 1e-9);
    const double late = fmax(plant->dead - (s->steps * step_s), 0.0);
    const struct matrix after = moved(plant, step_s - late);
    const struct matrix during = moved(plant, late);
    s->change = moved(plant, step_s);
    for (int i = 0; i < s->states; i++) {
        s->now[i] = after.of[i][INPUT];
        s->before[i] = during.of[i][INPUT];
        for (int j = 0; j < s->states; j++) {
            s->before[i] += after.of[i][j] * during.of[j][INPUT];
        }
    }
}

// --- Its response and the controller's -------------------------------------

// With 1 - z^-1 at this angle.
static struct number bottom_at(const struct sampled *s, struct number fall)
{
    const struct number rise = {-fall.re, fall.im}; // z - 1
    struct number sum = {1.0, 0.0};

    for (int k = 0; k < s->states; k++) {
        sum = product(sum, rise);
        sum.re += s->bottom[k];
    }
    return sum;
}

static struct number plant_at(const struct sampled *s, double angle,
                              struct number fall)
{
    const struct number rise = {-fall.re, fall.im};
    struct number top = {0.0, 0.0};

    for (int k = 0; k < s->states; k++) {
        top = product(top, rise);
        top.re += s->top[k] + (s->top_before[k] * (1.0 - fall.re));
        top.im -= s->top_before[k] * fall.im;
    }
    return product(quotient(top, bottom_at(s, fall)), back(angle, s->steps));
}

// 1 - keep z^-1
static struct number filter_at(const struct loop_controller *c,
                               struct number fall)
{
    return (struct number){(1.0 - c->keep) + (c->keep * fall.re),
                           c->keep * fall.im};
}

// What the derivative's factor is multiplied with.
static struct number derivative_at(const struct loop_controller *c,
                                   double angle, struct number fall)
{
    if (c->derivative == LOOP_THREE) {
        return change(angle, 3);
    }
    if (c->derivative == LOOP_PERIODIC) { // on average, held for its period
        const struct number whole = change(angle, c->period);
        const struct number held = quotient(whole, fall);
        const struct number mean = {held.re / c->period, held.im / c->period};
        return product(mean, whole);
    }
    return quotient(fall, filter_at(c, fall));
}

static struct number loop_at(const struct sampled *s, double angle)
{
    const struct loop_controller *c = s->controller;
    const struct number fall = change(angle, 1);
    const struct number i = quotient((struct number){c->ki, 0.0}, fall);
    const struct number d = derivative_at(c, angle, fall);
    const struct number terms = {c->kp + i.re + (c->kd * d.re),
                                 i.im + (c->kd * d.im)};
    return product(terms, plant_at(s, angle, fall));
}

// --- Stability -------------------------------------------------------------

// The loop's characteristic polynomial, of 1/z: what is below the line in plant
// and controller, times 1 + loop.
static struct number characteristic(const struct sampled *s, double angle)
{
    const struct loop_controller *c = s->controller;
    const struct number fall = change(angle, 1);
    const struct number loop = loop_at(s, angle);
    const struct number away = {1.0 + loop.re, loop.im};
    struct number all = product(bottom_at(s, fall), back(angle, s->states));

    if (c->ki != 0.0) {
        all = product(all, fall);
    }
    if (c->derivative == LOOP_FILTERED) {
        all = product(all, filter_at(c, fall));
    }
    return product(all, away);
}

// A loop is stable if none of its polynomial's zeros lies in the unit circle:
// then the polynomial, which is real at 0 and at pi, comes back without a turn.
// One at 1, a quarter of a turn, is an integral that no measurement shows, as
// where a pendulum's base is. Angles are as near to each other as the turn asks
// for.
static bool is_stable(const struct sampled *s, double lowest)
{
    double angle = 1e-4 * lowest;
    double ratio = WIDEST;
    double turned = 0.0;
    struct number last = characteristic(s, angle);

    while ((angle < PI) && (fabs(turned) < 4.0 * PI)) {
        const double next = fmin(angle * ratio, PI);
        const struct number now = characteristic(s, next);
        const struct number by = quotient(now, last);
        const double turn = atan2(by.im, by.re);
        if ((fabs(turn) > 1.0) && (ratio > (1.0 + 1e-9))) {
            ratio = sqrt(ratio);
            continue;
        }
        turned += turn;
        angle = next;
        last = now;
        ratio = fmin(ratio * ratio, WIDEST);
    }
    return fabs(turned) < ((s->controller->ki != 0.0) ? 0.75 * PI : 0.25 * PI);
}

// --- Margins ---------------------------------------------------------------

static bool is_beyond(struct number at, bool circle)
{
    return circle ? (size_of(at) > 1.0) : (at.im > 0.0);
}

// The angle between two points of the curve at which it crosses the real axis,
// or the unit circle.
static double crossing(const struct sampled *s, const struct loop_margins *m,
                       int point, bool circle)
{
    double low = m->angles[point - 1];
    double high = m->angles[point];
    const bool beyond = is_beyond(loop_at(s, low), circle);

    for (int i = 0; i < 50; i++) {
        const double middle = sqrt(low * high);
        if (is_beyond(loop_at(s, middle), circle) == beyond) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return sqrt(low * high);
}

// 1 / the distance from -1, with the worst gain that is up to `off` off.
static double nearness(struct number at, double off)
{
    const double square = (at.re * at.re) + (at.im * at.im);
    const double worst = (square > 0.0) ? (-at.re / square) : 1.0;
    const double factor = fmax(fmin(worst, 1.0 + off), 1.0 - off);
    const struct number from = {1.0 + (factor * at.re), factor * at.im};
    return 1.0 / size_of(from);
}

// The largest nearness, of the curve and between its points: by golden section
// about the best of them.
static double highest(const struct sampled *s, const struct loop_margins *m,
                      double off)
{
    int best = 0;
    double most = 0.0;

    for (int i = 0; i < LOOP_POINTS; i++) {
        const struct number at = {m->re[i], m->im[i]};
        if (nearness(at, off) > most) {
            most = nearness(at, off);
            best = i;
        }
    }
    double low = m->angles[(best > 0) ? (best - 1) : 0];
    double high = m->angles[(best < LOOP_POINTS - 1) ? (best + 1) : best];
    for (int i = 0; i < 60; i++) {
        const double ratio = log(high / low);
        const double a = low * exp(0.382 * ratio);
        const double b = low * exp(0.618 * ratio);
        if (nearness(loop_at(s, a), off) < nearness(loop_at(s, b), off)) {
            low = a;
        } else {
            high = b;
        }
    }
    return fmax(most, nearness(loop_at(s, sqrt(low * high)), off));
}

// The loop is real here: a gain margin, where it is left of 0.
static void limit(struct loop_margins *m, struct number at, double angle)
{
    const double margin = 1.0 / size_of(at);

    if (!(at.re < 0.0)) {
        return;
    }
    if (margin < 1.0) {
        m->lower_gain = fmax(m->lower_gain, margin);
    } else if ((m->gain < 0.0) || (margin < m->gain)) {
        m->gain = margin;
        m->turnover = angle;
    }
}

// The gain is 1 here: a phase margin, and one of dead time.
static void turn(struct loop_margins *m, struct number at, double angle,
                 double step_s)
{
    const double away = fabs(atan2(at.im, -at.re)); // from -180 degrees
    const double degrees = away * 180.0 / PI;
    // More dead time turns the curve back: from above the axis all the way
    // round.
    const double left = (at.im < 0.0) ? away : ((2.0 * PI) - away);
    const double delay_s = left / angle * step_s;

    if ((m->phase_degrees < 0.0) || (degrees < m->phase_degrees)) {
        m->phase_degrees = degrees;
        m->crossover = angle;
    }
    if ((m->delay_s < 0.0) || (delay_s < m->delay_s)) {
        m->delay_s = delay_s;
    }
}

static void draw(const struct sampled *s, struct loop_margins *m, double lowest)
{
    for (int i = 0; i < LOOP_POINTS; i++) {
        const double part = (i + 1) / (double)LOOP_POINTS;
        m->angles[i] = lowest * exp(log(PI / lowest) * part);
        const struct number at = loop_at(s, m->angles[i]);
        m->re[i] = at.re;
        m->im[i] = at.im;
    }
}

static void cross(const struct sampled *s, struct loop_margins *m,
                  double step_s)
{
    for (int i = 1; i < LOOP_POINTS; i++) {
        const struct number from = {m->re[i - 1], m->im[i - 1]};
        const struct number to = {m->re[i], m->im[i]};
        if ((is_beyond(from, false) != is_beyond(to, false)) &&
            ((from.re < 0.0) || (to.re < 0.0))) {
            const double angle = crossing(s, m, i, false);
            limit(m, loop_at(s, angle), angle);
        }
        if (is_beyond(from, true) != is_beyond(to, true)) {
            const double angle = crossing(s, m, i, true);
            turn(m, loop_at(s, angle), angle, step_s);
        }
    }
}

// A real number is a crossing at both ends of the band, too: at pi, and at the
// start, if the loop comes to an end there.
static void end(const struct sampled *s, struct loop_margins *m, double lowest)
{
    const struct number start = loop_at(s, lowest / 10.0);
    const struct number before = loop_at(s, lowest / 100.0);

    limit(m, (struct number){m->re[LOOP_POINTS - 1], 0.0}, PI);
    if ((fabs(before.im) < (0.1 * fabs(before.re))) &&
        (fabs((start.re / before.re) - 1.0) < 0.05)) {
        limit(m, before, m->turnover);
    }
}

void loop_margins(const struct loop_plant *plant,
                  const struct loop_controller *controller, double step_s,
                  struct loop_margins *to)
{
    struct sampled s = {.controller = controller};
    const double scale_steps = (plant->scale / step_s) + 1e-9;
    const double lowest = fmin(0.01, 0.02 / scale_steps);

    sample(&s, plant, step_s);
    divide(&s);
    *to = (struct loop_margins){.phase_degrees = NONE,
                                .delay_s = NONE,
                                .gain = NONE,
                                .lower_gain = NONE,
                                .crossover = NONE,
                                .turnover = NONE,
                                .dead_steps = s.steps};
    draw(&s, to, lowest);
    cross(&s, to, step_s);
    end(&s, to, lowest);
    to->ms = highest(&s, to, 0.0);
    to->off_ms = highest(&s, to, LOOP_OFF);
    to->stable = is_stable(&s, lowest);
    to->off_stable = to->stable && ((1.0 - LOOP_OFF) > to->lower_gain) &&
                     ((to->gain < 0.0) || ((1.0 + LOOP_OFF) < to->gain));
}
