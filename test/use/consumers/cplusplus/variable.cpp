// SPDX-License-Identifier: MIT
// A gain that is no constant: VARIABLE is its definition, GAIN a macro of it.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"

unsigned long folded(float parameter);

unsigned long folded(float parameter)
{
    VARIABLE(void) parameter;
    return GAIN;
}
