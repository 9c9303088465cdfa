// SPDX-License-Identifier: MIT
#include "search.h"

#include <stddef.h>
#include <string.h>

#include "numbers.h"
#include "put.h"
#include "vectors.h"

#define SEGMENTS 4u   // questions of a sequence
#define CANDIDATES 12 // random sequences, of which the dearest is improved
#define PATIENCE 1500 // changes without success before another start

struct figures {
    uint32_t steps;
    uint32_t least;
    uint32_t most;
    uint32_t total;
    uint32_t different;
};

// A question and how often its step is repeated: a sum takes time to fill.
struct segment {
    union question question;
    uint8_t times;
};

// Where each controller's question has its `calls`, in bytes, which of their
// bits the controller knows, and what makes a question one of those.
struct layout {
    const char *controller;
    uint8_t calls;
    uint8_t calls_size;
    uint8_t known[2];
    void (*restrict_to)(uint8_t questions, union question *question);
};

// Proportional, integral and derivative, with limits. The integral's gain is
// one of 2^-16, as others have it, in plain questions.
static void restrict_pid_to(uint8_t questions, union question *question)
{
    struct pid_question *const asked = &question->pid;

    if (questions == QUESTIONS_PLAIN || asked->ki_q24 > 0x7FFF7Fu) {
        asked->ki_q24 = (asked->ki_q24 & 0x7FFFu) << 8;
    }
    asked->setpoint_weight_q8 = 256;
    asked->derivative_filter = 0;
    asked->options = 0;
    asked->calls &= CALL_INIT | CALL_RESET | CALL_SET_GAINS | CALL_SET_LIMITS |
                    CALL_SET_INTEGRAL_LIMITS;
}

static const struct layout layouts[] = {
    {"an937", offsetof(struct an937_question, calls), 1, {0xFF, 0}, NULL},
    {"an964", offsetof(struct an964_question, calls), 1, {0x07, 0}, NULL},
    {"an964_8bit",
     offsetof(struct an964_8bit_question, calls),
     1,
     {0x07, 0},
     NULL},
    {"pid",
     offsetof(struct pid_question, calls),
     2,
     {0xFF, 0x01},
     restrict_pid_to},
};

static const struct search_plan *plan;
static struct figures figures;
static const struct layout *layout;

static uint8_t *calls_of(union question *question)
{
    return (uint8_t *)question + layout->calls;
}

// ---- One question ----

static void restrict_question(union question *question)
{
    if (plan->questions != QUESTIONS_ALL) {
        layout->restrict_to(plan->questions, question);
    }
}

static void begin(uint32_t seed)
{
    static const struct figures none = {0, UINT32_MAX, 0, 0, 0};

    figures = none;
    cases_begin(seed);
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

    restrict_question(question);
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

    begin(1);
    for (const struct recording *from = plan->controller->recordings;
         from->name != NULL; from++) {
        vectors_open(from->name);
        while (vectors_next(columns)) {
            memset(&question, 0, sizeof question);
            memset(&expected, 0, sizeof expected);
            from->row(columns, &question, &expected);
            restrict_question(&question);
            (void)measure(&question, &expected);
        }
    }
    if (plan->questions != QUESTIONS_ALL) {
        figures.different = 0;
    }
}

static void ask(union question *question)
{
    memset(question, 0, sizeof *question);
    plan->controller->ask(question);
}

static void random_steps(void)
{
    union question question;

    begin(2);
    for (uint32_t step = 0; step < plan->random_steps; step++) {
        ask(&question);
        (void)measure_defined(&question);
    }
}

// ---- The directed search ----

static uint8_t any_times(void)
{
    const uint32_t kind = numbers_below(16);

    if (kind == 0u) {
        return (uint8_t)(1u + numbers_below(64));
    }
    return (uint8_t)(kind < 13u ? 1u : kind < 15u ? 2u : 8u);
}

static void any_segment(struct segment *segment)
{
    ask(&segment->question);
    segment->times = any_times();
}

static void any_sequence(struct segment sequence[SEGMENTS])
{
    for (uint32_t at = 0; at < SEGMENTS; at++) {
        any_segment(&sequence[at]);
    }
}

// A sequence begins with the controller's init, which does not come again.
static void settle_calls(union question *question, bool first)
{
    uint8_t *const calls = calls_of(question);

    for (uint8_t at = 0; at < layout->calls_size; at++) {
        calls[at] &= first ? 0u : layout->known[at];
    }
    calls[0] = (uint8_t)(calls[0] & ~CALL_INIT);
    if (first) {
        calls[0] = CALL_INIT;
    }
}

// The dearest step of a sequence; a segment's calls are made with its first.
static uint32_t try_sequence(const struct segment sequence[SEGMENTS])
{
    uint32_t most = 0;

    for (uint32_t at = 0; at < SEGMENTS; at++) {
        union question question = sequence[at].question;

        settle_calls(&question, at == 0u);
        for (uint8_t time = 0; time < sequence[at].times; time++) {
            const uint32_t cost = measure_defined(&question);

            memset(calls_of(&question), 0, layout->calls_size);
            if (cost > most) {
                most = cost;
            }
        }
    }
    return most;
}

// A word at one of the ends of a range, or next to a power of two.
static uint16_t any_corner(void)
{
    static const uint16_t corners[] = {0x0000, 0x0001, 0xFFFF, 0x7FFF, 0x8000,
                                       0x8001, 0x00FF, 0x0100, 0x0101, 0xFEFF,
                                       0xFF00, 0xFF01, 0x007F, 0x0080, 0xFF80};

    return corners[numbers_below(sizeof corners / sizeof corners[0])];
}

// A bit, a word, a small number more or less, or some bytes of a fresh
// question.
static void change_bytes(union question *question)
{
    const uint32_t size = plan->controller->question_size;
    uint8_t *const bytes = (uint8_t *)question;
    const uint32_t from = numbers_below(size);
    const uint32_t count = 1u + numbers_below(size - from);
    const uint32_t word_at = (from & ~1u) % (size - 1u);
    const uint32_t kind = numbers_below(16);
    union question fresh;
    uint16_t word;

    memcpy(&word, bytes + word_at, sizeof word);
    if (kind < 6u) {
        bytes[from] = (uint8_t)(bytes[from] ^ (1u << numbers_below(8)));
    } else if (kind < 8u) {
        word = any_corner();
        memcpy(bytes + word_at, &word, sizeof word);
    } else if (kind < 10u) {
        word = (uint16_t)(word + (1u << numbers_below(9)) -
                          (numbers_below(2) << numbers_below(10)));
        memcpy(bytes + word_at, &word, sizeof word);
    } else if (kind < 11u) {
        word = (uint16_t)numbers_next();
        memcpy(bytes + word_at, &word, sizeof word);
    } else {
        ask(&fresh);
        memcpy(bytes + from, (const uint8_t *)&fresh + from,
               numbers_below(2) == 0u ? 1u : count);
    }
}

static void change(struct segment sequence[SEGMENTS])
{
    struct segment *const segment = &sequence[numbers_below(SEGMENTS)];

    switch (numbers_below(12)) {
    case 0:
        segment->times = any_times();
        break;
    case 1:
        segment->times = (uint8_t)(segment->times % 64u + 1u);
        break;
    case 2:
        any_segment(segment);
        break;
    case 3:
        *segment = sequence[numbers_below(SEGMENTS)];
        break;
    default:
        change_bytes(&segment->question);
        break;
    }
}

// The dearest of a few random sequences.
static uint32_t begin_sequence(struct segment best[SEGMENTS])
{
    struct segment sequence[SEGMENTS];
    uint32_t most = 0;

    for (int candidate = 0; candidate < CANDIDATES; candidate++) {
        uint32_t cost;

        any_sequence(sequence);
        cost = try_sequence(sequence);
        if (cost >= most) {
            most = cost;
            memcpy(best, sequence, sizeof sequence);
        }
    }
    return most;
}

static void climb(void)
{
    struct segment best[SEGMENTS];
    struct segment sequence[SEGMENTS];
    uint32_t most = begin_sequence(best);
    uint32_t failures = 0;

    while (failures < PATIENCE && figures.steps < plan->directed_steps) {
        uint32_t cost;

        memcpy(sequence, best, sizeof sequence);
        do {
            change(sequence);
        } while (numbers_below(2) == 0u);
        cost = try_sequence(sequence);
        failures = cost > most ? 0u : failures + 1u;
        if (cost >= most) {
            most = cost;
            memcpy(best, sequence, sizeof sequence);
        }
    }
}

static void directed_steps(void)
{
    begin(3);
    while (figures.steps < plan->directed_steps) {
        climb();
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

static bool find_layout(const char *controller)
{
    const size_t count = sizeof layouts / sizeof layouts[0];

    for (layout = layouts; layout < layouts + count; layout++) {
        if (strcmp(layout->controller, controller) == 0) {
            return true;
        }
    }
    return false;
}

uint32_t search_run(const struct search_plan *of)
{
    uint32_t different;

    plan = of;
    if (!find_layout(of->controller->name)) {
        put_text("no layout of its questions\n");
        return 1;
    }
    rows();
    different = report("rows");
    random_steps();
    different += report("random");
    directed_steps();
    return different + report("search");
}
