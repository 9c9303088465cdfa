// SPDX-License-Identifier: MIT
#include "calls_pid.h"

void pid_change(FIXPID_DATA struct fixpid_pid *self,
                const struct fixpid_pid_gains *gains)
{
    (void)fixpid_pid_set_gains(self, gains);
    fixpid_pid_seed(self, fixpid_pid_output(self));
}
