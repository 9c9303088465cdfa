// SPDX-License-Identifier: MIT
#include "eva.h"

#include "reaction/fixpid_reaction.c"
#include "reaction/fixpid_reaction_block.c"
#include "reaction/fixpid_reaction_more.c"
#include "reaction/fixpid_reaction_result.c"

static void ask(struct fixpid_reaction *c)
{
    struct fixpid_reaction_process process;
    struct fixpid_pid_gains gains;

    (void)fixpid_reaction_status(c);
    (void)fixpid_reaction_progress(c);
    (void)fixpid_reaction_model(c, &process);
    (void)fixpid_reaction_result(c, ANY_UINT8, ANY_UINT8, &gains);
}

void eva(void)
{
    const struct fixpid_reaction_config config = {
        .output_rest = ANY_INT16,
        .output_drive = ANY_INT16,
        .measurement_stop = ANY_INT16,
        .timeout_steps = ANY_UINT16,
        .reverse = GOES_ON,
    };
    struct fixpid_reaction c;

    (void)fixpid_reaction_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_reaction_reset(&c);
        }
        (void)fixpid_reaction_step(&c, ANY_INT16);
        ask(&c);
    }
}
