// SPDX-License-Identifier: MIT
// A product for an AVR that multiplies bytes: its compiler has the four of
// them.
#ifndef FIXPID_TABLE_WORDS_AVR_H
#define FIXPID_TABLE_WORDS_AVR_H
#include <stdint.h>

#include "fixpid.h"

FIXPID_INLINE uint32_t product(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

#endif
