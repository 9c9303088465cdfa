// SPDX-License-Identifier: MIT
// The step between two marks: ucsim writes down when the byte changes.
#include "asked.h"

#if defined(__SDCC_mcs51)
volatile __data uint8_t mark;
#else
volatile uint8_t mark;
#endif

STEP_RESULT metered_step(STEP_PARAMETERS)
{
    STEP_RESULT result;

    mark = 1;
    result = STEP(STEP_ARGUMENTS);
    mark = 2;
    return result;
}
