// SPDX-License-Identifier: MIT
// The functions of src/ that are assembly for an ARM, each in a function whose
// operands and result are where gcc passes them: claims.txt has claims
// about the compiled ones.
#include <stdint.h>

#include "common/fixpid_signed.h"

int32_t sum(int32_t a, int32_t b)
{
    return add32_sat(a, b);
}

// Both operands are in one register.
int32_t twice(int32_t a)
{
    return add32_sat(a, a);
}

#if defined(FIXPID_HAS_SSAT)
int32_t difference(int32_t a, int32_t b)
{
    return sub16_sat(a, b);
}
#endif
