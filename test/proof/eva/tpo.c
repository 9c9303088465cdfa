// SPDX-License-Identifier: MIT
#include "eva.h"

#include "tpo/fixpid_tpo.c"
#include "tpo/fixpid_tpo_check.c"

void eva(void)
{
    const struct fixpid_tpo_config config = {
        .full = ANY_INT16,
        .window = ANY_UINT16,
        .minimum_on = ANY_UINT16,
        .minimum_off = ANY_UINT16,
    };
    struct fixpid_tpo c;

    (void)fixpid_tpo_check(&config);
    (void)fixpid_tpo_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_tpo_reset(&c);
        }
        (void)fixpid_tpo_step(&c, ANY_INT16);
    }
}
