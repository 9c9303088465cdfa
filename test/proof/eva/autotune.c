// SPDX-License-Identifier: MIT
#include "eva.h"

#include "autotune/fixpid_autotune.c"
#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_more.c"

static void ask(struct fixpid_autotune *c)
{
    struct fixpid_autotune_process model;
    struct fixpid_pid_config pid;

    (void)fixpid_autotune_status(c);
    (void)fixpid_autotune_model(c, &model);
    (void)fixpid_autotune_result(c, ANY_UINT8, ANY_UINT8, &pid);
}

void eva(void)
{
    const struct fixpid_autotune_config config = {
        .output_min = ANY_INT16,
        .output_max = ANY_INT16,
        .output_rest = ANY_INT16,
        .measurement_min = ANY_INT16,
        .measurement_max = ANY_INT16,
        .swing = ANY_UINT16,
        .timeout_steps = ANY_UINT16,
        .cycles = ANY_UINT8,
        .options = ANY_UINT8,
    };
    struct fixpid_autotune c;

    (void)fixpid_autotune_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_autotune_reset(&c);
        }
        (void)fixpid_autotune_step(&c, ANY_INT16, ANY_INT16);
        ask(&c);
    }
}
