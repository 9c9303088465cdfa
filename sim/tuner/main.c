// SPDX-License-Identifier: MIT
// The page's numbers natively, to compare with: reads scenes from the standard
// input, each a verb (8 bytes: 0 runs, 1 experiments) with tuner_params and
// tuner_events, and writes for each its steps as 8 bytes, tuner_results after
// the run, or after the experiment and after each of its rules (8 bytes whether
// it has gains); of an experiment its record, too (8 bytes whether there is
// one), and the same after it was unpacked; and all series. `time` as an
// argument: it runs a scene that often and writes the shortest time in seconds.
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fixpid_autotune.h"
#include "tuner.h"

static void put(const void *from, size_t size, size_t count)
{
    if (fwrite(from, size, count, stdout) != count) {
        exit(EXIT_FAILURE);
    }
}

static int get(void *to, size_t size, size_t count)
{
    return fread(to, size, count, stdin) == count;
}

static void put_series(int n)
{
    for (int i = 0; (i < TUNER_COUNTS) && (n > 0); i++) {
        put(tuner_counts(i), sizeof(int32_t), (size_t)n);
    }
    for (int i = 0; (i < TUNER_VALUES) && (n > 0); i++) {
        put(tuner_values(i), sizeof(double), (size_t)n);
    }
}

static void put_rules(void)
{
    static const double robust[] = {FIXPID_AUTOTUNE_QUICK, FIXPID_AUTOTUNE_SAFE,
                                    FIXPID_AUTOTUNE_CALM};

    for (int rule = 0; rule <= FIXPID_AUTOTUNE_PID; rule++) {
        for (int word = 0; word < 3; word++) {
            tuner_params()[PARAM_ROBUSTNESS] = robust[word];
            const int64_t has = tuner_rule(rule);
            put(&has, sizeof(has), 1);
            put(tuner_results(), sizeof(double), TUNER_RESULTS);
        }
    }
}

static void put_record(void)
{
    const int64_t has = tuner_pack();

    put(&has, sizeof(has), 1);
    if (has == 0) {
        return;
    }
    put(tuner_record(), 1, FIXPID_AUTOTUNE_RECORD_SIZE);
    const int64_t good = tuner_unpack();
    put(&good, sizeof(good), 1);
    put(tuner_results(), sizeof(double), TUNER_RESULTS);
    put_rules();
}

static double seconds_of_run(void)
{
    struct timespec from;
    struct timespec to;
    (void)timespec_get(&from, TIME_UTC);
    (void)tuner_run();
    (void)timespec_get(&to, TIME_UTC);
    return (double)(to.tv_sec - from.tv_sec) +
           ((double)(to.tv_nsec - from.tv_nsec) / 1e9);
}

static void time_runs(int often)
{
    double least = 1e9;
    for (int i = 0; i < often; i++) {
        const double took = seconds_of_run();
        least = (took < least) ? took : least;
    }
    (void)printf("%.9f\n", least);
}

int main(int count, char **arguments)
{
    int64_t verb;
    while (
        get(&verb, sizeof(verb), 1) &&
        get(tuner_params(), sizeof(double), TUNER_PARAMS) &&
        get(tuner_events(), sizeof(double), TUNER_EVENTS * TUNER_EVENT_SIZE)) {
        if (count > 1) {
            time_runs(atoi(arguments[1]));
            continue;
        }
        const int n = (verb != 0) ? tuner_experiment() : tuner_run();
        const int64_t steps = n;
        put(&steps, sizeof(steps), 1);
        put(tuner_results(), sizeof(double), TUNER_RESULTS);
        if (verb != 0) {
            put_rules();
            put_record();
        }
        put_series(n);
    }
    return EXIT_SUCCESS;
}
