// SPDX-License-Identifier: MIT
// An application with one controller, `oven`, beside a fixpid_config.h or
// without one.
#include <stdio.h>

#include "fixpid_pid.h"

FIXPID_DATA struct fixpid_pid oven;

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0, 0, 1, 0), .output_max = 255};

#ifdef FIXPID_PID_OBJECT
    printf("features 0x%02X, one object\n", FIXPID_PID_FEATURES);
#else
    printf("features 0x%02X\n", FIXPID_PID_FEATURES);
#endif
    if (!fixpid_pid_init(&oven, &config)) {
        return 1;
    }
    return (fixpid_pid_step(&oven, 10, 0) == 20) ? 0 : 2;
}
