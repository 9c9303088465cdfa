// SPDX-License-Identifier: MIT
#include "eva.h"

#include "autotune/fixpid_autotune.c"
#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_more.c"
#include "autotune/fixpid_autotune_record.c"
#include "autotune/fixpid_autotune_relay.c"
#include "autotune/fixpid_autotune_result.c"

static void ask(struct fixpid_autotune *c)
{
    struct fixpid_autotune_stage stage;
    struct fixpid_autotune_process process;
    struct fixpid_pid_config pid;

    (void)fixpid_autotune_status(c);
    fixpid_autotune_progress(c, &stage);
    (void)fixpid_autotune_model(c, &process);
    (void)fixpid_autotune_result(c, ANY_UINT8, ANY_UINT8, &pid);
    (void)fixpid_autotune_reason(c, ANY_UINT8, ANY_UINT8);
}

static void keep(struct fixpid_autotune *c)
{
    struct fixpid_autotune_record record;

    if (fixpid_autotune_pack(c, &record)) {
        record.bytes[ANY_OF(FIXPID_AUTOTUNE_RECORD_SIZE) - 1] = ANY_UINT8;
        (void)fixpid_autotune_unpack(c, &record);
    }
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
        .reverse = GOES_ON,
    };
    struct fixpid_autotune c;

    (void)fixpid_autotune_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_autotune_reset(&c);
        }
        (void)fixpid_autotune_step(&c, ANY_INT16, ANY_INT16);
        ask(&c);
        keep(&c);
    }
}
