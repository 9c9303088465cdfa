// SPDX-License-Identifier: MIT
#include "search.h"

#include <stddef.h>
#include <string.h>

#include "numbers.h"
#include "put.h"
#include "sequence.h"
#include "vectors.h"

#define CANDIDATES 12u // random sequences, of which the dearest is improved
#define PATIENCE 1000u // changes without success before another start

struct figures {
    uint32_t steps;
    uint32_t least;
    uint32_t most;
    uint32_t total;
    uint32_t different;
};

// A sequence, and the cost of its dearest step.
struct found {
    struct sequence sequence;
    uint32_t cost;
};

static const struct search_plan *plan;
static struct figures figures;
static struct found best; // of all
static uint32_t own_cost; // of the sequence that is kept for this row, or 0

// ---- One question ----

static void begin(void)
{
    static const struct figures none = {0, UINT32_MAX, 0, 0, 0};

    figures = none;
}

static uint32_t differs(const union answer *expected, const union answer *given)
{
    const struct member *const output = plan->controller->members;
    size_t size = plan->controller->answer_size;

    if (plan->outputs_only != 0u) {
        size = output->size;
        expected = (const void *)((const uint8_t *)expected + output->offset);
        given = (const void *)((const uint8_t *)given + output->offset);
    }
    return memcmp(expected, given, size) == 0 ? 0u : 1u;
}

static uint32_t measure(const union question *question,
                        const union answer *expected)
{
    union answer given;
    uint32_t cost;

    memset(&given, 0, sizeof given);
    cost = plan->step(question, &given);
    figures.different += differs(expected, &given);
    if (cost == 0u) {
        return 0;
    }
    figures.steps++;
    figures.total += cost;
    if (cost < figures.least) {
        figures.least = cost;
    }
    if (cost > figures.most) {
        figures.most = cost;
    }
    return cost;
}

// With what the definition answers, where it is comparable.
static uint32_t measure_defined(union question *question)
{
    union answer expected;
    const uint32_t different = figures.different;
    uint32_t cost;

    sequence_restrict(question);
    memset(&expected, 0, sizeof expected);
    plan->controller->define(question, &expected);
    cost = measure(question, &expected);
    if (plan->outputs_only != 0u) {
        figures.different = different;
    }
    return cost;
}

// ---- Rows and random questions ----

// The answers to restricted rows were not recorded.
static void rows(void)
{
    int32_t columns[VECTORS_COLUMNS_MAX];
    union question question;
    union answer expected;

    begin();
    cases_begin(1);
    for (const struct recording *from = plan->controller->recordings;
         from->name != NULL; from++) {
        vectors_open(from->name);
        while (vectors_next(columns)) {
            memset(&question, 0, sizeof question);
            memset(&expected, 0, sizeof expected);
            from->row(columns, &question, &expected);
            sequence_restrict(&question);
            (void)measure(&question, &expected);
        }
    }
    if (plan->questions != QUESTIONS_ALL) {
        figures.different = 0;
    }
}

static void random_steps(void)
{
    union question question;

    begin();
    cases_begin(2);
    for (uint32_t step = 0; step < plan->random_steps; step++) {
        memset(&question, 0, sizeof question);
        plan->controller->ask(&question);
        (void)measure_defined(&question);
    }
}

// ---- Sequences ----

// The cost of the dearest step. The sequence ends with it from now on: what
// comes later cannot make it dearer.
static uint32_t try_sequence(struct sequence *sequence)
{
    uint32_t most = 0;
    uint8_t count = sequence->count;
    uint8_t times = sequence->segments[count - 1u].times;

    for (uint8_t at = 0; at < sequence->count; at++) {
        union question question = sequence->segments[at].question;

        for (uint8_t time = 1; time <= sequence->segments[at].times; time++) {
            const uint32_t cost = measure_defined(&question);

            sequence_clear_calls(&question);
            if (cost > most) {
                most = cost;
                count = (uint8_t)(at + 1u);
                times = time;
            }
        }
    }
    sequence->count = count;
    sequence->segments[count - 1u].times = times;
    return most;
}

static void remember(const struct found *found)
{
    if (found->cost > best.cost) {
        best = *found;
    }
}

static bool is_own(const char *const *rows)
{
    while (*rows != NULL && strcmp(*rows, plan->row) != 0) {
        rows++;
    }
    return *rows != NULL;
}

static bool is_of_controller(const struct kept *one)
{
    return strcmp(one->controller, plan->controller->name) == 0;
}

// One of those that are kept for this controller, if there is one.
static void pick_kept(struct sequence *sequence)
{
    uint32_t count = 0;

    for (const struct kept *one = kept_sequences; one->controller != NULL;
         one++) {
        if (is_of_controller(one)) {
            count++;
            if (numbers_below(count) == 0u) {
                *sequence = one->sequence;
            }
        }
    }
}

// Those that are kept for any row of this controller.
static void kept(void)
{
    struct found found;

    begin();
    for (const struct kept *one = kept_sequences; one->controller != NULL;
         one++) {
        if (is_of_controller(one)) {
            found.sequence = one->sequence;
            found.cost = try_sequence(&found.sequence);
            remember(&found);
            if (is_own(one->rows)) {
                own_cost = found.cost;
            }
        }
    }
}

// ---- The directed search ----

// The dearest of a few random sequences.
static void begin_randomly(struct found *from)
{
    struct found candidate;

    from->cost = 0;
    for (uint32_t number = 0; number < CANDIDATES; number++) {
        sequence_random(&candidate.sequence);
        candidate.cost = try_sequence(&candidate.sequence);
        if (candidate.cost >= from->cost) {
            *from = candidate;
        }
    }
}

// The dearest sequence or one that is kept, changed more than a climb changes
// it.
static void begin_beside(struct found *from)
{
    const uint32_t changes = numbers_below(8);

    from->sequence = best.sequence;
    if (numbers_below(2) == 0u) {
        pick_kept(&from->sequence);
    }
    for (uint32_t change = 0; change < changes; change++) {
        sequence_change(&from->sequence);
    }
    from->cost = try_sequence(&from->sequence);
}

// Changes a sequence as long as that makes its dearest step dearer now and
// then. One that is as dear is taken, too, which leads across plains.
static void climb(struct found *from, uint32_t steps)
{
    uint32_t failures = 0;

    while (failures < PATIENCE && figures.steps < steps) {
        struct found changed = *from;

        sequence_change(&changed.sequence);
        changed.cost = try_sequence(&changed.sequence);
        failures = changed.cost > from->cost ? 0u : failures + 1u;
        if (changed.cost >= from->cost) {
            *from = changed;
        }
    }
    remember(from);
}

// First from the dearest sequence that is known.
static void directed_steps(void)
{
    struct found from = best;

    begin();
    for (uint32_t run = 1; run <= plan->runs; run++) {
        cases_begin(plan->seed + run);
        if (best.cost > 0u) {
            from = best;
            climb(&from, run * plan->directed_steps);
        }
        while (figures.steps < run * plan->directed_steps) {
            if (best.cost == 0u || numbers_below(2) == 0u) {
                begin_randomly(&from);
            } else {
                begin_beside(&from);
            }
            climb(&from, run * plan->directed_steps);
        }
    }
}

// ---- The report ----

static uint32_t report(const char *name)
{
    put_text(name);
    put_number(" steps ", figures.steps);
    put_number(" least ", figures.least);
    put_number(" most ", figures.most);
    put_number(" total ", figures.total);
    put_number(" different ", figures.different);
    put_text("\n");
    return figures.different;
}

// The dearest sequence, without what does not make it dear.
static uint32_t report_best(void)
{
    enum simpler simpler = SIMPLE;

    begin();
    for (uint32_t number = 0; simpler != NO_MORE; number++) {
        struct found candidate = best;

        simpler = sequence_simplify(&candidate.sequence, number);
        if (simpler == SIMPLER) {
            candidate.cost = try_sequence(&candidate.sequence);
            if (candidate.cost >= best.cost) {
                best = candidate;
            }
        }
    }
    put_number("best cost ", best.cost);
    put_text("\n");
    sequence_print(&best.sequence);
    return figures.different;
}

uint32_t search_run(const struct search_plan *of)
{
    uint32_t different;

    plan = of;
    best.cost = 0;
    own_cost = 0;
    if (!sequence_begin(of->controller, of->questions)) {
        put_text("nothing is known of its questions\n");
        return 1;
    }
    rows();
    different = report("rows");
    random_steps();
    different += report("random");
    kept();
    different += report("kept");
    directed_steps();
    different += report("search");
    put_number("own cost ", own_cost);
    put_text("\n");
    return best.cost > own_cost ? different + report_best() : different;
}
