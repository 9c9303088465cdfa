// SPDX-License-Identifier: MIT
// Compiled with FIXPID_AN964_TERM_LIMIT=255, so that the narrow form looks at
// every bit of an operand.
#include "an964/fixpid_an964_arith.h"
#include "arith.h"

#define STRIDE_10X14 251u

// Functions apart from the loops, and nothing constant: SDCC 4.2.0 takes a
// loop's variable for constant where a copy of it is made beside an instruction
// in assembly, and loses a quotient that is rounded by a constant.
static void add_10x7(uint16_t x, uint8_t k)
{
    ARITH_OPERANDS(x, k);
    arith_add(fixpid_10x7_div16(x, k));
}

static void add_10x8(uint16_t x, uint8_t k, uint8_t round_up, uint8_t limit)
{
    ARITH_OPERANDS(x, k);
    arith_add(fixpid_10x8_div32(x, k, round_up, limit));
}

static void add_10x14(uint16_t x, uint16_t k)
{
    ARITH_OPERANDS(k, x);
    arith_add(fixpid_10x14_div1024(k, x));
}

void an964_arith(void)
{
    uint8_t k = 0;
    uint16_t x;

    arith_begin();
    do {
        if (k < 128u) {
            add_10x7(arith_row, k);
        }
        add_10x8(arith_row, k, 0, 255);
        add_10x8(arith_row, k, 0xFF, (uint8_t)~k);
        add_10x8(arith_row, k, 0xFF, 255);
        k++;
    } while (k != 0u);
    for (x = arith_row & 127u; x < 16384u; x += STRIDE_10X14) {
        add_10x14(x, arith_row);
    }
    add_10x14(16383, arith_row);
}
