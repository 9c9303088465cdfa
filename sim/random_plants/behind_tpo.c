// SPDX-License-Identifier: MIT
// The same plants tuned twice, with a direct output and behind fixpid_tpo as
// its header tells: ten steps of it for each step of the tuner, and a window of
// one step of the tuner. A row for each plant and way, of semicolon-separated
// values.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiment.h"
#include "fixpid_tpo.h"
#include "judge.h"

#define TPO_STEPS 10 // of each step of the tuner

// By turns: what is only on or off heats, as a rule, and that is a lag.
static const enum family lags[] = {
    FAMILY_LAG_DOMINANT, FAMILY_BALANCED, FAMILY_DEAD_TIME, FAMILY_EQUAL_LAGS,
    FAMILY_TWO_LAGS,     FAMILY_DRIFT,    FAMILY_LOAD};
#define FAMILIES_OF_LAGS ((long)(sizeof(lags) / sizeof(lags[0])))

// The same in steps of the tpo.
static struct subject in_tpo_steps(const struct subject *subject)
{
    struct subject finer = *subject;

    linear_stretch(&finer.plant, TPO_STEPS);
    finer.load_at *= TPO_STEPS;
    return finer;
}

static void run(struct experiment *self, const struct subject *subject,
                bool behind_tpo)
{
    static struct bench bench;
    const struct subject finer = in_tpo_steps(subject);
    const struct fixpid_tpo_config windows = {
        .full = (int16_t)subject->output_max, .window = TPO_STEPS};
    const double rest =
        subject->at_rest ? subject->holding * subject->output_max : 0.0;
    struct fixpid_tpo tpo;

    experiment_start(self, subject, rest);
    (void)fixpid_tpo_init(&tpo, &windows);
    bench_start(&bench, &finer);
    while (self->status == FIXPID_AUTOTUNE_RUNNING &&
           self->steps < EXPERIMENT_STEPS) {
        const int16_t output =
            fixpid_autotune_step(&self->autotune, (int16_t)subject->setpoint,
                                 (int16_t)bench_read(&bench));

        for (int i = 0; i < TPO_STEPS; i++) {
            const int on =
                fixpid_tpo_step(&tpo, output) ? subject->output_max : 0;
            bench_drive(&bench, behind_tpo ? on : output);
        }
        self->steps++;
        self->status = fixpid_autotune_status(&self->autotune);
    }
}

static void print_row(const struct subject *subject, long number,
                      const struct judge *judge, bool behind_tpo)
{
    struct experiment tuned;
    struct design design;
    double sensitivity = 0.0;

    run(&tuned, subject, behind_tpo);
    design = experiment_design(&tuned, DESIGN_PI_SAFE);
    if (design.found) {
        // of a loop that is unstable it has no end
        sensitivity = fmin(judge_sensitivity(judge, &design), 1e9);
    }
    (void)printf("%ld;%s;%s;%d;%ld;%d;%.5g\n", number,
                 family_name(subject->family), behind_tpo ? "tpo" : "direct",
                 (int)tuned.status, tuned.steps, design.found ? 1 : 0,
                 sensitivity);
}

int main(int count, char **arguments)
{
    if (count != 3) {
        (void)fprintf(stderr, "usage: behind_tpo SEED PLANTS\n");
        return EXIT_FAILURE;
    }
    const unsigned long seed = strtoul(arguments[1], NULL, 10);
    const long plants = strtol(arguments[2], NULL, 10);
    (void)printf("plant;family;way;status;steps;result;ms\n");
    for (long number = 0; number < plants; number++) {
        static struct judge judge;
        const struct subject subject =
            draw_subject(seed, number, lags[number % FAMILIES_OF_LAGS]);

        judge_start(&judge, &subject, JUDGE_FINE);
        print_row(&subject, number, &judge, false);
        print_row(&subject, number, &judge, true);
    }
    return EXIT_SUCCESS;
}
