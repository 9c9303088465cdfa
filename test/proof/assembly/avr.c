// SPDX-License-Identifier: MIT
// The functions of src/ that are assembly for an AVR, each in a function whose
// operands and result are where gcc passes them: claims.txt has claims
// about the compiled ones.
#include <stdbool.h>
#include <stdint.h>

#include "an937/fixpid_an937_arith.h"
#include "an964/fixpid_an964_arith.h"
#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "common/fixpid_signed.h"

int16_t difference(int16_t a, int16_t b)
{
    return sub16_sat(a, b);
}

int32_t sum(int32_t a, int32_t b)
{
    return add32_sat(a, b);
}

// The counts are not where the result is.
int32_t whole(int16_t before, int16_t counts)
{
    (void)before;
    return whole_counts(counts);
}

int32_t rounded(int32_t sum, int32_t integral)
{
    return rounded_counts(sum, integral);
}

int32_t product(uint16_t gain, int16_t x)
{
    return mul16(gain, x);
}

int32_t sum_with_term(int32_t sum, uint8_t gain, int32_t value)
{
    union fixpid_an937_number number;

    number.value = value;
    return fixpid_sum_with_term(sum, gain, &number);
}

int32_t term(uint8_t gain, int32_t value)
{
    union fixpid_an937_number number;

    number.value = value;
    return fixpid_number_term(gain, &number);
}

uint32_t sixteenth(uint32_t x)
{
    return fixpid_sixteenth(x);
}

#if defined(__AVR_HAVE_MUL__)
int32_t sum_with_product(int32_t a, uint8_t fraction, uint16_t gain, int16_t x,
                         bool fine)
{
    return add_product(a, fraction, gain, x, fine);
}

uint16_t quotient_10x7(uint16_t gain, uint8_t magnitude)
{
    return fixpid_10x7_div16(gain, magnitude);
}

uint16_t quotient_10x8(uint16_t gain, uint8_t magnitude, uint8_t round_up,
                       uint8_t limit)
{
    return fixpid_10x8_div32(gain, magnitude, round_up, limit);
}

uint16_t quotient_10x14(uint16_t gain, uint16_t magnitude)
{
    return fixpid_10x14_div1024(gain, magnitude);
}

uint16_t quarter_7x7(uint8_t gain, uint8_t magnitude, uint8_t round_up,
                     uint8_t limit)
{
    return fixpid_7x7_div4(gain, magnitude, round_up, limit);
}

uint16_t eighth_7x7(uint8_t gain, uint8_t magnitude)
{
    return fixpid_7x7_div8(gain, magnitude);
}

uint16_t quotient_7x7(uint8_t gain, uint8_t magnitude)
{
    return fixpid_7x7_div32(gain, magnitude);
}
#endif
