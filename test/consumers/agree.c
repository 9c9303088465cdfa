// SPDX-License-Identifier: MIT
// Whether getters and setters that were compiled in another mode than the step
// reach the program's one controller.
#include "fixpid_pid.h"

FIXPID_DATA struct fixpid_pid one;

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0, 0, 1, 0), .output_max = 255};

    if (!fixpid_pid_init(&one, &config)) {
        return 1;
    }
    if (!fixpid_pid_set_limits(&one, -10, 10)) {
        return 2;
    }
    if (fixpid_pid_step(&one, 100, 0) != 10) {
        return 3;
    }
    return (fixpid_pid_flags(&one) == FIXPID_PID_AT_MAX) ? 0 : 4;
}
