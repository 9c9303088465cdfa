// SPDX-License-Identifier: MIT
#include "fuzz.h"
#include "numbers.h"

// The pseudo-random ones, under other names, and the table of nasty ones.
#define numbers_seed random_seed
#define numbers_next random_next
#define numbers_below random_below
#define numbers_int16 random_int16
#define numbers_fill random_fill
#include "numbers.c"
#undef numbers_seed
#undef numbers_next
#undef numbers_below
#undef numbers_int16
#undef numbers_fill

static const uint8_t *next_byte;
static size_t left;

void numbers_from(const uint8_t *data, size_t size)
{
    next_byte = data;
    left = size;
    random_seed(1);
}

bool numbers_are_left(void)
{
    return left != 0;
}

static uint32_t number_of(uint8_t bytes)
{
    uint32_t number = 0;

    if (left < bytes) {
        left = 0;
        return random_next();
    }
    left -= bytes;
    for (; bytes != 0; bytes--) {
        number = (number << 8) | *next_byte;
        next_byte++;
    }
    return number;
}

// A program's own seed is of no account here.
void numbers_seed(uint32_t seed)
{
    (void)seed;
}

uint32_t numbers_next(void)
{
    return number_of(4);
}

uint32_t numbers_below(uint32_t count)
{
    if (count <= 1u) {
        return 0;
    }
    if (count <= 256u) {
        return number_of(1) % count;
    }
    return number_of(count <= 65536u ? 2 : 4) % count;
}

int16_t numbers_int16(void)
{
    const uint32_t kind = numbers_below(64);

    return kind < NASTY_COUNT ? nasty[kind] : (int16_t)number_of(2);
}

void numbers_fill(void *object, size_t size)
{
    uint8_t *const bytes = object;

    for (size_t at = 0; at < size; at++) {
        bytes[at] = (uint8_t)number_of(1);
    }
}
