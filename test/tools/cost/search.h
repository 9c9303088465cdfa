// SPDX-License-Identifier: MIT
// The worst step that is found: over recorded rows, over random questions, over
// the sequences that are kept, and by a directed search. That changes a short
// sequence of questions as long as it makes a step dearer, first the dearest
// one that is kept and then random ones. The same questions on every machine.
#ifndef SEARCH_H
#define SEARCH_H
#include <stdint.h>

#include "cases.h"
#include "sequence.h"

// Asks one question on the machine under test and gives the step's cost; 0 if
// no step was measured.
typedef uint32_t (*search_step)(const union question *question,
                                union answer *answer);

struct search_plan {
    const struct controller *controller;
    search_step step;
    const char *row; // of the table, as its sequence has it that is kept
    uint32_t random_steps;
    uint32_t directed_steps; // of each run of the search
    uint32_t runs;
    uint32_t seed; // each run has its own random numbers, by this one
    // Outputs of the rows only: what a comparison with another form can ask.
    uint8_t outputs_only;
    uint8_t questions; // of enum search_questions
};

// Prints one line for the rows, the random questions, the sequences that are
// kept and the search, and the cost of the row's own sequence:
//
//   rows steps 2000 least 802 most 953 total 1743210 different 0
//   own cost 953
//
// and, if a sequence is dearer than that, its cost and its steps, as
// sequence_print has them:
//
//   best cost 955
//
// The recording comes from vectors.h. Returns how many answers differ.
uint32_t search_run(const struct search_plan *plan);

#endif
