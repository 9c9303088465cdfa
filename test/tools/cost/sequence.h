// SPDX-License-Identifier: MIT
// Short sequences of steps, with the calls before and after them: what the
// search for the worst step measures, changes and keeps. Every sequence here is
// one that a program may make: it begins with the controller's init, and each
// number is within its range.
#ifndef SEQUENCE_H
#define SEQUENCE_H
#include <stdbool.h>
#include <stdint.h>

#include "cases.h"

#define SEGMENTS_MAX 6u
#define TIMES_MAX 64u

// A question, and how often its step is repeated: a sum takes time to fill. The
// calls are made with the first of these steps.
struct segment {
    union question question;
    uint8_t times;
};

struct sequence {
    struct segment segments[SEGMENTS_MAX];
    uint8_t count;
};

// Which questions are asked of a controller that has features.
enum search_questions {
    QUESTIONS_ALL,
    QUESTIONS_REDUCED, // without what FIXPID_PID_FEATURES can leave out
};

// The functions below are about this controller's questions, of this kind.
// False if nothing is known of its questions.
bool sequence_begin(const struct controller *controller, uint8_t questions);

// Makes a question one of the kind that is asked. Twice is as good as once.
void sequence_restrict(union question *question);

// The calls of a question; and none of them.
uint16_t sequence_calls(const union question *question);
void sequence_clear_calls(union question *question);

// A random sequence, most of its numbers at corners.
void sequence_random(struct sequence *sequence);

// Changes a bit, a number, a call or a step.
void sequence_change(struct sequence *sequence);

// The simpler sequence of this number: without a step, without a call, or with
// a 0 in the place of another number. False if there is none of the number, or
// if it is simple there.
enum simpler { SIMPLER, SIMPLE, NO_MORE };
enum simpler sequence_simplify(struct sequence *sequence, uint32_t number);

// Prints a line for each step, with all that the step reads:
//
//   step times 1 calls init,set_feedforward kp_q8 256 ... measurement -1
void sequence_print(const struct sequence *sequence);

// A sequence that is kept in kept/, and the rows of the table that it is of, of
// which the last one is null.
struct kept {
    const char *controller;
    const char *const *rows;
    struct sequence sequence;
};

// The last one has no controller.
extern const struct kept kept_sequences[];

#endif
