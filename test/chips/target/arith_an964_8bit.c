// SPDX-License-Identifier: MIT
// Compiled with FIXPID_AN964_8BIT_TERM_LIMIT=127, so that the narrow form looks
// at every bit of an operand.
#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "arith.h"

static volatile uint8_t carried;

// Two bytes above 127: their sum leaves a carry where a chip has one, and
// assembly that takes it for 0 begins with another answer.
static void leave_carry(uint8_t x, uint8_t k)
{
    const uint8_t left = (uint8_t)(x | 0x80u);
    const uint8_t right = (uint8_t)(k | 0x80u);

    carried = (uint8_t)(left + right);
}

// Apart from the loop: see arith_an964.c.
static void add_7x7(uint8_t x, uint8_t k)
{
    uint16_t quotient;

    ARITH_OPERANDS(x, k);
    arith_add(fixpid_7x7_div4(x, k, 0, 127));
    arith_add(fixpid_7x7_div4(x, k, 0xFF, (uint8_t)(127u - k)));
    leave_carry(x, k);
    arith_add(fixpid_7x7_div8(x, k));
    leave_carry(x, k);
    quotient = fixpid_7x7_div32(x, k);
    carried = 0; // a compiler stores the register that it keeps at 0
    arith_add((uint32_t)quotient + carried);
}

void an964_8bit_arith(void)
{
    uint8_t k;

    arith_begin();
    for (k = 0; k < 128u; k++) {
        add_7x7((uint8_t)arith_row, k);
    }
}
