// SPDX-License-Identifier: MIT
#include "loop.h"

#include <math.h>

#include "identify.h"

#define PI 3.14159265358979323846
#define NONE (-1.0)
#define SIZE (LOOP_STATES + 1) // the states and the input
#define INPUT LOOP_STATES
#define LEAST_STEPS 1500
#define MOST_STEPS 30000

struct number {
    double re;
    double im;
};

struct matrix {
    double of[SIZE][SIZE];
};

// x[n + 1] = phi x[n] + now u[n - steps] + before u[n - steps - 1]
struct sampled {
    int states;
    int steps;
    double phi[LOOP_STATES][LOOP_STATES];
    double now[LOOP_STATES];
    double before[LOOP_STATES];
    const double *c;
    const struct loop_controller *controller;
};

static double larger(double a, double b)
{
    return (a > b) ? a : b;
}

static double smaller(double a, double b)
{
    return (a < b) ? a : b;
}

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
    const double gain = from->gain * drive_per_count / unit_per_count;
    const double lags = from->lag + from->lag2;

    *to = (struct loop_plant){.dead = from->dead};
    if (from->kind == IDENTIFY_RINGING) {
        const double a[3] = {1.0, 2.0 * from->damping * from->lag,
                             from->lag * from->lag};
        loop_plant_second_order(to, a, gain);
        to->scale = (from->lag / larger(from->damping, 0.05)) + from->dead;
    } else if (from->kind == IDENTIFY_INTEGRATING) {
        const double a[3] = {0.0, 1.0, from->lag2};
        loop_plant_second_order(to, a, gain);
        to->scale = 2.0 * (from->dead + from->lag2);
    } else {
        const double a[3] = {1.0, lags, from->lag * from->lag2};
        loop_plant_second_order(to, a, gain);
        to->scale = lags + from->dead;
    }
}

static struct matrix identity(void)
{
    struct matrix m = {{{0.0}}};
    for (int i = 0; i < SIZE; i++) {
        m.of[i][i] = 1.0;
    }
    return m;
}

// factor a b
static struct matrix multiplied(const struct matrix *a, const struct matrix *b,
                                double factor)
{
    struct matrix m = {{{0.0}}};
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) {
            for (int k = 0; k < SIZE; k++) {
                m.of[i][j] += factor * a->of[i][k] * b->of[k][j];
            }
        }
    }
    return m;
}

static double largest_row(const struct matrix *a)
{
    double largest = 0.0;
    for (int i = 0; i < SIZE; i++) {
        double row = 0.0;
        for (int j = 0; j < SIZE; j++) {
            row += fabs(a->of[i][j]);
        }
        largest = larger(largest, row);
    }
    return largest;
}

// exp(a), by Taylor's series of a part of it that is below 1/8, squared again.
static struct matrix exponential(const struct matrix *a)
{
    const struct matrix one = identity();
    struct matrix sum = one;
    double part = 1.0;
    int halvings = 0;

    while ((largest_row(a) * part > 0.125) && (halvings < 60)) {
        part /= 2.0;
        halvings++;
    }
    for (int k = 16; k > 0; k--) {
        sum = multiplied(a, &sum, part / k);
        for (int i = 0; i < SIZE; i++) {
            sum.of[i][i] += 1.0;
        }
    }
    for (int i = 0; i < halvings; i++) {
        sum = multiplied(&sum, &sum, 1.0);
    }
    return sum;
}

// How the plant moves in some seconds, and with an input of 1 meanwhile.
static struct matrix moved(const struct loop_plant *plant, double seconds)
{
    struct matrix rates = {{{0.0}}};
    for (int i = 0; i < plant->states; i++) {
        for (int j = 0; j < plant->states; j++) {
            rates.of[i][j] = plant->a[i][j] * seconds;
        }
        rates.of[i][INPUT] = plant->b[i] * seconds;
    }
    return exponential(&rates);
}

static void sample(struct sampled *s, const struct loop_plant *plant,
                   double step_s)
{
    s->states = plant->states;
    s->c = plant->c;
    s->steps = (int)floor((plant->dead / step_s) + 1e-9);
    const double late = larger(plant->dead - (s->steps * step_s), 0.0);
    const struct matrix whole = moved(plant, step_s);
    const struct matrix after = moved(plant, step_s - late);
    const struct matrix during = moved(plant, late);
    for (int i = 0; i < s->states; i++) {
        s->now[i] = after.of[i][INPUT];
        s->before[i] = 0.0;
        for (int j = 0; j < s->states; j++) {
            s->phi[i][j] = whole.of[i][j];
            s->before[i] += after.of[i][j] * during.of[j][INPUT];
        }
    }
}

// --- Its response and the controller's -------------------------------------

typedef struct number equations[LOOP_STATES][SIZE];

// Of n equations one without the k-th unknown: row minus a part of the k-th.
static void reduce(struct number *row, const struct number *by, int k, int n)
{
    const struct number factor = quotient(row[k], by[k]);
    for (int j = k; j <= n; j++) {
        const struct number part = product(factor, by[j]);
        row[j].re -= part.re;
        row[j].im -= part.im;
    }
}

// The equation with the largest k-th coefficient becomes the k-th.
static void pivot(equations m, int k, int n)
{
    int at = k;
    for (int i = k + 1; i < n; i++) {
        at = (size_of(m[i][k]) > size_of(m[at][k])) ? i : at;
    }
    for (int j = k; j <= n; j++) {
        const struct number kept = m[k][j];
        m[k][j] = m[at][j];
        m[at][j] = kept;
    }
}

// c (z - phi)^-1 (now + before z^-1) z^-steps.
static struct number plant_at(const struct sampled *s, double angle)
{
    const int n = s->states;
    const struct number one = back(angle, 1);
    struct number sum = {0.0, 0.0};
    equations m;

    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            m[i][j] = (struct number){-s->phi[i][j], 0.0};
        }
        m[i][i].re += one.re;
        m[i][i].im -= one.im;
        m[i][n].re = s->now[i] + (s->before[i] * one.re);
        m[i][n].im = s->before[i] * one.im;
    }
    for (int k = 0; k < n; k++) {
        pivot(m, k, n);
        for (int i = 0; i < n; i++) {
            if (i != k) {
                reduce(m[i], m[k], k, n);
            }
        }
    }
    for (int i = 0; i < n; i++) {
        const struct number state = quotient(m[i][n], m[i][i]);
        sum.re += s->c[i] * state.re;
        sum.im += s->c[i] * state.im;
    }
    return product(sum, back(angle, s->steps));
}

// What the derivative's factor is multiplied with.
static struct number derivative_at(const struct loop_controller *c,
                                   double angle)
{
    if (c->derivative == LOOP_THREE) {
        return change(angle, 3);
    }
    if (c->derivative == LOOP_PERIODIC) { // on average: held for its period
        struct number held = {0.0, 0.0};
        for (int k = 0; k < c->period; k++) {
            held.re += back(angle, k).re / c->period;
            held.im += back(angle, k).im / c->period;
        }
        return product(held, change(angle, c->period));
    }
    const struct number kept = back(angle, 1);
    return quotient(change(angle, 1), (struct number){1.0 - (c->keep * kept.re),
                                                      -c->keep * kept.im});
}

static struct number loop_at(const struct sampled *s, double angle)
{
    const struct loop_controller *c = s->controller;
    const struct number i =
        quotient((struct number){c->ki, 0.0}, change(angle, 1));
    const struct number d = derivative_at(c, angle);
    const struct number terms = {c->kp + i.re + (c->kd * d.re),
                                 i.im + (c->kd * d.im)};
    return product(terms, plant_at(s, angle));
}

// --- In time ---------------------------------------------------------------

// The loop without limits and rounding.
struct run {
    double x[LOOP_STATES];
    double y[4]; // of the last steps, the newest first
    double integral;
    double derivative;
    double seen; // at the last sample of the derivative
};

static void differentiate(struct run *run, const struct loop_controller *c,
                          int step)
{
    if (c->derivative == LOOP_THREE) {
        run->derivative = c->kd * (run->y[0] - run->y[3]);
    } else if (c->derivative == LOOP_FILTERED) {
        run->derivative =
            (c->keep * run->derivative) + (c->kd * (run->y[0] - run->y[1]));
    } else if ((step % c->period) == 0) {
        run->derivative = c->kd * (run->y[0] - run->seen);
        run->seen = run->y[0];
    }
}

// The output of a step, at which the measurement is `more` than the plant's.
static double answered(struct run *run, const struct sampled *s, int step,
                       double more)
{
    const struct loop_controller *c = s->controller;

    for (int k = 3; k > 0; k--) {
        run->y[k] = run->y[k - 1];
    }
    run->y[0] = more;
    for (int k = 0; k < s->states; k++) {
        run->y[0] += s->c[k] * run->x[k];
    }
    run->integral += c->ki * run->y[0];
    differentiate(run, c, step);
    return -((c->kp * run->y[0]) + run->integral + run->derivative);
}

static void move(struct run *run, const struct sampled *s, double u,
                 double earlier)
{
    double next[LOOP_STATES];
    for (int i = 0; i < s->states; i++) {
        next[i] = (s->now[i] * u) + (s->before[i] * earlier);
        for (int j = 0; j < s->states; j++) {
            next[i] += s->phi[i][j] * run->x[j];
        }
    }
    for (int i = 0; i < s->states; i++) {
        run->x[i] = next[i];
    }
}

// A loop is stable if what is left of a push, of a count of output and of
// measurement, goes on getting less: in the last quarter of n steps it is less
// than in the second.
static bool settles(const struct sampled *s, int n)
{
    static double driven[MOST_STEPS + 1]; // as it reaches the plant
    struct run run = {.integral = 0.0};
    double most[4] = {0.0}; // of each quarter

    for (int i = 0; i <= n; i++) {
        driven[i] = 0.0;
    }
    for (int k = 0; k < s->states; k++) {
        run.x[k] = s->now[k];
    }
    for (int i = 0; i < n; i++) {
        const double output = answered(&run, s, i, (i == 0) ? 1.0 : 0.0);
        const double size = fabs(run.y[0]);
        if (!(size < 1e100)) {
            return false;
        }
        if (i < n - s->steps) { // what comes later is not looked at
            driven[i + s->steps + 1] = output;
        }
        move(&run, s, driven[i + 1], driven[i]);
        most[(4 * i) / n] = larger(most[(4 * i) / n], size);
    }
    return (most[3] < (0.999 * most[1])) || (most[3] < 1e-9);
}

// How many steps of a push are looked at.
static int watched(const struct loop_controller *c, double scale_steps)
{
    const double reset = (c->ki != 0.0) ? fabs(c->kp / c->ki) : 0.0;
    const double slowest = smaller(reset, 20.0 * scale_steps);
    const double wanted = 60.0 * larger(scale_steps, slowest);
    return (int)floor(smaller(larger(wanted, LEAST_STEPS), MOST_STEPS) + 0.5);
}

// --- Margins ---------------------------------------------------------------

// Above 0 on one side of a crossing: of the real axis, or of the unit circle.
typedef double side(struct number at);

static double above_axis(struct number at)
{
    return at.im;
}

static double outside_circle(struct number at)
{
    return size_of(at) - 1.0;
}

// The angle between two points of the curve at which it changes the side.
static double crossing(const struct sampled *s, side *of,
                       const struct loop_margins *m, int point)
{
    double low = m->angles[point - 1];
    double high = m->angles[point];
    const bool above = of(loop_at(s, low)) > 0.0;

    for (int i = 0; i < 50; i++) {
        const double middle = sqrt(low * high);
        if ((of(loop_at(s, middle)) > 0.0) == above) {
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
    const double factor = larger(smaller(worst, 1.0 + off), 1.0 - off);
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
    return larger(most, nearness(loop_at(s, sqrt(low * high)), off));
}

// The loop is real here: a gain margin, where it is left of 0.
static void limit(struct loop_margins *m, struct number at, double angle)
{
    const double margin = 1.0 / size_of(at);

    if (!(at.re < 0.0)) {
        return;
    }
    if (margin < 1.0) {
        m->lower_gain = larger(m->lower_gain, margin);
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
        if (((from.im > 0.0) != (to.im > 0.0)) &&
            ((from.re < 0.0) || (to.re < 0.0))) {
            const double angle = crossing(s, above_axis, m, i);
            limit(m, loop_at(s, angle), angle);
        }
        if ((size_of(from) > 1.0) != (size_of(to) > 1.0)) {
            const double angle = crossing(s, outside_circle, m, i);
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
    const double lowest = smaller(0.01, 0.02 / scale_steps);

    sample(&s, plant, step_s);
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
    to->stable = settles(&s, watched(controller, scale_steps));
    to->off_stable = to->stable && ((1.0 - LOOP_OFF) > to->lower_gain) &&
                     ((to->gain < 0.0) || ((1.0 + LOOP_OFF) < to->gain));
}
