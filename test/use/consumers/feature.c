// SPDX-License-Identifier: MIT
// Compiled with -DUSE=... or -DGAINS=..., and FIXPID_PID_FEATURES with and
// without what it needs.
#include "fixpid_pid.h"

#ifndef USE
#define USE
#endif
#ifndef GAINS
#define GAINS                                                                  \
    {                                                                          \
        0, 0, 0, 0                                                             \
    }
#endif

extern struct fixpid_pid pid;
int16_t user(void);

int16_t user(void)
{
    const struct fixpid_pid_gains gains = GAINS;
    int16_t output = 0;

    USE;
    return (int16_t)(output + gains.kp_q8);
}
