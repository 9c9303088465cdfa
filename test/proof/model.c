// SPDX-License-Identifier: MIT
// The machine that is proved for is the one that the name of a proof says.
#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

#include "prove.h"

#define INT_BITS ((PROOF_WORD == 16) ? 16 : 32)
#define LONG_BITS ((PROOF_WORD == 64) ? 64 : 32)

void prove_model(void)
{
    const uint8_t byte = nondet_uint8();

    claim(sizeof(int) * CHAR_BIT == INT_BITS);
    claim(sizeof(long) * CHAR_BIT == LONG_BITS);
    claim((uint64_t)INT_MAX + 1u == (uint64_t)1 << (INT_BITS - 1));
    claim(sizeof(int8_t) == 1u);
    claim(sizeof(int16_t) == 2u);
    claim(sizeof(int32_t) == 4u);
    claim(sizeof(int64_t) == 8u);
    claim(sizeof(byte + byte) == sizeof(int));
    claim(sizeof(UINT32_C(1)) == 4u);
    claim(sizeof(INT32_C(1)) == 4u);
}
