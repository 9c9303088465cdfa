// SPDX-License-Identifier: MIT
#include "eva.h"

#include "relay/fixpid_relay.c"

void eva(void)
{
    const struct fixpid_relay_config config = {
        .output_min = ANY_INT16,
        .output_max = ANY_INT16,
        .output_rest = ANY_INT16,
        .measurement_min = ANY_INT16,
        .measurement_max = ANY_INT16,
        .hysteresis = ANY_UINT16,
        .timeout_steps = ANY_UINT16,
        .cycles = ANY_UINT8,
    };
    struct fixpid_relay c;
    struct fixpid_pid_gains gains;

    (void)fixpid_relay_init(&c, &config);
    while (GOES_ON) {
        if (GOES_ON) {
            fixpid_relay_reset(&c);
        }
        (void)fixpid_relay_step(&c, ANY_INT16, ANY_INT16);
        (void)fixpid_relay_status(&c);
        (void)fixpid_relay_result(&c, ANY_UINT8, &gains);
    }
}
