// SPDX-License-Identifier: MIT
// An interrupt of this machine that comes once: arm/interrupted.c for a
// Cortex-M, avr/interrupted.c for an AVR.
#ifndef INTERRUPTED_H
#define INTERRUPTED_H
#include <stdint.h>

// The longer the delay, the later it comes; two delays that differ by one are
// never more than one instruction apart.
void interrupt_after(uint16_t delay);

// It does not come any more.
void interrupt_never(void);

// What it calls, with the address of the instruction that it came before.
void interrupt_came(uintptr_t before);

#endif
