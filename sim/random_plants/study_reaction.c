// SPDX-License-Identifier: MIT
#include <math.h>
#include <stdio.h>

#include "experiment.h"
#include "fixpid_reaction.h"
#include "studies.h"

#define COASTS_PERIODS 6.0
#define LEAST_PART 4 // of the output that is tried

struct heat_up {
    struct fixpid_reaction reaction;
    int status;
    long steps;
    double beyond; // the stop, in percent of the scale; below 0: before it
};

// From cold: an integrator has no such state, and is held before.
static void heat(struct heat_up *self, const struct subject *subject, int part)
{
    static struct bench bench;
    const struct fixpid_reaction_config config = {
        .output_rest =
            (int16_t)(subject->plant.integrating || subject->plant.unstable
                          ? subject->holding * subject->output_max
                          : 0.0),
        .output_drive = (int16_t)(subject->output_max / part),
        .measurement_stop = (int16_t)subject->setpoint,
        .reverse = subject->reverse};
    const double sign = subject->reverse ? -100.0 : 100.0;
    long left = (long)(COASTS_PERIODS * subject->period_steps);

    *self = (struct heat_up){.beyond = -100.0};
    (void)fixpid_reaction_init(&self->reaction, &config);
    bench_start(&bench, subject);
    while (left > 0) {
        const int16_t output =
            fixpid_reaction_step(&self->reaction, (int16_t)bench_read(&bench));
        const double beyond = bench_value(&bench) - subject->setpoint;
        bench_drive(&bench, output);
        self->beyond = fmax(self->beyond, sign * beyond / subject->sensor_max);
        self->status = fixpid_reaction_status(&self->reaction);
        if (self->status == FIXPID_REACTION_RUNNING) {
            self->steps++;
        } else {
            left--;
        }
    }
}

static struct design design_for(const struct heat_up *self, int number)
{
    struct fixpid_pid_gains gains;

    if (!fixpid_reaction_result(&self->reaction, design_rule(number),
                                design_robustness(number), &gains)) {
        return (struct design){.found = false};
    }
    return design_of(&gains);
}

static int tell_part(const struct subject *subject, long number, int part)
{
    static struct heat_up heat_up;
    static struct judge judge;
    struct design best;

    heat(&heat_up, subject, part);
    best = study_judge(&judge, subject);
    for (int i = 0; i < DESIGNS; i++) {
        const struct design design = design_for(&heat_up, i);
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
