// SPDX-License-Identifier: MIT
#include <stdio.h>

#include "experiment.h"
#include "studies.h"

#define FIFTH 0.2
#define THIRD (1.0 / 3.0)

// What may change. To change nothing is to run it once more.
enum change {
    STEADY = 1, // no load, and calm surroundings
    AT_REST = 2,
    NARROW = 4, // a fifth of the output to each side of what holds
    CYCLES = 8,
    FASTER = 16,
    SLOWER = 32
};

// For which end; each is tried alone.
static const struct advice {
    uint8_t status;
    uint8_t reason; // FIXPID_AUTOTUNE_NOT_DONE: any
    unsigned changes;
} advices[] = {
    {FIXPID_AUTOTUNE_SATURATED, FIXPID_AUTOTUNE_NOT_DONE, AT_REST},
    {FIXPID_AUTOTUNE_IRREGULAR, FIXPID_AUTOTUNE_NOT_DONE, 0},
    {FIXPID_AUTOTUNE_IRREGULAR, FIXPID_AUTOTUNE_NOT_DONE, STEADY},
    {FIXPID_AUTOTUNE_IRREGULAR, FIXPID_AUTOTUNE_NOT_DONE, STEADY | AT_REST},
    {FIXPID_AUTOTUNE_IRREGULAR, FIXPID_AUTOTUNE_NOT_DONE,
     STEADY | AT_REST | NARROW},
    {FIXPID_AUTOTUNE_NO_OSCILLATION, FIXPID_AUTOTUNE_NOT_DONE, 0},
    {FIXPID_AUTOTUNE_NO_OSCILLATION, FIXPID_AUTOTUNE_NOT_DONE,
     STEADY | AT_REST},
    {FIXPID_AUTOTUNE_TOO_FAST, FIXPID_AUTOTUNE_NOT_DONE, 0},
    {FIXPID_AUTOTUNE_TOO_FAST, FIXPID_AUTOTUNE_NOT_DONE, FASTER},
    {FIXPID_AUTOTUNE_TOO_SMALL, FIXPID_AUTOTUNE_NOT_DONE, 0},
    {FIXPID_AUTOTUNE_TOO_SMALL, FIXPID_AUTOTUNE_NOT_DONE, CYCLES},
    {FIXPID_AUTOTUNE_TOO_SLOW, FIXPID_AUTOTUNE_NOT_DONE, SLOWER},
    {FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_SHAPE, 0},
    {FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_SHAPE, STEADY | AT_REST},
    {FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_RUNS_AWAY, 0},
    {FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_RUNS_AWAY, STEADY | AT_REST},
    {FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_GAIN_TOO_SMALL, SLOWER},
};

static bool is_for(const struct advice *advice,
                   const struct experiment *experiment)
{
    return advice->status == experiment->status &&
           (advice->reason == FIXPID_AUTOTUNE_NOT_DONE ||
            advice->reason == experiment_reason(experiment, DESIGN_PI_SAFE));
}

static void sample(struct subject *subject, struct machine *machine,
                   double faster)
{
    subject->timeout_steps = (int)(subject->timeout_steps * faster);
    if (subject->timeout_steps > 32767) {
        subject->timeout_steps = 32767;
    }
    subject->period_steps *= faster;
    machine->step_s /= faster;
    linear_stretch(&subject->plant, faster);
}

// `machine` is the subject's own from now on.
static void follow(unsigned changes, struct subject *subject,
                   struct machine *machine)
{
    if (subject->machine != NULL) {
        *machine = *subject->machine;
        subject->machine = machine;
    }
    if (changes & STEADY) {
        machine->swing = 0.0;
        subject->load_at = -1;
        subject->drift = 0.0;
    }
    subject->at_rest = subject->at_rest || (changes & AT_REST);
    subject->each_side = (changes & NARROW) ? FIFTH : 0.0;
    subject->cycles = (changes & CYCLES) ? 3 : subject->cycles;
    if (changes & FASTER) {
        sample(subject, machine, 3.0);
    } else if (changes & SLOWER) {
        sample(subject, machine, THIRD);
    }
    subject->chance.state = chance_bits(&subject->chance);
}

static void print_changes(unsigned changes)
{
    static const char *const names[] = {"steady",       "at rest", "narrow",
                                        "three cycles", "faster",  "slower"};
    const char *before = "";

    if (changes == 0) {
        (void)printf("once more");
    }
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (changes & (1u << i)) {
            (void)printf("%s%s", before, names[i]);
            before = ", ";
        }
    }
}

static void tell_advice(const struct advice *advice,
                        const struct subject *before, long number,
                        const struct experiment *ended)
{
    static struct experiment experiment;
    static struct machine machine;
    static struct judge judge;
    struct subject subject = *before;
    struct design design;

    follow(advice->changes, &subject, &machine);
    experiment_run(&experiment, &subject);
    judge_start(&judge, &subject, JUDGE_FINE);
    design = experiment_design(&experiment, DESIGN_PI_SAFE);
    (void)printf("%ld;%s;%d;%d;", number, subject.name, ended->status,
                 experiment_reason(ended, DESIGN_PI_SAFE));
    print_changes(advice->changes);
    (void)printf(";%d;%d;%.6g\n", experiment.status,
                 experiment_reason(&experiment, DESIGN_PI_SAFE),
                 judge_told(&judge, &design));
}

static void tell(const struct subject *subject, long number)
{
    static struct experiment experiment;

    experiment_run(&experiment, subject);
    for (size_t i = 0; i < sizeof advices / sizeof advices[0]; i++) {
        if (is_for(&advices[i], &experiment)) {
            tell_advice(&advices[i], subject, number, &experiment);
        }
    }
}

const struct study study_advice = {
    "advice", "plant;family;status;reason;advice;status_then;reason_then;ms",
    tell};
