// SPDX-License-Identifier: MIT
// What a Cortex-M brings to test/chips/target/qemu/runtime.c.
#include "semihosting.h"

extern uint32_t stack_top[];

void semihosting(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;

    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

// Of a program that has one: interrupted.c.
void systick_handler(void) __attribute__((weak));

// The stack pointer, reset, NMI, the hard fault, and the SysTick's place.
__attribute__((section(".vectors"), used)) static const uintptr_t vectors[] = {
    (uintptr_t)stack_top, (uintptr_t)reset_handler, (uintptr_t)fault_handler,
    (uintptr_t)fault_handler, [15] = (uintptr_t)systick_handler};
