// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "experiment.h"
#include "heat_up.h"
#include "studies.h"

#define LEAST_PART 4 // of the output that is tried

static int tell_part(const struct subject *subject, long number, int part)
{
    static struct heat_up heat_up;
    static struct judge judge;
    struct design best;

    heat_up_run(&heat_up, subject, part);
    best = study_judge(&judge, subject);
    for (int i = 0; i < DESIGNS; i++) {
        const struct design design = heat_up_design(&heat_up, i);
        (void)printf("%ld;%s;%s;%d;%d;%.4g;%.4g;%.4g;%.6g;%.4g\n", number,
                     subject->name, design_name(i), part, heat_up.status,
                     (double)heat_up.steps / subject->period_steps,
                     study_minutes(subject, heat_up.steps), heat_up.beyond,
                     judge_told(&judge, &design), study_slower(&best, &design));
    }
    return heat_up.status;
}

static void tell(const struct subject *subject, long number)
{
    struct subject cold = *subject;
    int part = 1;

    cold.at_rest = false;
    while (tell_part(&cold, number, part) == FIXPID_REACTION_LIMIT &&
           part < LEAST_PART) {
        part *= 2;
    }
}

const struct study study_reaction = {
    "reaction",
    "plant;family;rule;part;status;periods;minutes;beyond;ms;slower", tell};
