// SPDX-License-Identifier: MIT
// Random settings of fixpid_pid: legal ones, their ends often, and a few that
// are not.
#ifndef NUMBERS_PID_H
#define NUMBERS_PID_H
#include "fixpid_pid.h"

void numbers_pid_gains(struct fixpid_pid_gains *gains);
void numbers_pid_range(int16_t *low, int16_t *high);
void numbers_pid_config(struct fixpid_pid_config *config);

// The next inputs of a loop: the setpoint often stays, with the measurement
// near it.
void numbers_pid_inputs(int16_t *setpoint, int16_t *measurement);

#endif
