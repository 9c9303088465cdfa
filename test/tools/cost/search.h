// SPDX-License-Identifier: MIT
// The most that a step costs: over recorded rows, over random questions, and
// over a directed search, which changes a short sequence of questions as long
// as that makes a step dearer. The same questions on every machine.
#ifndef SEARCH_H
#define SEARCH_H
#include <stdint.h>

#include "cases.h"

// Asks one question on the machine under test and gives the step's cost; 0 if
// no step was measured.
typedef uint32_t (*search_step)(const union question *question,
                                union answer *answer);

// Which questions are asked of a controller that has features.
enum search_questions {
    QUESTIONS_ALL,
    QUESTIONS_PLAIN,   // without what fewer users want
    QUESTIONS_TYPICAL, // without what FIXPID_PID_FEATURES can leave out
};

struct search_plan {
    const struct controller *controller;
    search_step step;
    uint32_t random_steps;
    uint32_t directed_steps;
    // Outputs of the rows only: what a comparison with another form can ask.
    uint8_t outputs_only;
    uint8_t questions; // of enum search_questions
};

// Prints one line for the rows, the random questions and the search:
//
//   rows steps 2000 least 802 most 953 total 1743210 different 0
//
// The recording comes from vectors.h. Returns how many answers differ.
uint32_t search_run(const struct search_plan *plan);

#endif
