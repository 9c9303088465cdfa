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

static inline uint32_t wrong_10x7(uint16_t gain)
{
    uint32_t wrong = 0;

    for (uint8_t magnitude = 0; magnitude <= 127u; magnitude++) {
        wrong += (fixpid_10x7_div16(gain, magnitude) !=
                  quotient(gain, magnitude, 4, 0))
                     ? 1u
                     : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_10x7(void)
{
    uint32_t wrong = wrong_10x7(1023);

    for (uint16_t gain = 0; gain <= 1023u;
         gain = (uint16_t)(gain + TEST_STRIDE)) {
        wrong += wrong_10x7(gain);
    }
    return wrong;
}

static inline uint32_t wrong_10x8(uint16_t gain, uint8_t round_up,
                                  uint8_t limit)
{
    uint32_t wrong = 0;

    for (uint16_t magnitude = 0; magnitude <= FIXPID_AN964_TERM_LIMIT;
         magnitude++) {
        const uint16_t all = quotient(gain, magnitude, 5, round_up);
        const uint8_t expected = all > limit ? limit : (uint8_t)all;

        wrong += (fixpid_10x8_div32(gain, (uint8_t)magnitude, round_up,
                                    limit) != expected)
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
        for (uint16_t gain = 0; gain <= 1023u;
             gain = (uint16_t)(gain + TEST_STRIDE)) {
            wrong += wrong_10x8(gain, 0, limits[i]);
            wrong += wrong_10x8(gain, 0xFF, limits[i]);
        }
    }
    return wrong;
}

static inline uint32_t wrong_10x14(uint16_t magnitude)
{
    uint32_t wrong = 0;

    for (uint16_t gain = 0; gain <= 1023u; gain++) {
        wrong += (fixpid_10x14_div1024(gain, magnitude) !=
                  quotient(gain, magnitude, 10, 0))
                     ? 1u
                     : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_10x14(void)
{
    const uint16_t last = 16383;
    uint32_t wrong = wrong_10x14(last);

    for (uint16_t magnitude = 0; magnitude <= last;
         magnitude = (uint16_t)(magnitude + TEST_STRIDE)) {
        wrong += wrong_10x14(magnitude);
    }
    return wrong;
}

#endif
