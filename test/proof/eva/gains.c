// SPDX-License-Identifier: MIT
#include "eva.h"

#include "gains/fixpid_gains.c"

void eva(void)
{
    const struct fixpid_gains_milli milli = {ANY_UINT32, ANY_UINT32,
                                             ANY_UINT32};
    const struct fixpid_pid_gains gains = ANY_GAINS;
    struct fixpid_pid_gains gains_now;
    struct fixpid_gains_milli milli_now;

    (void)fixpid_gains_from_milli(&gains_now, &milli, ANY_UINT32, ANY_UINT8);
    (void)fixpid_gains_to_milli(&milli_now, &gains, ANY_UINT32);
}
