// SPDX-License-Identifier: MIT
#include "eva.h"

#include "fixpid.h"

void eva(void)
{
    while (GOES_ON) {
        (void)fixpid_sat16(ANY_INT32);
    }
}
