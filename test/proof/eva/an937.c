// SPDX-License-Identifier: MIT
#include "eva.h"

#include "an937/fixpid_an937.c"
#include "an937/fixpid_an937_more.c"

static void call_any(struct fixpid_an937 *c)
{
    switch (ANY_OF(9)) {
    case 1:
        fixpid_an937_reset(c);
        break;
    case 2:
        (void)fixpid_an937_set_gains(c, ANY_UINT8, ANY_UINT8, ANY_UINT8);
        break;
    case 3:
        (void)fixpid_an937_set_accumulated_error_limit(c, ANY_UINT16);
        break;
    case 4:
        (void)fixpid_an937_set_derivative_period(c, ANY_UINT8);
        break;
    case 5:
        fixpid_an937_tick(c);
        break;
    case 6:
        (void)fixpid_an937_step(c, ANY_INT16);
        break;
    case 7:
        (void)fixpid_an937_step_percent(c, ANY_INT8);
        break;
    case 8:
        (void)fixpid_an937_proportional(c);
        (void)fixpid_an937_integral(c);
        (void)fixpid_an937_derivative(c);
        (void)fixpid_an937_accumulated_error(c);
        (void)fixpid_an937_stat1(c);
        (void)fixpid_an937_stat2(c);
        (void)fixpid_an937_flags(c);
        break;
    default:
        fixpid_an937_clear_flags(c);
        break;
    }
}

void eva(void)
{
    const struct fixpid_an937_config config = {
        .kp_q4 = ANY_UINT8,
        .ki_q4 = ANY_UINT8,
        .kd_q4 = ANY_UINT8,
        .accumulated_error_limit = ANY_UINT16,
        .derivative_period_ticks = ANY_UINT8,
    };
    struct fixpid_an937 c;

    (void)fixpid_an937_init(&c, &config);
    while (GOES_ON) {
        call_any(&c);
    }
}
