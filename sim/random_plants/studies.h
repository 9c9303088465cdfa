// SPDX-License-Identifier: MIT
// What is done with each subject, in rows of semicolon-separated values. A
// loop's Ms is 0 where there is none, and -1 where it is not stable; `slower`
// is the sum of its errors over that with the best PI controller, 0 if unknown.
#ifndef STUDIES_H
#define STUDIES_H
#include "families.h"
#include "judge.h"

#define BEST_MS 1.6

struct study {
    const char *name;
    const char *head;
    void (*tell)(const struct subject *subject, long number);
};

// fixpid_autotune: a row for each design.
extern const struct study study_autotune;

// fixpid_reaction from cold, with the setpoint as its stop, and once more with
// half the output where that ended with LIMIT: a row for each design.
extern const struct study study_reaction;

// fixpid_autotune once more, as the documents advise, where it gave no gains
// for PI safe: a row for each piece of advice.
extern const struct study study_advice;

// The best PI of Ms 1.6, and the judge for others.
struct design study_judge(struct judge *judge, const struct subject *subject);

double study_slower(const struct design *best, const struct design *design);

// A subject's step, of a linear plant 0.
double study_minutes(const struct subject *subject, long steps);

#endif
