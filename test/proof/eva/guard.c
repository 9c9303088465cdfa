// SPDX-License-Identifier: MIT
#include "eva.h"

#include "guard/fixpid_guard.c"
#include "guard/fixpid_guard_more.c"

void eva(void)
{
    const struct fixpid_guard_config config = {
        .output_min = ANY_INT16,
        .output_max = ANY_INT16,
        .measurement_min = ANY_INT16,
        .measurement_max = ANY_INT16,
        .reach_min = ANY_INT16,
        .reach_max = ANY_INT16,
        .band = ANY_UINT16,
        .patience = ANY_UINT16,
        .reverse = GOES_ON,
        .noisy = GOES_ON,
    };
    const struct fixpid_guard_model model = {ANY_UINT32, ANY_UINT32, ANY_UINT16,
                                             ANY_UINT32, ANY_UINT16, ANY_UINT8};
    struct fixpid_guard_config found = config;
    struct fixpid_guard c;

    (void)fixpid_guard_from_model(&found, &model);
    (void)fixpid_guard_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_guard_reset(&c);
        }
        if (GOES_ON) {
            fixpid_guard_acknowledge(&c);
        }
        (void)fixpid_guard_step(&c, ANY_INT16, ANY_INT16, ANY_INT16);
        (void)fixpid_guard_flags(&c);
    }
}
