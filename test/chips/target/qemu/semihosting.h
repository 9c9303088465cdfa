// SPDX-License-Identifier: MIT
// What a core in QEMU brings, in its start.c: a call of semihosting, and the
// entrance that calls reset_handler with a stack.
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H
#include <stdint.h>

void semihosting(uint32_t operation, const void *argument);

void reset_handler(void);
void fault_handler(void);

#endif
