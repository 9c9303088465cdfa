// SPDX-License-Identifier: MIT
#include "numbers.h"

const int16_t nasty[NASTY_COUNT] = {
    0,     1,     -1,    2,      -2,        15,   -15,   16,   -16,
    30,    -30,   31,    -31,    119,       -119, 120,   -120, 121,
    -121,  127,   -127,  128,    -128,      255,  256,   -256, 1000,
    -1001, 1022,  -1022, 1023,   -1023,     1024, -1024, 4000, -4000,
    4001,  32766, 32767, -32767, INT16_MIN,
};

static uint32_t state = 1;

void numbers_seed(uint32_t seed)
{
    state = seed * UINT32_C(2654435761) + 1u;
}

uint32_t numbers_next(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

uint32_t numbers_below(uint32_t count)
{
    return numbers_next() % count;
}

int16_t numbers_int16(void)
{
    if ((numbers_next() & 1u) != 0u) {
        return nasty[numbers_below(NASTY_COUNT)];
    }
    return (int16_t)((int32_t)numbers_below(65536) - 32768);
}

void numbers_fill(void *object, size_t size)
{
    uint8_t *const bytes = object;

    for (size_t at = 0; at < size; at++) {
        bytes[at] = (uint8_t)(numbers_next() >> 24);
    }
}
