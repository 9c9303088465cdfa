// SPDX-License-Identifier: MIT
// Where fixpid_sat16 is, and what it costs who does not call it.
#include "fixpid.h"

extern uint8_t nothing_else;
uint8_t nothing_else;

#ifdef CALLED
int16_t limited(int32_t value);

int16_t limited(int32_t value)
{
    return fixpid_sat16(value);
}
#endif
