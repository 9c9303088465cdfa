// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "experiment.h"
#include "studies.h"

static void tell(const struct subject *subject, long number)
{
    static struct experiment experiment;
    static struct judge judge;
    struct design best;

    experiment_run(&experiment, subject);
    best = study_judge(&judge, subject);
    for (int i = 0; i < DESIGNS; i++) {
        const struct design design = experiment_design(&experiment, i);
        (void)printf("%ld;%s;%s;%d;%d;%d;%.4g;%.4g;%.4g;%ld;%.6g;%.4g\n",
                     number, subject->name, design_name(i), experiment.status,
                     experiment_reason(&experiment, i), best.found ? 1 : 0,
                     (double)experiment.steps / subject_scale(subject),
                     (double)experiment.steps / subject->period_steps,
                     study_minutes(subject, experiment.steps),
                     experiment.outside, judge_told(&judge, &design),
                     study_slower(&best, &design));
    }
}

const struct study study_autotune = {
    "autotune",
    "plant;family;rule;status;reason;possible;lasts;periods;minutes;outside;"
    "ms;slower",
    tell};
