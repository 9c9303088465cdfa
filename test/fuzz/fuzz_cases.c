// SPDX-License-Identifier: MIT
// A controller, FUZZ_CONTROLLER, against its definition: an input is a sequence
// of questions (test/chips/target/exchange.h), of which one in four is raw
// bytes. The first one initialises, in an object of other bytes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "fuzz.h"
#include "numbers.h"

#define EXCHANGE FIXPID_JOINED(FUZZ_CONTROLLER, exchange)
#define REPLY FIXPID_JOINED(FUZZ_CONTROLLER, reply)
#define TEXT_OF(name) TEXT_OF_(name)
#define TEXT_OF_(name) #name

static union question question;
static union answer expected, answer;

static void ask(const struct controller *controller, bool first)
{
    uint8_t *const bytes = (uint8_t *)&question;

    if (numbers_below(4) != 0u) {
        controller->ask(&question);
        return;
    }
    for (uint8_t at = 0; at < controller->question_size; at++) {
        bytes[at] = (uint8_t)numbers_below(256);
    }
    if (first) {
        bytes[controller->calls_at] |= CALL_INIT;
    }
}

static long member_of(const union answer *from, const struct member *member)
{
    const uint8_t *const at = (const uint8_t *)from + member->offset;
    int16_t of_2 = 0;
    int32_t of_4 = 0;

    if (member->size == 1u) {
        return *at;
    }
    if (member->size == 2u) {
        memcpy(&of_2, at, sizeof of_2);
        return of_2;
    }
    memcpy(&of_4, at, sizeof of_4);
    return of_4;
}

static void compare(const struct controller *controller)
{
    if (memcmp(&answer, &expected, controller->answer_size) == 0) {
        return;
    }
    for (const struct member *member = controller->members;
         member->name != NULL; member++) {
        const long given = member_of(&answer, member);
        const long defined = member_of(&expected, member);

        if (given != defined) {
            fprintf(stderr, "%s %ld, defined as %ld\n", member->name, given,
                    defined);
        }
    }
    abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const struct controller *const controller =
        controller_named(TEXT_OF(FUZZ_CONTROLLER));
    bool first = true;

    numbers_from(data, size);
    cases_begin(1);
    while (numbers_are_left()) {
        ask(controller, first);
        controller->define(&question, &expected);
        memcpy(&EXCHANGE.question, &question, controller->question_size);
        REPLY();
        memcpy(&answer, &EXCHANGE.answer, controller->answer_size);
        compare(controller);
        first = false;
    }
    return 0;
}
