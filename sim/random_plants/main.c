// SPDX-License-Identifier: MIT
// The random_plants of tools/demo: the autotuner on random plants. A row for
// each plant and rule, of semicolon-separated values.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "evaluation.h"
#include "experiment.h"

#define DONE 2

static const char *const kinds[] = {"lag",        "two lags", "lags",
                                    "integrator", "position", "mixed",
                                    "servo",      "dead time"};

static void print_rows(const struct task *task, int number,
                       const struct evaluation *evaluation, int most_rules)
{
    struct experiment experiment;
    const char *const *rules;
    int count;

    experiment_run(&experiment, task);
    rules = experiment_rules(&count);
    for (int rule = 0; rule < count && rule < most_rules; rule++) {
        struct fixpid_pid_gains gains;
        const bool found = experiment.status == DONE &&
                           experiment_result(&experiment, rule, &gains);
        (void)printf("%d;%s;%s;%s;%d;%ld;%.4g;%ld;%d", number,
                     kinds[task->kind], "autotune", rules[rule],
                     (int)experiment.status, experiment.steps,
                     (double)experiment.steps / lags_scale_steps(&task->plant),
                     experiment.outside, found ? 1 : 0);
        if (found) {
            (void)printf(";%.5g;%.5g\n",
                         evaluation_sensitivity(evaluation, &gains),
                         evaluation_load(evaluation, &gains));
        } else {
            (void)printf(";0;0\n");
        }
    }
}

static int usage(void)
{
    (void)fprintf(stderr, "usage: random_plants SEED PLANTS [KIND [LOAD_SHARE "
                          "[RULES [HOLDING_SHARE]]]]\n");
    return EXIT_FAILURE;
}

static enum kind kind_named(const char *name)
{
    for (int kind = KIND_MIXED; kind <= KIND_DEAD; kind++) {
        if (strcmp(name, kinds[kind]) == 0) {
            return (enum kind)kind;
        }
    }
    exit(usage());
}

// The argument, or what it is by default.
static double argument(int count, char **arguments, int at, double otherwise)
{
    return (count > at) ? strtod(arguments[at], NULL) : otherwise;
}

int main(int count, char **arguments)
{
    struct draw draw;

    if (count < 3) {
        return usage();
    }
    const unsigned long seed = strtoul(arguments[1], NULL, 10);
    const int plants = (int)argument(count, arguments, 2, 0.0);
    draw.kind = (count > 3) ? kind_named(arguments[3]) : KIND_MIXED;
    draw.load_share = argument(count, arguments, 4, 0.25);
    const int rules = (int)argument(count, arguments, 5, 7.0);
    draw.holding = argument(count, arguments, 6, -1.0);
    draw_start(&draw, seed);
    (void)printf("plant;kind;tuner;rule;status;steps;lasts;outside;result;ms;"
                 "iae\n");
    for (int number = 0; number < plants; number++) {
        const struct task task = draw_task(&draw, number);
        struct evaluation evaluation;
        evaluation_start(&evaluation, &task.plant);
        print_rows(&task, number, &evaluation, rules);
    }
    return EXIT_SUCCESS;
}
