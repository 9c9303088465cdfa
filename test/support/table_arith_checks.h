// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_table, in whatever form the includer chose, against
// 64 bits.
#ifndef TABLE_ARITH_CHECKS_H
#define TABLE_ARITH_CHECKS_H
#include <stdint.h>

#include "table/fixpid_table_arith.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes the most numbers
#endif

static const uint16_t table_nasty[] = {
    0,   1,    2,    3,     7,     10,    127,   128,   129,   254,
    255, 256,  257,  1000,  4095,  32766, 32767, 32768, 32769, 43691,
    511, 4097, 9999, 65279, 65280, 65281, 65533, 65534, 65535};
#define TABLE_NASTY (sizeof table_nasty / sizeof table_nasty[0])

static inline uint32_t rise_is_wrong(uint16_t rise, uint16_t part, uint16_t run)
{
    const uint64_t sum = (uint64_t)rise * part * 2u + run;

    return rise_at(rise, part, run) == sum / (2u * (uint64_t)run) ? 0u : 1u;
}

// Each nasty run, and parts and rises that are nasty, or any.
static inline uint32_t rise_all_wrong(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 1; i < TABLE_NASTY; i++) {
        const uint16_t run = table_nasty[i];

        for (unsigned j = 0; j < TABLE_NASTY; j++) {
            const uint16_t near = table_nasty[j] <= run ? table_nasty[j] : run;

            for (unsigned k = 0; k < TABLE_NASTY; k++) {
                wrong += rise_is_wrong(table_nasty[k], near, run);
            }
        }
        for (uint32_t rise = i; rise <= 65535u; rise += 7u * TEST_STRIDE) {
            wrong += rise_is_wrong((uint16_t)rise, run / 2u, run);
            wrong += rise_is_wrong((uint16_t)rise,
                                   (uint16_t)(rise * 40503u % run), run);
        }
    }
    return wrong;
}

#endif
