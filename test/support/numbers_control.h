// SPDX-License-Identifier: MIT
// What the random arguments of the modules are made of. Those of each module
// are a file of their own, because SDCC links whole object files.
#ifndef NUMBERS_CONTROL_H
#define NUMBERS_CONTROL_H
#include <stdbool.h>
#include <stdint.h>

// True once in `count` times.
bool numbers_one_in(uint32_t count);

// Any uint32_t, each number of bits as often as another.
uint32_t numbers_any_size(void);

// As far as `most` below or above, and wraps.
int16_t numbers_close_to(int16_t value, uint16_t most);

#endif
