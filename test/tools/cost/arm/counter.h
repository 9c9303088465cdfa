// SPDX-License-Identifier: MIT
// Instructions of a Cortex-M in QEMU: each takes the same virtual time there
// (-icount shift=10), and the SysTick timer reads it.
#ifndef COUNTER_H
#define COUNTER_H
#include <stdint.h>

#define TICKS_MASK 0xFFFFFFu
#define ROUTINE(name, text) ".thumb_func\n" name ":\n" text "    bx lr\n"

// As the call of the step: between the two readings lie a BL, the routine with
// its return, and one LDR.
#define METERED(name, routine)                                                 \
    __asm__(".syntax unified\n.text\n.thumb_func\n.global " name "\n" name     \
            ":\n"                                                              \
            "    push {r4, lr}\n"                                              \
            "    ldr r4, =0xE000E018\n"                                        \
            "    ldr r4, [r4]\n"                                               \
            "    bl " routine "\n"                                             \
            "    ldr r2, =0xE000E018\n"                                        \
            "    ldr r2, [r2]\n"                                               \
            "    subs r2, r4, r2\n"                                            \
            "    ldr r3, =metered_ticks\n"                                     \
            "    str r2, [r3]\n"                                               \
            "    pop {r4, pc}\n"                                               \
            "    .ltorg\n")

// The timer counts down from 2^24 - 1, as fast as the processor.
static void counter_begin(void)
{
    volatile uint32_t *const systick = (volatile uint32_t *)0xE000E010u;

    systick[1] = 0xFFFFFF; // reload
    systick[2] = 0;
    systick[0] = 5; // enabled, the processor's clock
}

#endif
