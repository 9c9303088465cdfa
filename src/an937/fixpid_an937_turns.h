// SPDX-License-Identifier: MIT
// The products of fixpid_an937_arith.h for a RISC-V without a multiplier, by
// shift and add, which are faster than those of the compiler's library.
#ifndef FIXPID_AN937_TURNS_H
#define FIXPID_AN937_TURNS_H
#include <stdint.h>

#include "../common/fixpid_shift_add.h"
#include "fixpid_an937.h"

// sum + gain * number. pre: the result is within +-2^26
FIXPID_INLINE int32_t
fixpid_sum_with_term(int32_t sum, uint8_t gain,
                     FIXPID_DATA const union fixpid_an937_number *number)
{
    return fixpid_add32(sum, fixpid_product_in_turns(gain, number->value, 8));
}

// gain * error
FIXPID_INLINE int32_t fixpid_error_term(
    uint8_t gain, FIXPID_DATA const union fixpid_an937_number *error)
{
    return fixpid_product_in_turns(gain, error->value, 8);
}

// floor(x / 16). pre: x < 2^24
FIXPID_INLINE uint32_t fixpid_sixteenth(uint32_t x)
{
    return x >> 4;
}

#endif
