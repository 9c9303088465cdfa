// SPDX-License-Identifier: MIT
// The products of fixpid_an964 over their whole domains, in the form that its
// includer's macros chose. Each function returns how many results were wrong.
#ifndef AN964_ARITH_CHECKS_H
#define AN964_ARITH_CHECKS_H
#include <stdint.h>

#include "an964/fixpid_an964_arith.h"
#include "fixpid_an964.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 walks a whole domain
#endif

// x * k / 2^n in 64 bits, rounded up if that is asked.
static inline uint16_t quotient(uint64_t x, uint64_t k, unsigned n,
                                uint8_t round_up)
{
    const uint64_t rest = (UINT64_C(1) << n) - 1u;

    return (uint16_t)((x * k + (round_up != 0u ? rest : 0u)) >> n);
}

static inline uint32_t wrong_10x7(uint16_t x)
{
    uint32_t wrong = 0;

    for (uint8_t k = 0; k <= 127u; k++) {
        wrong += (fixpid_10x7_div16(k, x) != quotient(x, k, 4, 0)) ? 1u : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_10x7(void)
{
    uint32_t wrong = wrong_10x7(1023);

    for (uint16_t x = 0; x <= 1023u; x = (uint16_t)(x + TEST_STRIDE)) {
        wrong += wrong_10x7(x);
    }
    return wrong;
}

static inline uint32_t wrong_10x8(uint16_t x, uint8_t round_up, uint8_t limit)
{
    uint32_t wrong = 0;

    for (uint16_t k = 0; k <= FIXPID_AN964_TERM_LIMIT; k++) {
        const uint16_t all = quotient(x, k, 5, round_up);
        const uint8_t expected = all > limit ? limit : (uint8_t)all;

        wrong += (fixpid_10x8_div32((uint8_t)k, x, round_up, limit) != expected)
                     ? 1u
                     : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_10x8(void)
{
    static const uint8_t limits[] = {
        FIXPID_AN964_TERM_LIMIT, 0, 1, 31, 127, 128, 254, 255};
    uint32_t wrong = 0;

    for (unsigned i = 0; i < sizeof limits; i++) {
        wrong += wrong_10x8(1023, 0, limits[i]);
        wrong += wrong_10x8(1023, 0xFF, limits[i]);
        for (uint16_t x = 0; x <= 1023u; x = (uint16_t)(x + TEST_STRIDE)) {
            wrong += wrong_10x8(x, 0, limits[i]);
            wrong += wrong_10x8(x, 0xFF, limits[i]);
        }
    }
    return wrong;
}

static inline uint32_t wrong_14x10(uint16_t x)
{
    uint32_t wrong = 0;

    for (uint16_t k = 0; k <= 1023u; k++) {
        wrong +=
            (fixpid_14x10_div1024(x, k) != quotient(x, k, 10, 0)) ? 1u : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_14x10(void)
{
    const uint16_t last = 16383;
    uint32_t wrong = wrong_14x10(last);

    for (uint16_t x = 0; x <= last; x = (uint16_t)(x + TEST_STRIDE)) {
        wrong += wrong_14x10(x);
    }
    return wrong;
}

#endif
