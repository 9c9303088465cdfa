// SPDX-License-Identifier: MIT
#include "eva.h"

#include "slew/fixpid_slew.c"

void eva(void)
{
    struct fixpid_slew c;

    fixpid_slew_init(&c, ANY_UINT32, ANY_UINT32);
    while (GOES_ON) {
        switch (ANY_OF(4)) {
        case 1:
            fixpid_slew_set_rates(&c, ANY_UINT32, ANY_UINT32);
            break;
        case 2:
            fixpid_slew_seed(&c, ANY_INT16);
            break;
        case 3:
            fixpid_slew_reset(&c);
            break;
        default:
            (void)fixpid_slew_step(&c, ANY_INT16);
            (void)fixpid_slew_value(&c);
            break;
        }
    }
}
