// SPDX-License-Identifier: MIT
// fixpid_sat16, which fixpid.h has for applications.
#include "prove.h"

#include "fixpid.h"

void prove_value(void)
{
    const int32_t value = nondet_int32();

    claim(fixpid_sat16(value) == clamp(value, INT16_MIN, INT16_MAX));
}
