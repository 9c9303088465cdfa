// SPDX-License-Identifier: MIT
#include "arith.h"

#if defined(__SDCC)
#include "compiler.h"
#else
#define PORT_CLEAR_WATCHDOG()
#endif

uint16_t arith_row;
uint32_t arith_digest;

static uint32_t sum;

void arith_begin(void)
{
    sum = 0;
    arith_digest = 0;
}

// A sum of sums: it tells one order from another.
void arith_add(uint32_t result)
{
    PORT_CLEAR_WATCHDOG();
    sum += result;
    arith_digest += sum;
}
