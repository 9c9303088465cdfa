// SPDX-License-Identifier: MIT
// Leaves what the parts left from 0x4000 on, where the debugger saves it,
// and waits: see ../msp430/main.c.
#include "program.h"

#define RESULTS ((uint8_t *)0x4000)
#define WDTCTL (*(volatile uint16_t *)0x120)
#define WATCHDOG_OFF 0x5A80u

extern uint8_t bss_begin[], bss_end[];

// The debugger stops here.
__attribute__((noinline, noreturn)) void wait(void)
{
    for (;;) {
        __asm__ volatile("nop");
    }
}

__attribute__((noreturn, used)) void begin(void)
{
    uint8_t *to = RESULTS;

    WDTCTL = WATCHDOG_OFF;
    for (uint8_t *byte = bss_begin; byte != bss_end; byte++) {
        *byte = 0;
    }
    for (uint8_t number = 0; number < PROGRAM_PARTS; number++) {
        program_do(number);
        for (uint8_t at = 0; at < PROGRAM_SIZE; at++) {
            *to++ = program_bytes[at];
        }
    }
    wait();
}

// From here the stack grows downwards.
__asm__(".section .start,\"ax\",@progbits\n"
        ".globl start\n"
        "start: mov #0x2f00, r1\n"
        "br #begin\n"
        ".text\n");
