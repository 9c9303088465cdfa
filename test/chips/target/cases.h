// SPDX-License-Identifier: MIT
// Questions for the controllers, recorded and random, and what the notes'
// firmware or the 64-bit definition answers to them. The same sequence on every
// machine.
#ifndef CASES_H
#define CASES_H
#include <stdbool.h>
#include <stdint.h>

#include "exchange.h"

union question {
    struct an937_question an937;
    struct an964_question an964;
    struct an964_8bit_question an964_8bit;
    struct pid_question pid;
};

union answer {
    struct an937_answer an937;
    struct an964_answer an964;
    struct pid_answer pid;
};

// A member of an answer, for messages; the last one has no name.
struct member {
    const char *name;
    uint8_t offset;
    uint8_t size; // 1: unsigned; 2 and 4: signed
};

// A file of test/support/vectors/ by its name, and a question and an answer
// from one of its rows.
struct recording {
    const char *name;
    uint16_t rows;
    void (*row)(const int32_t columns[], union question *question,
                union answer *answer);
};

struct controller {
    const char *name;
    uint8_t question_size;
    uint8_t answer_size;
    uint8_t calls_at;    // of a question's calls, their low byte
    uint8_t object_size; // without padding at its end
    const struct member *members;
    const struct recording *recordings; // the last one has no name

    // The next random question; the first one initialises.
    void (*ask)(union question *question);
    // What the definition answers. It remembers, like the controller, and
    // starts when the program does, like an all-zero controller.
    void (*define)(const union question *question, union answer *answer);
};

#define CONTROLLERS 4
extern const struct controller controllers[CONTROLLERS];

// The controller of this name, or null.
const struct controller *controller_named(const char *name);

// The first row of a recording or the first question of a seed's random
// sequence comes next.
void cases_begin(uint32_t seed);

#endif
