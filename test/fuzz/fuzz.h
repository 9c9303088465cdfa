// SPDX-License-Identifier: MIT
// What libFuzzer calls, and the numbers that an input becomes: those of
// test/support/numbers.h, each made of the input's next bytes.
#ifndef FUZZ_H
#define FUZZ_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// The numbers come from these bytes. When they are used up, pseudo-random ones
// follow, the same after each input.
void numbers_from(const uint8_t *data, size_t size);
bool numbers_are_left(void);

#endif
