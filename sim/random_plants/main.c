// SPDX-License-Identifier: MIT
// The autotuner on random plants, for tools/demo: random_plants SEED PLANTS
// [FAMILY]. A row for each plant and design, of semicolon-separated values.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "experiment.h"
#include "judge.h"

#define WANTED_MS 1.6

// A loop's Ms is 0 where there is none, and -1 where it is not stable.
static double sensitivity(const struct judge *judge,
                          const struct design *design)
{
    const double found = design->found ? judge_sensitivity(judge, design) : 0.0;

    return (found < HUGE_VAL) ? found : -1.0;
}

static void print_designs(const struct subject *subject, long number)
{
    struct judge judge;
    struct design best;
    struct experiment experiment;

    experiment_run(&experiment, subject);
    judge_start(&judge, subject, JUDGE_COARSE);
    best = judge_best(&judge, subject->period_steps, WANTED_MS);
    judge_start(&judge, subject, JUDGE_FINE);
    for (int i = 0; i < DESIGNS; i++) {
        const struct design design = experiment_design(&experiment, i);
        (void)printf("%ld;%s;%s;%d;%d;%ld;%.4g;%ld;%.6g;%.4g\n", number,
                     family_name(subject->family), experiment_design_name(i),
                     experiment.status, experiment_reason(&experiment, i),
                     experiment.steps,
                     (double)experiment.steps / subject_scale(subject),
                     experiment.outside, sensitivity(&judge, &design),
                     (design.found && best.found) ? best.ki / design.ki : 0.0);
    }
}

static int usage(void)
{
    (void)fprintf(stderr, "usage: random_plants SEED PLANTS [FAMILY]\n");
    return EXIT_FAILURE;
}

static enum family family_named(const char *name)
{
    for (int family = 0; family <= FAMILY_AT_ONCE; family++) {
        if (strcmp(family_name((enum family)family), name) == 0) {
            return (enum family)family;
        }
    }
    exit(usage());
}

int main(int count, char **arguments)
{
    if (count != 3 && count != 4) {
        return usage();
    }
    const unsigned long seed = strtoul(arguments[1], NULL, 10);
    const long plants = strtol(arguments[2], NULL, 10);
    (void)puts("plant;family;rule;status;reason;steps;lasts;outside;ms;slower");
    for (long number = 0; number < plants; number++) {
        const enum family family = (count == 4)
                                       ? family_named(arguments[3])
                                       : (enum family)(number % FAMILIES);
        const struct subject subject = draw_subject(seed, number, family);
        print_designs(&subject, number);
    }
    return EXIT_SUCCESS;
}
