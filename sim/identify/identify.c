// SPDX-License-Identifier: MIT
// Which model is chosen, and whether it is usable.
#include "identify.h"

#include <math.h>

#include "parts.h"

#define MOST_MS 2.2
#define RISK 0.1          // of the plants may have a larger one
#define UNEXPLAINED 0.01  // of the swing: less than that moves by itself, too
#define BADLY 0.2         // of what the drive moved is left over
#define UNSURE 0.3        // a standard deviation that is too much
#define AS_GOOD 8.0       // of the score
#define MOVING_COSTS 10.0 // of the score
#define COLD_COSTS 5.0
#define THIRD_COSTS 12.0 // a third number
#define THIRD_FAIR 5.3   // the same by Bayes' criterion

static struct record record;

// Whether the lines before the first move do not tell the start, but those
// after a later move may.
static bool told_later(void)
{
    const int early = (record.all.n > REST) ? REST : (record.all.n - 1);
    const bool again = record.moves - record.first > 1;
    return again && (record.at[record.moves - 1] > record.all.t[early]) &&
           ((record.rest != 1) || (record.rest_lines < REST));
}

static bool may_start(const struct identify_recording *in, int start)
{
    if (in->before_known) {
        return start == IDENTIFY_SETTLED;
    }
    switch (start) {
    case IDENTIFY_SETTLED:
        return true;
    case IDENTIFY_COLD:
        return told_later() && (in->u[0] != 0.0);
    case IDENTIFY_MOVING:
        return told_later() || (record.rest == 0);
    default:
        return record.rest == 0;
    }
}

struct found {
    struct task task;
    struct numbers numbers;
};

static double score_of(const struct task *task, double error)
{
    static const double COSTS[] = {0.0, COLD_COSTS, MOVING_COSTS, MOVING_COSTS};
    const double lines = fmin(task->lines->n, 200.0);
    const double exact = record_exact(task->record);
    return (lines * log(squared(error) + exact)) + COSTS[task->start] +
           ((model_numbers(task->kind) == 3) ? THIRD_COSTS : 0.0);
}

// The numbers of a kind, with the start that fits best over few lines.
static struct found search_kind(const struct identify_recording *in, int kind)
{
    struct found got = {{&record, &record.all, kind, 0}, {{0.0}}};
    double best = 1e300;
    for (int start = IDENTIFY_SETTLED; start <= IDENTIFY_DRIFTING; start++) {
        if (may_start(in, start)) {
            const struct task task = {&record, &record.few, kind, start};
            search_unweigh(&record.few);
            const struct numbers at =
                search_near(&task, search_all(&task), 0.05);
            const double score = score_of(&task, model_error(&task, at));
            if (score < best) {
                best = score;
                got.numbers = at;
                got.task.start = start;
            }
        }
    }
    got.numbers = search_near(&got.task, got.numbers, 0.03);
    return got;
}

static void keep_model(const struct found *found, struct identify_model *m)
{
    const struct task *const task = &found->task;
    const double before = model_before(task);
    struct identify_plant *const p = &m->plant;
    *p = model_plant(task->kind, found->numbers);
    const struct projection got = model_project(task, p);
    p->gain = got.factor[got.columns - 1];
    m->start = task->start;
    m->error = sqrt(got.square / got.weights);
    const double moved = fabs(p->gain) * sqrt(got.fresh / got.weights);
    m->part = (moved > 0.0) ? (m->error / moved) : 1e9;
    m->r2 = 1.0 / (1.0 + squared(m->part));
    m->noise = record.noise;
    m->score = score_of(task, m->error);
    m->rest = got.factor[0] - (p->gain * before);
    if (task->kind == IDENTIFY_INTEGRATING) { // its slope is the second factor
        const double slope = (got.columns < 3) ? 0.0 : got.factor[1];
        m->rest = got.factor[0];
        m->holds = before - (slope / record.span / p->gain);
    }
}

// Whether a model may be chosen at all.
static bool possible(const struct identify_model *m)
{
    const struct identify_plant *const p = &m->plant;
    const double span = record.span;
    const bool known =
        (p->gain != 0.0) && (p->dead < model_latest(&record, m->start));
    if (p->kind != IDENTIFY_RINGING) {
        return known && (p->lag < 1e4 * span);
    }
    return known && (p->damping > 0.02) && (p->damping < 0.85) &&
           (span - p->dead > 3.0 * p->lag);
}

static void search_kinds(const struct identify_recording *in, struct found *all,
                         struct identify_result *result)
{
    result->chosen = IDENTIFY_FIRST;
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        struct identify_model *const m = &result->models[kind];
        all[kind] = search_kind(in, kind);
        keep_model(&all[kind], m);
        if (possible(m) && (m->score < result->models[result->chosen].score)) {
            result->chosen = kind;
        }
    }
}

// ---- The verdict ----

static void draw_plants(const struct found *all, struct identify_result *result)
{
    double weight[IDENTIFY_KINDS];
    const double best = result->models[result->chosen].score;
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        struct identify_model *const m = &result->models[kind];
        // A kind with a third number is chosen by much, but as likely by less.
        const double fair =
            (model_numbers(kind) == 3) ? (THIRD_COSTS - THIRD_FAIR) : 0.0;
        search_unweigh(&record.all);
        search_weigh(&all[kind].task, &m->plant);
        doubt_about(&all[kind].task, all[kind].numbers, m);
        weight[kind] =
            possible(m)
                ? exp(limited((best + fair - m->score) / 2.0, -600.0, 20.0))
            : (kind == result->chosen) ? 1e-9
                                       : 0.0;
    }
    doubt_draw(weight, result->plants);
}

// The least calm that is safe, of its plants' Ms the ninth of ten, and the risk
// without it.
static void judge_calm(struct identify_model *m,
                       const struct identify_plant *plants)
{
    static const double CALM[] = {1.0, 2.0, 4.0};
    const struct identify_plant *const p = &m->plant;
    const double scale = p->lag + p->lag2 + p->dead;
    const double step = ((scale > 0.0) ? scale : record.every) / 40.0;
    m->calm = 0.0;
    for (int i = 0; (i < 3) && (m->calm == 0.0); i++) {
        double ms[IDENTIFY_PLANTS];
        double gains[3];
        int above = 0;
        identify_simc(p, step, CALM[i], gains);
        for (int k = 0; k < IDENTIFY_PLANTS; k++) {
            ms[k] = identify_ms(&plants[k], step, gains);
            above += (ms[k] > MOST_MS) ? 1 : 0;
        }
        const double risk = (double)above / IDENTIFY_PLANTS;
        m->risk = (i == 0) ? risk : m->risk;
        m->ms = nth(ms, IDENTIFY_PLANTS, (9 * IDENTIFY_PLANTS) / 10);
        m->calm = (risk <= RISK) ? CALM[i] : 0.0;
    }
}

// Of what is not known, what matters most.
static int unsure_of(const struct identify_model *m)
{
    const struct identify_plant *const p = &m->plant;
    const double own = fmax(p->dead, (p->lag + (p->lag2 / 2.0)) / 10.0);
    if ((m->start != IDENTIFY_SETTLED) && (m->sd_gain > UNSURE)) {
        return IDENTIFY_UNSURE_START;
    }
    if (m->sd_dead > UNSURE * own) {
        return IDENTIFY_UNSURE_DEAD;
    }
    return (m->sd_gain > 2.0 * m->sd_lag) ? IDENTIFY_UNSURE_GAIN
                                          : IDENTIFY_UNSURE_LAG;
}

// Whether the drive moved so little of all that it could be chance.
static bool unmoved(const struct identify_model *m)
{
    return (m->plant.kind != IDENTIFY_INTEGRATING) &&
           (m->error / m->part < UNEXPLAINED * record.swing);
}

static bool fits(const struct identify_model *m)
{
    return (m->r2 >= 0.5) &&
           ((m->part <= BADLY) || (m->error <= 3.0 * m->noise));
}

static int reason_of(const struct identify_model *m, bool sure)
{
    const struct identify_plant *const p = &m->plant;
    if (!possible(m)) {
        return IDENTIFY_NO_MODEL;
    }
    if (unmoved(m)) {
        return (m->start == IDENTIFY_SETTLED) ? IDENTIFY_NO_RESPONSE
                                              : IDENTIFY_UNSURE_START;
    }
    if (!fits(m)) {
        return IDENTIFY_NO_MODEL;
    }
    if (p->lag + p->lag2 + p->dead < 0.7 * record.every) {
        return IDENTIFY_SLOW_LINES;
    }
    if (m->calm == 0.0) {
        return unsure_of(m);
    }
    return sure ? IDENTIFY_USABLE : IDENTIFY_UNSURE_START;
}

// Where it was moving, all models that fit as well must agree on what the drive
// does.
static bool agreed(const struct identify_result *result)
{
    const struct identify_model *const chosen = &result->models[result->chosen];
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        const struct identify_model *const m = &result->models[kind];
        const bool counts = (m->start >= IDENTIFY_MOVING) && possible(m) &&
                            (m->score < chosen->score + AS_GOOD);
        const bool other = (m->plant.gain > 0.0) != (chosen->plant.gain > 0.0);
        if (counts && (other || (m->sd_gain > UNSURE))) {
            return false;
        }
    }
    return true;
}

// A usable model is better than one that is not and fits hardly better.
static void judge(struct identify_result *result)
{
    const bool sure = agreed(result);
    const double best = result->models[result->chosen].score;
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        struct identify_model *const m = &result->models[kind];
        judge_calm(m, result->plants);
        m->reason = reason_of(m, sure || (m->start < IDENTIFY_MOVING));
    }
    for (int kind = 0; kind < IDENTIFY_KINDS; kind++) {
        const struct identify_model *const m = &result->models[kind];
        if ((result->models[result->chosen].reason != IDENTIFY_USABLE) &&
            (m->reason == IDENTIFY_USABLE) && (m->score < best + AS_GOOD)) {
            result->chosen = kind;
        }
    }
    result->reason = result->models[result->chosen].reason;
}

void identify(const struct identify_recording *in,
              struct identify_result *result)
{
    struct found all[IDENTIFY_KINDS];
    *result = (struct identify_result){0};
    result->reason = record_keep(&record, in, result);
    if (result->reason != IDENTIFY_USABLE) {
        return;
    }
    result->assumed =
        !in->before_known && (record.rest != 0) && (record.rest_lines < REST);
    search_kinds(in, all, result);
    const struct found *const best = &all[result->chosen];
    search_unweigh(&record.all);
    (void)model_error(&best->task, best->numbers);
    if (record_leave_stuck(&record, result)) {
        search_kinds(in, all, result);
    }
    draw_plants(all, result);
    judge(result);
}

int identify_curve(const struct identify_model *model, double *t, double *y)
{
    const struct task task = {&record, &record.all, model->plant.kind,
                              model->start};
    search_unweigh(task.lines);
    search_weigh(&task, &model->plant);
    (void)model_project(&task, &model->plant);
    for (int i = 0; i < task.lines->n; i++) {
        t[i] = task.lines->t[i];
        y[i] = task.lines->y[i] - task.lines->left[i];
    }
    return task.lines->n;
}
