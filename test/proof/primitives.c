// SPDX-License-Identifier: MIT
// The primitives of src/ against the true product, quotient or difference, for
// all operands that they allow: what a solver is slow at and a processor is
// not. A program for the host: it says how many cases it tried, or which was
// wrong.
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef PRIMITIVES_INT_16 // compiled as C++
#include "int16.hh"
namespace int16
{
#endif

#include "an937/fixpid_an937_arith.h"
#include "an964/fixpid_an964_arith.h"
#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "common/fixpid_signed.h"

#ifdef PRIMITIVES_INT_16
} // namespace int16
using int16::add32_sat;
using int16::fixpid_10x14_div1024;
using int16::fixpid_10x7_div16;
using int16::fixpid_10x8_div32;
using int16::fixpid_7x7_div32;
using int16::fixpid_7x7_div4;
using int16::fixpid_7x7_div8;
using int16::fixpid_an937_number;
using int16::fixpid_number_term;
using int16::fixpid_sum_with_term;
using int16::mul16;
using int16::sub16_sat;
#endif

static uint64_t cases;

static void same(const char *leaf, int64_t a, int64_t b, int64_t got,
                 int64_t want)
{
    cases++;
    if (got != want) {
        printf("%s(%" PRId64 ", %" PRId64 ") is %" PRId64 ", not %" PRId64 "\n",
               leaf, a, b, got, want);
        exit(1);
    }
}

static uint32_t at_most(uint32_t limit, uint32_t x)
{
    return (x > limit) ? limit : x;
}

// x * k / 2^n, rounded down and up. The quotient's limit is the magnitude's,
// too.
static void bytes_times_bytes(void)
{
    const uint32_t most = FIXPID_AN964_8BIT_TERM_LIMIT;

    for (uint32_t x = 0; x < 128u; x++) {
        for (uint32_t k = 0; k < 128u; k++) {
            for (uint32_t limit = k; limit <= most; limit++) {
                same("7x7_div4", x, k,
                     fixpid_7x7_div4((uint8_t)x, (uint8_t)k, 0, (uint8_t)limit),
                     at_most(limit, x * k / 4u));
                same("7x7_div4 up", x, k,
                     fixpid_7x7_div4((uint8_t)x, (uint8_t)k, 0xFF,
                                     (uint8_t)limit),
                     at_most(limit, (x * k + 3u) / 4u));
            }
            same("7x7_div8", x, k, fixpid_7x7_div8((uint8_t)x, (uint8_t)k),
                 at_most(127, x * k / 8u));
            same("7x7_div32", x, k, fixpid_7x7_div32((uint8_t)x, (uint8_t)k),
                 x * k / 32u);
        }
    }
}

static void bytes_times_words(void)
{
    const uint32_t most = FIXPID_AN964_TERM_LIMIT;

    for (uint32_t x = 0; x < 1024u; x++) {
        for (uint32_t k = 0; k <= most; k++) {
            for (uint32_t limit = k; limit <= most; limit++) {
                same("10x8_div32", x, k,
                     fixpid_10x8_div32((uint16_t)x, (uint8_t)k, 0,
                                       (uint8_t)limit),
                     at_most(limit, x * k / 32u));
                same("10x8_div32 up", x, k,
                     fixpid_10x8_div32((uint16_t)x, (uint8_t)k, 0xFF,
                                       (uint8_t)limit),
                     at_most(limit, (x * k + 31u) / 32u));
            }
        }
        for (uint32_t k = 0; k < 128u; k++) {
            same("10x7_div16", x, k, fixpid_10x7_div16((uint16_t)x, (uint8_t)k),
                 x * k / 16u);
        }
    }
    for (uint32_t x = 0; x < 16384u; x++) {
        for (uint32_t k = 0; k < 1024u; k++) {
            same("10x14_div1024", k, x,
                 fixpid_10x14_div1024((uint16_t)k, (uint16_t)x), x * k / 1024u);
        }
    }
}

static union fixpid_an937_number number_of(int32_t x)
{
    union fixpid_an937_number number = {0};

#ifdef FIXPID_AN937_NARROW_H
    number.parts.magnitude = (uint16_t)((x < 0) ? -x : x);
    number.parts.negative = (x < 0) ? 1u : 0u;
#else
    number.value = x;
#endif
    return number;
}

// A term by itself, and as a step adds it to the least and the largest sum of
// two.
static void terms(void)
{
    const int32_t most = 2 * 255 * 65535;

    for (int32_t x = -65535; x <= 65535; x++) {
        const union fixpid_an937_number number = number_of(x);

        for (int32_t gain = 0; gain < 256; gain++) {
            same("number_term", gain, x,
                 fixpid_number_term((uint8_t)gain, &number), gain * x);
            same("sum_with_term", gain, x,
                 fixpid_sum_with_term(most, (uint8_t)gain, &number),
                 most + gain * x);
            same("sum_with_term", gain, x,
                 fixpid_sum_with_term(-most, (uint8_t)gain, &number),
                 gain * x - most);
        }
    }
}

static void products(void)
{
    for (int32_t gain = 0; gain < 32768; gain++) {
        for (int32_t x = -32768; x < 32768; x++) {
            same("mul16", gain, x, mul16((uint16_t)gain, (int16_t)x), gain * x);
        }
    }
}

static void differences(void)
{
    for (int32_t a = -32768; a < 32768; a++) {
        for (int32_t b = -32768; b < 32768; b++) {
            const int32_t apart = a - b;

            same("sub16_sat", a, b, sub16_sat((int16_t)a, (int16_t)b),
                 (apart > 32767)    ? 32767
                 : (apart < -32768) ? -32768
                                    : apart);
        }
    }
}

// Sums around 0 and around both ends, with and without an overflow.
static void sums(void)
{
    const int64_t least = -2147483647 - 1;
    const int64_t most = 2147483647;
    const int64_t middles[] = {least, -65536, 0, 65536, most};

    for (unsigned i = 0; i < 25u; i++) {
        for (int64_t a = -300; a <= 300; a++) {
            for (int64_t b = -300; b <= 300; b++) {
                const int64_t left = middles[i % 5u] + a;
                const int64_t right = middles[i / 5u] + b;
                const int64_t sum = left + right;

                if ((left < least) || (left > most) || (right < least) ||
                    (right > most)) {
                    continue;
                }
                same("add32_sat", left, right,
                     add32_sat((int32_t)left, (int32_t)right),
                     (sum > most)    ? most
                     : (sum < least) ? least
                                     : sum);
            }
        }
    }
}

int main(void)
{
    bytes_times_bytes();
    bytes_times_words();
    terms();
    products();
    differences();
    sums();
    printf("%" PRIu64 " cases\n", cases);
    return 0;
}
