// SPDX-License-Identifier: MIT
// The least application with this controller, for its size.
#include "bare.h"
#include "fixpid_pid.h"

FIXPID_DATA struct fixpid_pid FIXPID_PID_PLACE pid_controller;

void main(void)
{
    static const struct fixpid_pid_config config = {
        FIXPID_PID_GAINS(2, 0.5, 2, 10, 0), 0, 1023, 0, 1023, 256, 0};

    (void)fixpid_pid_init(&pid_controller, &config);
    for (;;) {
        bare_output = fixpid_pid_step(&pid_controller, 512, bare_input);
    }
}
