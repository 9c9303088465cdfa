// SPDX-License-Identifier: MIT
// Autotuners on random plants, for tools/demo and tools/lib/autotune/refit. A
// row for each plant and design, of semicolon-separated values.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peers.h"
#include "wave_features.h"

#define WANTED_MS 1.6

// A loop's Ms is 0 where there is none, and -1 where it is not stable.
static double sensitivity(const struct judge *judge,
                          const struct design *design)
{
    const double found = design->found ? judge_sensitivity(judge, design) : 0.0;

    return (found < HUGE_VAL) ? found : -1.0;
}

static void print_start(const struct subject *subject, long number,
                        const char *tuner, const char *rule)
{
    (void)printf("%ld;%s;%s;%s;", number, family_name(subject->family), tuner,
                 rule);
}

static void print_ours(const struct subject *subject, long number)
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
        print_start(subject, number, "fixpid_autotune",
                    experiment_design_name(i));
        (void)printf("%d;%d;%ld;%.4g;%ld;%.6g;%.4g\n", experiment.status,
                     experiment_reason(&experiment, i), experiment.steps,
                     (double)experiment.steps / subject_scale(subject),
                     experiment.outside, sensitivity(&judge, &design),
                     (design.found && best.found) ? best.ki / design.ki : 0.0);
    }
}

static void print_peers(const struct subject *subject, long number)
{
    struct judge judge;

    judge_start(&judge, subject, JUDGE_FINE);
    for (int peer = 0; peer < PEERS; peer++) {
        struct design designs[PEER_DESIGNS] = {{false, 0.0, 0.0, 0.0, 0}};
        struct subject rested = *subject;
        long steps;
        rested.at_rest = true;
        steps = peers[peer].run(&rested, designs);
        for (int i = 0; i < peers[peer].designs; i++) {
            print_start(subject, number, peers[peer].name,
                        peers[peer].rules[i]);
            (void)printf("0;0;%ld;%.4g;0;%.6g;0\n", steps,
                         (double)steps / subject_scale(subject),
                         sensitivity(&judge, &designs[i]));
        }
    }
}

static void print_features(const struct subject *subject, long number)
{
    struct judge judge;
    struct experiment experiment;
    struct features found;

    experiment_run(&experiment, subject);
    if (experiment.status != FIXPID_AUTOTUNE_DONE) {
        return;
    }
    judge_start(&judge, subject, 2 * JUDGE_COARSE);
    found = features_of(&experiment, &judge, WANTED_MS);
    (void)printf("%ld;%s;%d;%d;%.9g;%.9g;%.9g;%.9g;%.9g;%.9g;%.9g\n", number,
                 family_name(subject->family), found.refused, found.lag,
                 found.middle, found.ratio, found.roundness, found.skew,
                 found.quarrel, found.noise, found.wanted);
}

// What can be asked for.
static const struct {
    const char *name;
    const char *head;
    void (*print)(const struct subject *subject, long number);
} parts[] = {
    {"ours",
     "plant;family;tuner;rule;status;reason;steps;lasts;outside;ms;slower",
     print_ours},
    {"peers",
     "plant;family;tuner;rule;status;reason;steps;lasts;outside;ms;slower",
     print_peers},
    {"features",
     "plant;family;refused;lag;middle;ratio;roundness;skew;quarrel;noise;"
     "wanted",
     print_features}};

static int usage(void)
{
    (void)fprintf(stderr,
                  "usage: random_plants ours|peers|features SEED PLANTS "
                  "[FAMILY]\n");
    return EXIT_FAILURE;
}

static size_t part_named(const char *name)
{
    for (size_t part = 0; part < sizeof parts / sizeof parts[0]; part++) {
        if (strcmp(parts[part].name, name) == 0) {
            return part;
        }
    }
    exit(usage());
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
    if (count != 4 && count != 5) {
        return usage();
    }
    const size_t part = part_named(arguments[1]);
    const unsigned long seed = strtoul(arguments[2], NULL, 10);
    const long plants = strtol(arguments[3], NULL, 10);
    (void)puts(parts[part].head);
    for (long number = 0; number < plants; number++) {
        const enum family family = (count == 5)
                                       ? family_named(arguments[4])
                                       : (enum family)(number % FAMILIES);
        const struct subject subject = draw_subject(seed, number, family);
        parts[part].print(&subject, number);
    }
    return EXIT_SUCCESS;
}
