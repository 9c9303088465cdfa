// SPDX-License-Identifier: MIT
// Gains of a controller as fixpid_pid has it, per step.
#ifndef DESIGN_H
#define DESIGN_H
#include <stdbool.h>

struct design {
    bool found;
    double kp;
    double ki;
    double kd;
    int filter; // of the derivative, as in fixpid_pid; 0: none
};

#endif
