// SPDX-License-Identifier: MIT
// Operands for tests: the nasty ones in a table, the others pseudo-random.
#ifndef NUMBERS_H
#define NUMBERS_H
#include <stddef.h>
#include <stdint.h>

// Around 0, around every limit of the controllers and at the ends of the type.
#define NASTY_COUNT 41
extern const int16_t nasty[NASTY_COUNT];

// A fixed sequence that starts again at numbers_seed.
void numbers_seed(uint32_t seed);
uint32_t numbers_next(void);

// 0..count-1
uint32_t numbers_below(uint32_t count);

// Any int16_t; every other one is a nasty one.
int16_t numbers_int16(void);

// Any bytes, as a memory may hold, and how many such memories a test tries.
#ifndef TEST_MEMORIES
#define TEST_MEMORIES 20000u
#endif
void numbers_fill(void *object, size_t size);

#endif
