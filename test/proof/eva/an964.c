// SPDX-License-Identifier: MIT
#include "eva.h"

#include "an964/fixpid_an964.c"
#include "an964/fixpid_an964_more.c"

static void call_any(struct fixpid_an964 *c)
{
    switch (ANY_OF(4)) {
    case 1:
        fixpid_an964_reset(c);
        break;
    case 2:
        (void)fixpid_an964_set_gains(c, ANY_UINT16, ANY_UINT16, ANY_UINT16);
        break;
    case 3:
        (void)fixpid_an964_step(c, ANY_INT16);
        break;
    default:
        (void)fixpid_an964_proportional(c);
        (void)fixpid_an964_integral(c);
        (void)fixpid_an964_derivative(c);
        (void)fixpid_an964_flags(c);
        break;
    }
}

void eva(void)
{
    const struct fixpid_an964_gains gains = {ANY_UINT16, ANY_UINT16,
                                             ANY_UINT16};
    struct fixpid_an964 c;

    (void)fixpid_an964_init(&c, &gains);
    while (GOES_ON) {
        call_any(&c);
    }
}
