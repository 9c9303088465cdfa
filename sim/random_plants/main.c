// SPDX-License-Identifier: MIT
// A study of a tuner on random plants, for tools/demo:
//
//   random_plants autotune|reaction|advice SEED EACH families|kinds|NAME
//
// with so many plants of each family, of each kind of machine, or of the one
// with this name.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine_subject.h"
#include "studies.h"

struct design study_judge(struct judge *judge, const struct subject *subject)
{
    struct design best;

    judge_start(judge, subject, JUDGE_COARSE);
    best = judge_best(judge, subject->period_steps, BEST_MS);
    judge_start(judge, subject, JUDGE_FINE);
    return best;
}

double study_slower(const struct design *best, const struct design *design)
{
    return (best->found && design->found) ? best->ki / design->ki : 0.0;
}

double study_minutes(const struct subject *subject, long steps)
{
    return (subject->machine != NULL)
               ? (double)steps * subject->machine->step_s / 60.0
               : 0.0;
}

static void usage(void)
{
    (void)fprintf(stderr, "usage: random_plants autotune|reaction|advice "
                          "SEED EACH families|kinds|NAME\n");
    exit(EXIT_FAILURE);
}

static const struct study *study_named(const char *name)
{
    static const struct study *const studies[] = {
        &study_autotune, &study_reaction, &study_advice};

    for (size_t i = 0; i < sizeof studies / sizeof studies[0]; i++) {
        if (strcmp(studies[i]->name, name) == 0) {
            return studies[i];
        }
    }
    usage();
    return NULL;
}

static void tell_families(const struct study *study, unsigned long seed,
                          long each, int first, int count)
{
    for (long number = 0; number < each * count; number++) {
        const enum family family = (enum family)(first + number % count);
        const struct subject subject = draw_subject(seed, number, family);
        study->tell(&subject, number);
    }
}

static void tell_kinds(const struct study *study, unsigned long seed, long each,
                       int first, int count)
{
    static struct machine machine;

    for (int kind = first; kind < first + count; kind++) {
        for (long number = 0; number < each; number++) {
            const struct subject subject = draw_machine_subject(
                &machine, (enum machine_kind)kind, seed, number);
            study->tell(&subject, number);
        }
    }
}

static void tell_one(const struct study *study, unsigned long seed, long each,
                     const char *name)
{
    for (int family = 0; family <= FAMILY_AT_ONCE; family++) {
        if (strcmp(family_name((enum family)family), name) == 0) {
            tell_families(study, seed, each, family, 1);
            return;
        }
    }
    for (int kind = 0; kind <= MACHINE_BOILER; kind++) {
        if (strcmp(machine_name((enum machine_kind)kind), name) == 0) {
            tell_kinds(study, seed, each, kind, 1);
            return;
        }
    }
    usage();
}

int main(int count, char **arguments)
{
    const struct study *study;
    unsigned long seed;
    long each;

    if (count != 5) {
        usage();
    }
    study = study_named(arguments[1]);
    seed = strtoul(arguments[2], NULL, 10);
    each = strtol(arguments[3], NULL, 10);
    (void)puts(study->head);
    if (strcmp(arguments[4], "families") == 0) {
        tell_families(study, seed, each, 0, FAMILIES);
    } else if (strcmp(arguments[4], "kinds") == 0) {
        tell_kinds(study, seed, each, 0, MACHINES);
    } else {
        tell_one(study, seed, each, arguments[4]);
    }
    return EXIT_SUCCESS;
}
