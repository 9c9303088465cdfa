// SPDX-License-Identifier: MIT
// Gains in the order of an older struct: ki before kp.
#include "fixpid_pid.h"

const fixpid_pid_gains gains = {FIXPID_PID_KI(0.5, 1), FIXPID_PID_KP(2), 0, 0};
