// SPDX-License-Identifier: MIT
#include "sequence.h"

#include <stddef.h>
#include <string.h>

#include "numbers.h"
#include "put.h"

#define CALLS_ALWAYS 0u // in the place of calls: the step itself reads it
#define BITS_MAX 16u    // of calls

// A number of a question, and which calls read it.
struct field {
    const char *name;
    uint8_t offset;
    uint8_t size;
    int32_t least;
    int32_t most;
    uint16_t calls;
};

// The numbers of a controller's questions, the last one without a name, and the
// names of its calls in the order of their bits; those that have no name are
// not searched. `settle` puts right what one number demands of another.
struct layout {
    const char *controller;
    uint8_t calls_at;
    uint8_t calls_size;
    const struct field *fields;
    const char *calls[BITS_MAX];
    void (*settle)(union question *question);
};

static const struct controller *controller;
static const struct layout *layout;
static uint8_t questions;

// ---- What the questions are made of ----

#define FIELD(type, member, least, most, calls)                                \
#member, offsetof(struct type, member),                                    \
        sizeof(((struct type *)0)->member), least, most, calls

static const struct field an937_fields[] = {
    {FIELD(an937_question, limit, 1, 65535, CALL_INIT | CALL_SET_LIMIT)},
    {FIELD(an937_question, kp_q4, 0, 255, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an937_question, ki_q4, 0, 255, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an937_question, kd_q4, 0, 255, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an937_question, period, 1, 255, CALL_INIT | CALL_SET_PERIOD)},
    {FIELD(an937_question, ticks, 0, 2, CALLS_ALWAYS)},
    {FIELD(an937_question, error, INT16_MIN, INT16_MAX, CALLS_ALWAYS)},
    {NULL, 0, 0, 0, 0, 0},
};

static const struct field an964_fields[] = {
    {FIELD(an964_question, gains.kp, 0, 1023, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_question, gains.ki, 0, 1023, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_question, gains.kd, 0, 1023, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_question, error, INT16_MIN, INT16_MAX, CALLS_ALWAYS)},
    {NULL, 0, 0, 0, 0, 0},
};

static const struct field an964_8bit_fields[] = {
    {FIELD(an964_8bit_question, gains.kp, 0, 127, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_8bit_question, gains.ki, 0, 127, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_8bit_question, gains.kd, 0, 127, CALL_INIT | CALL_SET_GAINS)},
    {FIELD(an964_8bit_question, error, INT8_MIN, INT8_MAX, CALLS_ALWAYS)},
    {NULL, 0, 0, 0, 0, 0},
};

#define GAINS (CALL_INIT | CALL_SET_GAINS)
#define OUTPUTS (CALL_INIT | CALL_SET_LIMITS)
#define INTEGRALS (CALL_INIT | CALL_SET_INTEGRAL_LIMITS)
#define VALUES (CALL_SET_FEEDFORWARD | CALL_SET_MANUAL | CALL_SEED | CALL_TRACK)
#define VALUES_AFTER (CALL_SET_MANUAL_AFTER | CALL_SEED_AFTER)

static const struct field pid_fields[] = {
    {FIELD(pid_question, kp_q8, 0, FIXPID_PID_KP_MAX, GAINS)},
    {FIELD(pid_question, ki_q24, 0, FIXPID_PID_KI_MAX, GAINS)},
    {FIELD(pid_question, kd_q8, 0, FIXPID_PID_KD_MAX, GAINS)},
    {FIELD(pid_question, derivative_filter, 0, FIXPID_PID_FILTER_MAX, GAINS)},
    {FIELD(pid_question, output_min, INT16_MIN, INT16_MAX, OUTPUTS)},
    {FIELD(pid_question, output_max, INT16_MIN, INT16_MAX, OUTPUTS)},
    {FIELD(pid_question, integral_min, -INT16_MAX, INT16_MAX, INTEGRALS)},
    {FIELD(pid_question, integral_max, -INT16_MAX, INT16_MAX, INTEGRALS)},
    {FIELD(pid_question, setpoint_weight_q8, 0, 256, CALL_INIT)},
    {FIELD(pid_question, options, 0, 0xE0, CALL_INIT)},
    {FIELD(pid_question, value, INT16_MIN, INT16_MAX, VALUES)},
    {FIELD(pid_question, shift_before, 0, 255, CALL_TRACK)},
    {FIELD(pid_question, setpoint, INT16_MIN, INT16_MAX, CALLS_ALWAYS)},
    {FIELD(pid_question, measurement, INT16_MIN, INT16_MAX, CALLS_ALWAYS)},
    {FIELD(pid_question, value_after, INT16_MIN, INT16_MAX, VALUES_AFTER)},
    {FIELD(pid_question, applied, INT16_MIN, INT16_MAX, CALL_TRACK_AFTER)},
    {FIELD(pid_question, shift, 0, 255, CALL_TRACK_AFTER)},
    {NULL, 0, 0, 0, 0, 0},
};

// Any of the three ways in which two limits can be put right.
static void put_in_order(int16_t *low, int16_t *high)
{
    const int16_t from = *low;

    if (*low <= *high) {
        return;
    }
    switch (numbers_below(3)) {
    case 0:
        *low = *high;
        break;
    case 1:
        *high = *low;
        break;
    default:
        *low = *high;
        *high = from;
        break;
    }
}

// The output's limits must differ, the integral's may be equal.
static void settle_pid(union question *question)
{
    struct pid_question *const asked = &question->pid;

    asked->options &= 0xE0u;
    if ((asked->options & 0x20u) != 0u) { // P on the measurement
        asked->setpoint_weight_q8 = 0;
    }
    put_in_order(&asked->output_min, &asked->output_max);
    put_in_order(&asked->integral_min, &asked->integral_max);
    if (asked->output_min == asked->output_max) {
        if (asked->output_max == INT16_MAX) {
            asked->output_min--;
        } else {
            asked->output_max++;
        }
    }
}

static const struct layout layouts[] = {
    {"an937",
     offsetof(struct an937_question, calls),
     1,
     an937_fields,
     {"init", "reset", "set_gains", "set_limit", "set_period", "clear_flags",
      "step_percent"},
     NULL},
    {"an964",
     offsetof(struct an964_question, calls),
     1,
     an964_fields,
     {"init", "reset", "set_gains"},
     NULL},
    {"an964_8bit",
     offsetof(struct an964_8bit_question, calls),
     1,
     an964_8bit_fields,
     {"init", "reset", "set_gains"},
     NULL},
    {"pid",
     offsetof(struct pid_question, calls),
     2,
     pid_fields,
     {"init", "reset", "set_gains", "set_limits", "set_integral_limits",
      "set_feedforward", "set_manual", "set_auto", "seed", "track",
      "reset_after", "set_manual_after", "set_auto_after", "seed_after",
      "track_after"},
     settle_pid},
};

// A little-endian machine is below it: see exchange.h.
static int64_t get(const union question *question, const struct field *field)
{
    const uint8_t *const bytes = (const uint8_t *)question + field->offset;
    int64_t value = 0;

    for (uint8_t at = field->size; at > 0u; at--) {
        value = value * 256 + bytes[at - 1u];
    }
    if (field->least < 0 && bytes[field->size - 1u] >= 0x80u) {
        value -= (int64_t)1 << (8u * field->size);
    }
    return value;
}

// The value, or the nearest in the field's range.
static void put(union question *question, const struct field *field,
                int64_t value)
{
    uint8_t *const bytes = (uint8_t *)question + field->offset;
    int64_t limited = value;

    if (limited < field->least) {
        limited = field->least;
    }
    if (limited > field->most) {
        limited = field->most;
    }
    for (uint8_t at = 0; at < field->size; at++) {
        bytes[at] = (uint8_t)((uint64_t)limited >> (8u * at));
    }
}

static void put_calls(union question *question, uint16_t calls)
{
    uint8_t *const bytes = (uint8_t *)question + layout->calls_at;

    bytes[0] = (uint8_t)calls;
    if (layout->calls_size > 1u) {
        bytes[1] = (uint8_t)(calls >> 8);
    }
}

uint16_t sequence_calls(const union question *question)
{
    const uint8_t *const bytes = (const uint8_t *)question + layout->calls_at;

    return (uint16_t)(bytes[0] | (layout->calls_size > 1u ? bytes[1] << 8 : 0));
}

void sequence_clear_calls(union question *question)
{
    put_calls(question, 0);
}

static uint16_t known_calls(void)
{
    uint16_t known = 0;

    for (uint8_t bit = 0; bit < BITS_MAX; bit++) {
        if (layout->calls[bit] != NULL) {
            known = (uint16_t)(known | (1u << bit));
        }
    }
    return known;
}

static bool is_read(const union question *question, const struct field *field)
{
    return field->calls == CALLS_ALWAYS ||
           (sequence_calls(question) & field->calls) != 0u;
}

bool sequence_begin(const struct controller *of, uint8_t kind)
{
    const size_t count = sizeof layouts / sizeof layouts[0];

    controller = of;
    questions = kind;
    for (layout = layouts; layout < layouts + count; layout++) {
        if (strcmp(layout->controller, of->name) == 0) {
            return true;
        }
    }
    return false;
}

// ---- Questions of a kind ----

// Proportional, integral and derivative, with limits.
static void restrict_pid(struct pid_question *asked)
{
    const uint32_t scaled = (asked->ki_q24 & 0x7FFFu) << 8;

    if (asked->ki_q24 > 0x7FFF7Fu) {
        asked->ki_q24 = scaled;
    }
    asked->setpoint_weight_q8 = 256;
    asked->derivative_filter = 0;
    asked->options = 0;
    asked->calls &= CALL_INIT | CALL_RESET | CALL_SET_GAINS | CALL_SET_LIMITS |
                    CALL_SET_INTEGRAL_LIMITS;
}

void sequence_restrict(union question *question)
{
    if (questions != QUESTIONS_ALL) {
        restrict_pid(&question->pid);
    }
}

// Each number in its range, and the controller's init first and only there.
static void settle(struct sequence *sequence)
{
    for (uint8_t at = 0; at < sequence->count; at++) {
        union question *const question = &sequence->segments[at].question;
        uint16_t calls = sequence_calls(question) & known_calls();

        calls = (uint16_t)(at == 0u ? calls | CALL_INIT : calls & ~CALL_INIT);
        put_calls(question, calls);
        for (const struct field *field = layout->fields; field->name != NULL;
             field++) {
            put(question, field, get(question, field));
        }
        if (layout->settle != NULL) {
            layout->settle(question);
        }
        sequence_restrict(question);
    }
}

// ---- Random numbers and sequences ----

static uint8_t any_times(void)
{
    const uint32_t kind = numbers_below(16);

    if (kind == 0u) {
        return (uint8_t)(1u + numbers_below(TIMES_MAX));
    }
    return (uint8_t)(kind < 13u ? 1u : kind < 15u ? 2u : 8u);
}

// An end of the range, 0, 1, 256, or a power of two, of either sign, or one of
// their neighbours. Where a range is a gain's or a shift's, arithmetic changes
// its form at such a number.
static int64_t any_corner(const struct field *field)
{
    static const int8_t beside[] = {0, 0, 0, 1, -1};
    int64_t value = (int64_t)1 << numbers_below(8u * field->size);

    switch (numbers_below(12)) {
    case 0:
    case 1:
        value = field->least;
        break;
    case 2:
        value = field->most;
        break;
    case 3:
        value = 0;
        break;
    case 4:
    case 5:
        value = 1;
        break;
    case 6:
    case 7:
    case 8:
        value = 256;
        break;
    default:
        break;
    }
    if (field->least < 0 && numbers_below(2) == 0u) {
        value = -value;
    }
    return value + beside[numbers_below(sizeof beside)];
}

// Random, but half of the numbers at corners.
static void any_segment(struct segment *segment)
{
    memset(segment, 0, sizeof *segment);
    controller->ask(&segment->question);
    for (const struct field *field = layout->fields; field->name != NULL;
         field++) {
        if (numbers_below(2) == 0u) {
            put(&segment->question, field, any_corner(field));
        }
    }
    segment->times = any_times();
}

void sequence_random(struct sequence *sequence)
{
    sequence->count = (uint8_t)(1u + numbers_below(4));
    for (uint8_t at = 0; at < sequence->count; at++) {
        any_segment(&sequence->segments[at]);
    }
    settle(sequence);
}

// ---- Changes ----

// One of the numbers that a step and its calls read.
static const struct field *any_field(const union question *question)
{
    const struct field *found = NULL;
    uint32_t count = 0;

    for (const struct field *field = layout->fields; field->name != NULL;
         field++) {
        if (is_read(question, field)) {
            count++;
            if (numbers_below(count) == 0u) {
                found = field;
            }
        }
    }
    return found;
}

// The last step is the dearest one.
static struct segment *any_of(struct sequence *sequence)
{
    const uint32_t last = sequence->count - 1u;

    return &sequence->segments[numbers_below(4) == 0u
                                   ? last
                                   : numbers_below(sequence->count)];
}

// What another number of the sequence is, or its opposite, or next to it.
static int64_t any_other(struct sequence *sequence)
{
    const union question *const from = &any_of(sequence)->question;
    const int64_t value = get(from, any_field(from));

    return (numbers_below(4) == 0u ? -value : value) +
           (int64_t)numbers_below(3) - 1;
}

static void change_number(struct sequence *sequence)
{
    union question *const question = &any_of(sequence)->question;
    const struct field *const field = any_field(question);
    const uint32_t bit = numbers_below(8u * field->size);
    int64_t value = get(question, field);

    switch (numbers_below(20)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
        value = any_corner(field);
        break;
    case 7:
    case 8:
    case 9:
        value += (int64_t)(1u << bit) * (numbers_below(2) == 0u ? 1 : -1);
        break;
    case 10:
        value += (int64_t)numbers_below(1u << (bit / 2u)) -
                 (int64_t)numbers_below(1u << (bit / 2u));
        break;
    case 11:
        value = field->least + (int64_t)(numbers_next() & 0x7FFFFFFFu) %
                                   ((int64_t)field->most - field->least + 1);
        break;
    case 12:
        value = any_other(sequence);
        break;
    default:
        value = (int64_t)((uint64_t)value ^ ((uint64_t)1 << bit));
        break;
    }
    put(question, field, value);
}

// The number that a step finds set: by one of the calls before, or 0.
static int64_t in_force(const struct sequence *sequence,
                        const struct segment *step, const struct field *field)
{
    int64_t value = 0;

    for (const struct segment *before = sequence->segments; before < step;
         before++) {
        if (is_read(&before->question, field)) {
            value = get(&before->question, field);
        }
    }
    return value;
}

// A call comes with what is in force, which alone changes nothing and lets the
// numbers change one by one, or with corners.
static void change_call(struct sequence *sequence)
{
    struct segment *const step = any_of(sequence);
    union question *const question = &step->question;
    const bool same = numbers_below(2) == 0u;
    const uint16_t known = known_calls();
    uint16_t bit;

    do {
        bit = (uint16_t)(1u << numbers_below(BITS_MAX));
    } while ((known & bit) == 0u);
    put_calls(question, (uint16_t)(sequence_calls(question) ^ bit));
    for (const struct field *field = layout->fields; field->name != NULL;
         field++) {
        if ((field->calls & bit) != 0u) {
            put(question, field,
                same ? in_force(sequence, step, field) : any_corner(field));
        }
    }
}

static void remove_step(struct sequence *sequence, uint8_t at)
{
    sequence->count--;
    for (uint8_t to = at; to < sequence->count; to++) {
        sequence->segments[to] = sequence->segments[to + 1u];
    }
}

// Another step before this one: like it or another, without calls, or a random
// one.
static void insert_step(struct sequence *sequence, uint8_t at)
{
    struct segment inserted =
        sequence->segments[numbers_below(sequence->count)];

    if (numbers_below(2) == 0u) {
        any_segment(&inserted);
    } else {
        sequence_clear_calls(&inserted.question);
    }
    for (uint8_t to = sequence->count; to > at; to--) {
        sequence->segments[to] = sequence->segments[to - 1u];
    }
    sequence->segments[at] = inserted;
    sequence->count++;
}

// The first step, which has the init, stays.
static void change_steps(struct sequence *sequence)
{
    const uint8_t at = (uint8_t)numbers_below(sequence->count);

    if (numbers_below(2) == 0u) {
        if (at > 0u) {
            remove_step(sequence, at);
        }
    } else if (sequence->count < SEGMENTS_MAX) {
        insert_step(sequence, (uint8_t)(at + 1u));
    }
}

static void change_once(struct sequence *sequence)
{
    struct segment *const segment = any_of(sequence);

    switch (numbers_below(16)) {
    case 0:
        change_steps(sequence);
        break;
    case 1:
        change_call(sequence);
        break;
    case 2:
        segment->times = numbers_below(2) == 0u
                             ? any_times()
                             : (uint8_t)(segment->times % TIMES_MAX + 1u);
        break;
    default:
        change_number(sequence);
        break;
    }
}

void sequence_change(struct sequence *sequence)
{
    do {
        change_once(sequence);
    } while (numbers_below(2) == 0u);
    settle(sequence);
}

// ---- Simpler sequences ----

#define SIMPLER_OF_STEP 64u // numbers of simpler sequences for each step

static bool simplify_field(union question *question, uint32_t number)
{
    const struct field *field = layout->fields;

    for (uint32_t at = 0; at < number && field->name != NULL; at++) {
        field++;
    }
    if (field->name == NULL || !is_read(question, field) ||
        get(question, field) == 0) {
        return false;
    }
    put(question, field, 0);
    return true;
}

static bool simplify_step(struct sequence *sequence, uint8_t at,
                          uint32_t number)
{
    struct segment *const segment = &sequence->segments[at];
    const uint16_t calls = sequence_calls(&segment->question);

    if (number == 0u) {
        if (at == 0u || sequence->count == 1u) {
            return false;
        }
        remove_step(sequence, at);
        return true;
    }
    if (number == 1u) {
        if (segment->times == 1u) {
            return false;
        }
        segment->times = 1;
        return true;
    }
    if (number < 2u + BITS_MAX) {
        const uint16_t bit = (uint16_t)(1u << (number - 2u));

        put_calls(&segment->question, (uint16_t)(calls & ~bit));
        return (calls & bit & ~CALL_INIT) != 0u;
    }
    return simplify_field(&segment->question, number - 2u - BITS_MAX);
}

enum simpler sequence_simplify(struct sequence *sequence, uint32_t number)
{
    const uint32_t at = number / SIMPLER_OF_STEP;
    bool simpler;

    if (at >= sequence->count) {
        return NO_MORE;
    }
    simpler = simplify_step(sequence, (uint8_t)at, number % SIMPLER_OF_STEP);
    settle(sequence);
    return simpler ? SIMPLER : SIMPLE;
}

// ---- The text ----

static void print_value(const char *name, int64_t value)
{
    put_text(" ");
    put_text(name);
    put_text(value < 0 ? " -" : " ");
    put_number("", (uint32_t)(value < 0 ? -value : value));
}

static void print_calls(uint16_t calls)
{
    const char *before = " calls ";

    for (uint8_t bit = 0; bit < BITS_MAX; bit++) {
        if ((calls & (1u << bit)) != 0u) {
            put_text(before);
            put_text(layout->calls[bit]);
            before = ",";
        }
    }
}

void sequence_print(const struct sequence *sequence)
{
    for (uint8_t at = 0; at < sequence->count; at++) {
        const struct segment *const segment = &sequence->segments[at];

        put_number("step times ", segment->times);
        print_calls(sequence_calls(&segment->question));
        for (const struct field *field = layout->fields; field->name != NULL;
             field++) {
            if (is_read(&segment->question, field)) {
                print_value(field->name, get(&segment->question, field));
            }
        }
        put_text("\n");
    }
}
