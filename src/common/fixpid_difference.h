// SPDX-License-Identifier: MIT
// The difference of two counts, which needs 17 bits with a sign. In a file of
// its own because SDCC keeps a copy in each object file of a PIC18 that has it.
#ifndef FIXPID_DIFFERENCE_H
#define FIXPID_DIFFERENCE_H
#include <stdint.h>

#include "fixpid.h"

// high - low, which is 0..65535. pre: low <= high
FIXPID_INLINE uint16_t fixpid_difference(int16_t high, int16_t low)
{
    return (uint16_t)((uint16_t)high - (uint16_t)low);
}

#endif
