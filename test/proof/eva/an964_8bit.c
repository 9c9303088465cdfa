// SPDX-License-Identifier: MIT
#include "eva.h"

#include "an964_8bit/fixpid_an964_8bit.c"
#include "an964_8bit/fixpid_an964_8bit_more.c"

static void call_any(struct fixpid_an964_8bit *c)
{
    switch (ANY_OF(4)) {
    case 1:
        fixpid_an964_8bit_reset(c);
        break;
    case 2:
        (void)fixpid_an964_8bit_set_gains(c, ANY_UINT8, ANY_UINT8, ANY_UINT8);
        break;
    case 3:
        (void)fixpid_an964_8bit_step(c, ANY_INT8);
        break;
    default:
        (void)fixpid_an964_8bit_proportional(c);
        (void)fixpid_an964_8bit_integral(c);
        (void)fixpid_an964_8bit_derivative(c);
        (void)fixpid_an964_8bit_flags(c);
        break;
    }
}

void eva(void)
{
    const struct fixpid_an964_8bit_gains gains = {ANY_UINT8, ANY_UINT8,
                                                  ANY_UINT8};
    struct fixpid_an964_8bit c;

    (void)fixpid_an964_8bit_init(&c, &gains);
    while (GOES_ON) {
        call_any(&c);
    }
}
