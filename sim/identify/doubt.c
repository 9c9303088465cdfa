// SPDX-License-Identifier: MIT
// What a recording leaves unknown: plants that it allows, and how likely each
// of them is.
#include <math.h>

#include "parts.h"

#define PROPOSALS 192
#define WIDER 1.3 // proposals are wider than what they stand for

struct proposal {
    struct identify_plant plant;
    double likely;
};

// What is known of a kind's numbers: their covariance is the inverse of the
// product of this lower triangle and its transpose.
struct spread {
    int n;
    double triangle[NUMBERS][NUMBERS];
};

static struct proposal proposals[IDENTIFY_KINDS][PROPOSALS];
static unsigned long seed;

static double uniform(void)
{
    seed = ((seed * 1103515245ul) + 12345ul) & 0x7ffffffful;
    return ((double)seed + 0.5) / 2147483648.0;
}

static double normal(void)
{
    const double size = sqrt(-2.0 * log(uniform()));
    return size * cos(6.283185307179586 * uniform());
}

// How many lines of what is left over say as much as one would if it told
// nothing of the next: a wrong model, or slow noise, widens all that follows.
static double alikeness(struct lines *in)
{
    const double mean = model_product(in, in->left, in->left);
    double weights = 0.0;
    double square = 0.0;
    double factor = 1.0;
    for (int i = 0; i < in->n; i++) {
        weights += in->heavy[i];
    }
    const double far = 3.0 * sqrt(mean / weights);
    for (int i = 0; i < in->n; i++) {
        in->left[i] =
            (in->heavy[i] > 0.0) ? limited(in->left[i], -far, far) : 0.0;
        square += squared(in->left[i]);
    }
    for (int k = 1; (k < in->n / 4) && (square > 0.0); k++) {
        double with = 0.0;
        for (int i = k; i < in->n; i++) {
            with += in->left[i] * in->left[i - k];
        }
        if (with < 0.05 * square) {
            break;
        }
        factor += 2.0 * with / square;
    }
    return fmin(factor, in->n / 6.0);
}

// ---- The spread of the numbers ----

// Dead times and second lags have no sign, and an integrator's lag.
static bool is_folded(const struct task *task, int k)
{
    return (k > 0) || (task->kind == IDENTIFY_INTEGRATING);
}

// By differences of what is left over, at the places on both sides of a number.
// A number that is folded at 0 has none below it.
static void slope_of(const struct task *task, struct numbers at, int k,
                     double step, double *to)
{
    const struct lines *const in = task->lines;
    const double high = at.x[k] + step;
    const double low =
        is_folded(task, k) ? fmax(at.x[k] - step, 0.0) : (at.x[k] - step);
    at.x[k] = low;
    (void)model_error(task, at);
    for (int i = 0; i < in->n; i++) {
        to[i] = in->left[i];
    }
    at.x[k] = high;
    (void)model_error(task, at);
    for (int i = 0; i < in->n; i++) {
        to[i] = (in->left[i] - to[i]) / (high - low);
    }
}

// By Cholesky. A number is known no worse than by the first guess of it.
static void factorize(struct spread *self, const double *guess)
{
    for (int a = 0; a < self->n; a++) {
        double *const row = self->triangle[a];
        for (int b = 0; b <= a; b++) {
            const double *const other = self->triangle[b];
            for (int k = 0; k < b; k++) {
                row[b] -= row[k] * other[k];
            }
            row[b] =
                (a == b) ? sqrt(fmax(row[b], guess[a])) : (row[b] / other[b]);
        }
    }
}

static struct spread spread_of(const struct task *task, struct numbers best,
                               double variance)
{
    static double slope[NUMBERS][IDENTIFY_LINES];
    const struct identify_plant p = model_plant(task->kind, best);
    const double every = task->record->every;
    const double scale = p.lag + p.lag2 + p.dead + every;
    const bool integrating = task->kind == IDENTIFY_INTEGRATING;
    const bool ringing = task->kind == IDENTIFY_RINGING;
    const double step[NUMBERS] = {integrating ? (0.01 * scale) : 0.01,
                                  fmax(0.01 * scale, 0.1 * every),
                                  ringing ? 0.01 : (0.01 * scale)};
    const double sd[NUMBERS] = {integrating ? scale : 2.0, 2.0 * scale,
                                ringing ? 0.5 : scale};
    struct spread got = {model_numbers(task->kind), {{0.0}}};
    double guess[NUMBERS];
    for (int a = 0; a < got.n; a++) {
        slope_of(task, best, a, step[a], slope[a]);
        guess[a] = 1.0 / squared(sd[a]);
        for (int b = 0; b <= a; b++) {
            got.triangle[a][b] =
                model_product(task->lines, slope[a], slope[b]) / variance;
        }
        got.triangle[a][a] += guess[a];
    }
    factorize(&got, guess);
    return got;
}

// Numbers with this covariance from ones that are normal and know nothing of
// each other.
static struct numbers spread_out(const struct spread *self, struct numbers z)
{
    for (int k = self->n - 1; k >= 0; k--) {
        for (int j = k + 1; j < self->n; j++) {
            z.x[k] -= self->triangle[j][k] * z.x[j];
        }
        z.x[k] /= self->triangle[k][k];
    }
    return z;
}

// ---- Plants ----

// A plant of these numbers, with what is unknown of the gain and of the time
// between two lines at which the drive moved.
static struct proposal proposal_at(const struct task *task, struct numbers at,
                                   double variance, double *square)
{
    struct proposal one = {model_plant(task->kind, at), 0.0};
    const struct projection got = model_project(task, &one.plant);
    const double sd = (got.fresh > 0.0) ? sqrt(variance / got.fresh) : 1e9;
    const double late = task->record->gap * (uniform() - 0.5);
    one.plant.gain = got.factor[got.columns - 1] + (sd * normal());
    one.plant.dead = fmax(one.plant.dead + late, 0.0);
    *square = got.square;
    return one;
}

static void keep_deviations(const struct proposal *all,
                            struct identify_model *m)
{
    const bool integrating = m->plant.kind == IDENTIFY_INTEGRATING;
    double *const to[] = {&m->sd_gain, &m->sd_lag, &m->sd_lag2, &m->sd_dead};
    double mean[4] = {0.0};
    double square[4] = {0.0};
    double sum = 0.0;
    for (int i = 0; i < PROPOSALS; i++) {
        const struct identify_plant *const p = &all[i].plant;
        const double of[4] = {log(fmax(p->gain / m->plant.gain, 1e-3)),
                              integrating ? p->lag2 : log(p->lag),
                              integrating ? 0.0 : (p->lag2 + p->damping),
                              p->dead};
        sum += all[i].likely;
        for (int k = 0; k < 4; k++) {
            mean[k] += all[i].likely * of[k];
            square[k] += all[i].likely * squared(of[k]);
        }
    }
    for (int k = 0; k < 4; k++) {
        *to[k] = sqrt(fabs((square[k] / sum) - squared(mean[k] / sum)));
    }
}

void doubt_about(const struct task *task, struct numbers best,
                 struct identify_model *model)
{
    struct proposal *const all = proposals[task->kind];
    const struct identify_plant plant = model_plant(task->kind, best);
    for (int k = is_folded(task, 0) ? 0 : 1; k < NUMBERS; k++) {
        best.x[k] = fabs(best.x[k]);
    }
    const struct projection got = model_project(task, &plant);
    const int n = model_numbers(task->kind);
    const double worth = fmax(got.weights - n - got.columns, 1.0);
    const double variance =
        fmax(got.square / worth, record_exact(task->record)) *
        alikeness(task->lines);
    const struct spread spread = spread_of(task, best, variance);
    seed = 1;
    for (int i = 0; i < PROPOSALS; i++) {
        struct numbers z = {{0.0}};
        struct numbers at = best;
        double away = 0.0;
        double square;
        for (int k = 0; k < n; k++) {
            z.x[k] = normal();
            away += squared(z.x[k]);
        }
        z = spread_out(&spread, z);
        for (int k = 0; k < n; k++) {
            at.x[k] += WIDER * z.x[k];
        }
        all[i] = proposal_at(task, at, variance, &square);
        away += (got.square - square) / variance;
        all[i].likely = exp(limited(away / 2.0, -600.0, 20.0));
    }
    keep_deviations(all, model);
}

void doubt_draw(const double weight[IDENTIFY_KINDS],
                struct identify_plant plants[IDENTIFY_PLANTS])
{
    double each[IDENTIFY_KINDS]; // for a likelihood of 1
    double sum = 0.0;
    double passed = 0.0;
    int to = 0;
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        double likely = 0.0;
        for (int i = 0; i < PROPOSALS; i++) {
            likely += proposals[kind][i].likely;
        }
        each[kind] = weight[kind] / likely;
        sum += weight[kind];
    }
    for (int i = 0; i < IDENTIFY_KINDS * PROPOSALS; i++) {
        const int kind = i / PROPOSALS;
        const struct proposal *const one = &proposals[kind][i % PROPOSALS];
        passed += one->likely * each[kind] / sum * IDENTIFY_PLANTS;
        for (; (to < IDENTIFY_PLANTS) && (to + 0.5 < passed); to++) {
            plants[to] = one->plant;
        }
    }
}
