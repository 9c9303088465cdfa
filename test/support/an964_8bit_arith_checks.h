// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit over their whole domains, in the form that
// its includer's macros chose. Each function returns how many results were
// wrong.
#ifndef AN964_8BIT_ARITH_CHECKS_H
#define AN964_8BIT_ARITH_CHECKS_H
#include <stdint.h>

#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "fixpid_an964_8bit.h"

static inline uint8_t at_most(unsigned value, unsigned limit)
{
    return (uint8_t)(value > limit ? limit : value);
}

static inline uint32_t wrong_div4(unsigned gain, unsigned limit)
{
    uint32_t wrong = 0;

    for (unsigned magnitude = 0; magnitude <= FIXPID_AN964_8BIT_TERM_LIMIT;
         magnitude++) {
        wrong += (fixpid_7x7_div4((uint8_t)gain, (uint8_t)magnitude, 0,
                                  (uint8_t)limit) !=
                  at_most(gain * magnitude / 4u, limit))
                     ? 1u
                     : 0u;
        wrong += (fixpid_7x7_div4((uint8_t)gain, (uint8_t)magnitude, 0xFF,
                                  (uint8_t)limit) !=
                  at_most((gain * magnitude + 3u) / 4u, limit))
                     ? 1u
                     : 0u;
    }
    return wrong;
}

static inline uint32_t all_wrong_div4(void)
{
    static const uint8_t limits[] = {
        FIXPID_AN964_8BIT_TERM_LIMIT, 0, 1, 30, 31, 126, 127};
    uint32_t wrong = 0;

    for (unsigned gain = 0; gain <= 127u; gain++) {
        for (unsigned i = 0; i < sizeof limits; i++) {
            wrong += wrong_div4(gain, limits[i]);
        }
    }
    return wrong;
}

static inline uint32_t all_wrong_div8(void)
{
    uint32_t wrong = 0;

    for (unsigned gain = 0; gain <= 127u; gain++) {
        for (unsigned magnitude = 0; magnitude <= 127u; magnitude++) {
            wrong += (fixpid_7x7_div8((uint8_t)gain, (uint8_t)magnitude) !=
                      at_most(gain * magnitude / 8u, 127))
                         ? 1u
                         : 0u;
        }
    }
    return wrong;
}

static inline uint32_t all_wrong_div32(void)
{
    uint32_t wrong = 0;

    for (unsigned gain = 0; gain <= 127u; gain++) {
        for (unsigned magnitude = 0; magnitude <= 127u; magnitude++) {
            wrong += (fixpid_7x7_div32((uint8_t)gain, (uint8_t)magnitude) !=
                      gain * magnitude / 32u)
                         ? 1u
                         : 0u;
        }
    }
    return wrong;
}

#endif
