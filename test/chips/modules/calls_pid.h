// SPDX-License-Identifier: MIT
// New gains without a bump, as docs/recipes.md has it: what an interrupt is
// masked for.
#ifndef CALLS_PID_H
#define CALLS_PID_H
#include "fixpid_pid.h"

void pid_change(FIXPID_DATA struct fixpid_pid *self,
                const struct fixpid_pid_gains *gains);

#endif
