// SPDX-License-Identifier: MIT
// Compiled with FIXPID_AN964_8BIT_TERM_LIMIT=127, so that the narrow form looks
// at every bit of an operand.
#include "arith.h"
#include "fixpid_an964_8bit_arith.h"

// Apart from the loop: see arith_an964.c.
static void add_7x7(uint8_t x, uint8_t k)
{
    arith_add(fixpid_7x7_div4(x, k, 0, 127));
    arith_add(fixpid_7x7_div4(x, k, 0xFF, (uint8_t)(127u - k)));
    arith_add(fixpid_7x7_div8(x, k));
    arith_add(fixpid_7x7_div32(x, k));
}

void an964_8bit_arith(void)
{
    uint8_t k;

    arith_begin();
    for (k = 0; k < 128u; k++) {
        add_7x7((uint8_t)arith_row, k);
    }
}
