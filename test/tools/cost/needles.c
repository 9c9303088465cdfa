// SPDX-License-Identifier: MIT
// The search for the worst step on this machine:
//
//   needles CONTROLLER COST STEPS SEED
//
// COST is what a step costs: `blocks`, the parts of the controller's code that
// it runs, or one of the functions below of which the most is known, 1000, and
// which only a few sequences reach. `wrong` is as `blocks`, but an answer after
// a change of gains is not the controller's. Prints the lines of search.h and
// what as many steps of random corners cost at most:
//
//   corners most 41
//
// Build with the drivers of all controllers and with their code compiled with
// -fsanitize-coverage=trace-pc, and wrap their steps.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_an937.h"
#include "search.h"

#define MOST 1000u

// ---- The controllers' own code ----

static uint32_t blocks, blocks_of_step;

void __sanitizer_cov_trace_pc(void);

void __sanitizer_cov_trace_pc(void)
{
    blocks++;
}

#define METERED(type, name, parameters, arguments)                             \
    type __real_##name parameters;                                             \
    type __wrap_##name parameters;                                             \
    type __wrap_##name parameters                                              \
    {                                                                          \
        const uint32_t before = blocks;                                        \
        const type result = __real_##name arguments;                           \
        blocks_of_step = blocks - before;                                      \
        return result;                                                         \
    }

METERED(int32_t, fixpid_an937_step, (struct fixpid_an937 * self, int16_t error),
        (self, error))
METERED(int16_t, fixpid_an964_step, (struct fixpid_an964 * self, int16_t error),
        (self, error))
METERED(int16_t, fixpid_an964_8bit_step,
        (struct fixpid_an964_8bit * self, int8_t error), (self, error))
METERED(int16_t, fixpid_pid_step,
        (struct fixpid_pid * self, int16_t setpoint, int16_t measurement),
        (self, setpoint, measurement))

// What a driver answers.
static uint32_t reply(void (*driver)(void), void *exchange, size_t asked,
                      size_t answered, const union question *question,
                      union answer *answer)
{
    blocks_of_step = 0;
    memcpy(exchange, question, asked);
    driver();
    memcpy(answer, exchange, answered);
    return blocks_of_step;
}

static uint32_t step_an937(const union question *question, union answer *answer)
{
    return reply(an937_reply, &an937_exchange, sizeof question->an937,
                 sizeof answer->an937, question, answer);
}

static uint32_t step_an964(const union question *question, union answer *answer)
{
    return reply(an964_reply, &an964_exchange, sizeof question->an964,
                 sizeof answer->an964, question, answer);
}

static uint32_t step_an964_8bit(const union question *question,
                                union answer *answer)
{
    return reply(an964_8bit_reply, &an964_8bit_exchange,
                 sizeof question->an964_8bit, sizeof answer->an964, question,
                 answer);
}

static uint32_t step_pid(const union question *question, union answer *answer)
{
    return reply(pid_reply, &pid_exchange, sizeof question->pid,
                 sizeof answer->pid, question, answer);
}

static uint32_t step_wrong(const union question *question, union answer *answer)
{
    const uint32_t cost = step_pid(question, answer);

    if ((question->pid.calls & CALL_SET_GAINS) != 0u) {
        answer->pid.output ^= 1;
    }
    return cost;
}

// ---- Costs of which the most is known ----

// Of fixpid_pid, without its answers. Each further condition makes a step a
// little dearer, as another branch does.
static uint32_t climbed(const bool conditions[], uint32_t count)
{
    uint32_t cost = MOST - count;

    for (uint32_t at = 0; at < count && conditions[at]; at++) {
        cost++;
    }
    return cost;
}

// What the made-up controllers remember of the steps and settings before.
static struct pid_question settings;
static int32_t derivative;
static int16_t previous;
static bool is_first;

static void take(const struct pid_question *asked)
{
    if ((asked->calls & CALL_INIT) != 0u) {
        settings = *asked;
        is_first = true;
        derivative = 0;
    }
    if ((asked->calls & CALL_SET_GAINS) != 0u) {
        settings.kp_q8 = asked->kp_q8;
        settings.ki_q24 = asked->ki_q24;
        settings.kd_q8 = asked->kd_q8;
        settings.derivative_filter = asked->derivative_filter;
    }
}

// A derivative that is large by one gain and turns by another, smaller one,
// through a filter that was changed, too.
static uint32_t cost_of_gains(const struct pid_question *asked)
{
    const uint16_t gain_before = settings.kd_q8;
    const uint8_t filter_before = settings.derivative_filter;
    const int32_t before = derivative;
    int32_t fall;

    take(asked);
    fall = is_first ? 0 : (int32_t)previous - asked->measurement;
    previous = asked->measurement;
    derivative = (int32_t)settings.kd_q8 * (fall / 2);
    is_first = false;
    {
        const bool conditions[] = {
            (asked->calls & (CALL_INIT | CALL_SET_GAINS)) == CALL_SET_GAINS,
            before > 0x1C000000,
            settings.derivative_filter == 7u && filter_before < 4u,
            settings.kd_q8 != 0u && settings.kd_q8 < gain_before / 2u,
            derivative<-0x08000000, settings.ki_q24> 0x7FFFFFu,
            asked->setpoint < -28000,
        };
        return climbed(conditions, sizeof conditions / sizeof conditions[0]);
    }
}

static bool is_beside(int16_t value, int16_t corner)
{
    return value == corner - 1 || value == corner + 1;
}

// Numbers that are at 1 or 256 or next to them, of either sign.
static uint32_t cost_of_corners(const struct pid_question *asked)
{
    const int16_t before = previous;

    take(asked);
    previous = asked->measurement;
    {
        const bool conditions[] = {
            asked->calls == 0u, asked->measurement == 256,
            asked->setpoint == -256, is_beside(before, -256),
            settings.kd_q8 == 1u};
        return climbed(conditions, sizeof conditions / sizeof conditions[0]);
    }
}

// A difference, a product, a sum and a limit that all saturate, in one step
// after one that saturated on the other side.
static uint32_t cost_of_saturations(const struct pid_question *asked)
{
    const int32_t error = (int32_t)asked->setpoint - asked->measurement;
    const int32_t before = derivative;

    take(asked);
    derivative = error;
    {
        const bool conditions[] = {
            (asked->calls & CALL_INIT) == 0u,
            error > INT16_MAX,
            before<INT16_MIN, (int64_t)settings.kp_q8 * error>
                INT32_C(0x3FFFFFFF),
            settings.output_max == INT16_MAX,
            settings.integral_min > 32700,
            settings.ki_q24 > UINT32_C(0x7FFE0000),
        };
        return climbed(conditions, sizeof conditions / sizeof conditions[0]);
    }
}

// A bit of each of three fields at a time: one or two that are turned make
// nothing dearer yet.
static uint32_t cost_of_plains(const struct pid_question *asked)
{
    bool conditions[8];
    uint32_t wrong;

    take(asked);
    wrong = ((uint16_t)asked->setpoint ^ 0x5A96u) |
            ((uint16_t)asked->measurement ^ 0x39C5u) |
            (settings.kp_q8 ^ 0x2C6Bu);
    for (uint32_t bit = 0; bit < 8u; bit++) {
        conditions[bit] = ((wrong >> bit) & 1u) == 0u;
    }
    return climbed(conditions, 8);
}

// No other step is near to it: it must be known.
static uint32_t cost_of_known(const struct pid_question *asked)
{
    take(asked);
    return settings.kp_q8 == 12345u && settings.kd_q8 == 23456u &&
                   asked->setpoint == -13579 && asked->measurement == 24681
               ? MOST
               : MOST / 2u;
}

static uint32_t (*made_up)(const struct pid_question *asked);

static uint32_t step_made_up(const union question *question,
                             union answer *answer)
{
    (void)answer;
    return made_up(&question->pid);
}

static void define_nothing(const union question *question, union answer *answer)
{
    (void)question;
    (void)answer;
}

// ---- The search, and random corners beside it ----

static uint32_t total; // steps of the search

static search_step counted;

static uint32_t count(const union question *question, union answer *answer)
{
    total++;
    return counted(question, answer);
}

static void corners(uint8_t questions, const struct controller *controller,
                    uint32_t steps, uint32_t seed)
{
    uint32_t most = 0;

    (void)sequence_begin(controller, questions);
    cases_begin(seed);
    total = 0;
    while (total < steps) {
        struct sequence sequence;

        sequence_random(&sequence);
        for (uint8_t at = 0; at < sequence.count; at++) {
            union answer answer;
            const uint32_t cost =
                count(&sequence.segments[at].question, &answer);

            most = cost > most ? cost : most;
        }
    }
    printf("corners most %lu\n", (unsigned long)most);
}

static const struct named {
    const char *name;
    search_step step;
    uint32_t (*made_up)(const struct pid_question *asked);
} costs[] = {
    {"an937 blocks", step_an937, NULL},
    {"an964 blocks", step_an964, NULL},
    {"an964_8bit blocks", step_an964_8bit, NULL},
    {"pid blocks", step_pid, NULL},
    {"pid wrong", step_wrong, NULL},
    {"pid gains", step_made_up, cost_of_gains},
    {"pid corners", step_made_up, cost_of_corners},
    {"pid saturations", step_made_up, cost_of_saturations},
    {"pid plains", step_made_up, cost_of_plains},
    {"pid known", step_made_up, cost_of_known},
};

static const struct named *find(const char *controller, const char *cost)
{
    char name[40];

    (void)snprintf(name, sizeof name, "%s %s", controller, cost);
    for (size_t at = 0; at < sizeof costs / sizeof costs[0]; at++) {
        if (strcmp(costs[at].name, name) == 0) {
            return &costs[at];
        }
    }
    (void)fprintf(stderr, "needles: no %s\n", name);
    exit(2);
}

int main(int argc, char *argv[])
{
    struct controller controller;
    uint32_t different;
    uint32_t steps;

    if (argc != 5) {
        (void)fprintf(stderr, "usage: needles CONTROLLER COST STEPS SEED\n");
        return 2;
    }
    const struct named *const cost = find(argv[1], argv[2]);
    const uint32_t seed = (uint32_t)strtoul(argv[4], NULL, 10);

    counted = cost->step;
    made_up = cost->made_up;
    controller = *controller_named(argv[1]);
    if (made_up != NULL) {
        controller.define = define_nothing;
    }
    const struct search_plan plan = {.controller = &controller,
                                     .step = count,
                                     .row = "no row",
                                     .directed_steps =
                                         (uint32_t)strtoul(argv[3], NULL, 10),
                                     .runs = 1,
                                     .seed = seed};
    different = search_run(&plan);
    steps = total;
    corners(plan.questions, &controller, steps, seed);
    return different == 0u ? 0 : 1;
}
