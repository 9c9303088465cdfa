// SPDX-License-Identifier: MIT
#include "arith.h"

#if defined(__SDCC)
#include "compiler.h"
#else
#define PORT_CLEAR_WATCHDOG()
#endif

#ifdef arith_add
void (*arith_told)(void);
int32_t arith_operands[2];
const char *arith_text;

static void tell(void)
{
    if (arith_told != 0) {
        arith_told();
    }
}
#else
#define tell()
#endif

uint16_t arith_row;
uint32_t arith_digest;

static uint32_t sum;

void arith_begin(void)
{
    sum = 0;
    arith_digest = 0;
}

// A sum of sums, which tells one order from another. It turns, for what is
// wrong by the same each time would vanish from 256 sums.
void(arith_add)(uint32_t result)
{
    PORT_CLEAR_WATCHDOG();
    sum = ((sum << 1) | (sum >> 31)) + result;
    arith_digest += sum;
    tell();
}
