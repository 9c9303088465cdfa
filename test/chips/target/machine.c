// SPDX-License-Identifier: MIT
// The questions of cases.h to the library on the machine that this program is
// compiled for. It prints for each controller how many answers differ, and a
// digest of all random answers for comparison with other machines:
//
//   an937 rows 2000 different 0
//   an937 random 200000 compared 200000 different 0 digest 0123abcd
//
// MACHINE_STEPS random steps are answered, and the first MACHINE_COMPARED of
// them compared with the definition, which takes a small machine long.
#include <stdio.h>
#include <string.h>

#include "cases.h"
#include "put.h"
#include "vectors.h"

#ifndef MACHINE_STEPS
#define MACHINE_STEPS 200000
#endif
#ifndef MACHINE_COMPARED
#define MACHINE_COMPARED MACHINE_STEPS
#endif

static union question question;
static union answer expected;
static union answer answer;
static uint32_t digest;

static void reply(const struct controller *controller)
{
    memset(&answer, 0, sizeof answer);
    if (controller == &controllers[0]) {
        an937_exchange.question = question.an937;
        an937_reply();
        answer.an937 = an937_exchange.answer;
    } else if (controller == &controllers[1]) {
        an964_exchange.question = question.an964;
        an964_reply();
        answer.an964 = an964_exchange.answer;
    } else if (controller == &controllers[2]) {
        an964_8bit_exchange.question = question.an964_8bit;
        an964_8bit_reply();
        answer.an964 = an964_8bit_exchange.answer;
    } else {
        pid_exchange.question = question.pid;
        pid_reply();
        answer.pid = pid_exchange.answer;
    }
}

static uint32_t differs(const struct controller *controller)
{
    return memcmp(&answer, &expected, controller->answer_size) == 0 ? 0u : 1u;
}

// FNV-1a over the answer's bytes.
static void digest_answer(const struct controller *controller)
{
    const uint8_t *const bytes = (const uint8_t *)&answer;

    for (uint8_t at = 0; at < controller->answer_size; at++) {
        digest = (digest ^ bytes[at]) * UINT32_C(16777619);
    }
}

static uint32_t rows(const struct controller *controller)
{
    int32_t columns[VECTORS_COLUMNS_MAX];
    uint32_t count = 0, different = 0, missing = 0;

    for (const struct recording *from = controller->recordings;
         from->name != NULL; from++) {
        cases_begin(1);
        vectors_open(from->name);
        missing += from->rows;
        while (vectors_next(columns)) {
            from->row(columns, &question, &expected);
            reply(controller);
            count++;
            missing--;
            different += differs(controller);
        }
    }
    put_text(controller->name);
    put_number(" rows ", count);
    put_number(" different ", different);
    put_text("\n");
    return different + missing;
}

static uint32_t random_steps(const struct controller *controller)
{
    uint32_t different = 0;

    cases_begin(1);
    digest = UINT32_C(2166136261);
    for (uint32_t step = 0; step < MACHINE_STEPS; step++) {
        controller->ask(&question);
        reply(controller);
        digest_answer(controller);
        if (step + 1u <= MACHINE_COMPARED) {
            controller->define(&question, &expected);
            different += differs(controller);
        }
    }
    put_text(controller->name);
    put_number(" random ", MACHINE_STEPS);
    put_number(" compared ", MACHINE_COMPARED);
    put_number(" different ", different);
    put_text(" digest ");
    put_hexadecimal(digest);
    put_text("\n");
    return different;
}

int main(void)
{
    uint32_t different = 0;

    for (unsigned number = 0; number < CONTROLLERS; number++) {
        different += rows(&controllers[number]);
        different += random_steps(&controllers[number]);
    }
    return different == 0u ? 0 : 1;
}
