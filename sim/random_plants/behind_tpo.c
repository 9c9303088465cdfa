// SPDX-License-Identifier: MIT
// The same plants tuned twice, with a direct output and behind fixpid_tpo as
// its header tells: ten steps of it for each step of the tuner, and a window of
// one step of the tuner. A row for each plant and way, of semicolon-separated
// values.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "fixpid_autotune.h"
#include "fixpid_tpo.h"
#include "judge.h"

#define STEPS_MAX 4000000L
#define TPO_STEPS 10 // of each step of the tuner

// By turns: what is only on or off heats, as a rule, and that is a lag.
static const enum family lags[] = {
    FAMILY_LAG_DOMINANT, FAMILY_BALANCED, FAMILY_DEAD_TIME, FAMILY_EQUAL_LAGS,
    FAMILY_TWO_LAGS,     FAMILY_DRIFT,    FAMILY_LOAD};
#define FAMILIES_OF_LAGS ((long)(sizeof(lags) / sizeof(lags[0])))

struct tuned {
    struct fixpid_autotune tuner;
    long steps;
};

// The same in steps of the tpo.
static struct subject in_tpo_steps(const struct subject *subject)
{
    struct subject finer = *subject;

    linear_stretch(&finer.plant, TPO_STEPS);
    finer.load_at *= TPO_STEPS;
    return finer;
}

static void start(struct fixpid_autotune *tuner, const struct subject *subject)
{
    const double rest =
        subject->at_rest ? subject->holding * subject->output_max : 0.0;
    const struct fixpid_autotune_config config = {
        .output_min = 0,
        .output_max = (int16_t)subject->output_max,
        .output_rest = (int16_t)rest,
        .measurement_min = 0,
        .measurement_max = (int16_t)subject->sensor_max,
        .swing = (uint16_t)subject->swing,
        .timeout_steps = (uint16_t)subject->timeout_steps,
        .cycles = 2,
    };
    (void)fixpid_autotune_init(tuner, &config);
}

static void run(struct tuned *self, const struct subject *subject,
                bool behind_tpo)
{
    static struct bench bench;
    const struct subject finer = in_tpo_steps(subject);
    const struct fixpid_tpo_config windows = {
        .full = (int16_t)subject->output_max, .window = TPO_STEPS};
    struct fixpid_tpo tpo;

    start(&self->tuner, subject);
    (void)fixpid_tpo_init(&tpo, &windows);
    bench_start(&bench, &finer);
    self->steps = 0;
    while ((fixpid_autotune_status(&self->tuner) == FIXPID_AUTOTUNE_RUNNING) &&
           (self->steps < STEPS_MAX)) {
        const int16_t output =
            fixpid_autotune_step(&self->tuner, (int16_t)subject->setpoint,
                                 (int16_t)bench_read(&bench));

        for (int i = 0; i < TPO_STEPS; i++) {
            const int on =
                fixpid_tpo_step(&tpo, output) ? subject->output_max : 0;
            bench_drive(&bench, behind_tpo ? on : output);
        }
        self->steps++;
    }
}

static void print_row(const struct subject *subject, long number,
                      const struct judge *judge, bool behind_tpo)
{
    struct fixpid_pid_config config = {.output_max = 1};
    struct design design = {.found = false};
    struct tuned tuned;
    double sensitivity = 0.0;

    run(&tuned, subject, behind_tpo);
    design.found = fixpid_autotune_result(&tuned.tuner, FIXPID_AUTOTUNE_PI,
                                          FIXPID_AUTOTUNE_SAFE, &config);
    if (design.found) {
        design.kp = config.gains.kp_q8 / 256.0;
        design.ki = config.gains.ki_q24 / 16777216.0;
        // of a loop that is unstable it has no end
        sensitivity = fmin(judge_sensitivity(judge, &design), 1e9);
    }
    (void)printf("%ld;%s;%s;%d;%ld;%d;%.5g\n", number,
                 family_name(subject->family), behind_tpo ? "tpo" : "direct",
                 (int)fixpid_autotune_status(&tuned.tuner), tuned.steps,
                 design.found ? 1 : 0, sensitivity);
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
