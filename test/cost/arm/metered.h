// SPDX-License-Identifier: MIT
// Instructions of a routine on a Cortex-M in QEMU: each takes the same virtual
// time there (-icount shift=10), and the SysTick timer reads it.
#ifndef METERED_H
#define METERED_H
#include <stdint.h>

#define RESOLUTION 64u // instructions between the two calibrating routines

volatile uint32_t metered_ticks;
extern uint32_t metered_sixty_four(void), metered_nothing(void);

// The timer counts down from 2^24 - 1, as fast as the processor.
static volatile uint32_t *const systick = (volatile uint32_t *)0xE000E010u;

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

METERED("metered_nothing", "nothing");
METERED("metered_sixty_four", "sixty_four");
__asm__(".text\n.thumb_func\nnothing: bx lr\n"
        ".thumb_func\nsixty_four: .rept 64\n nop\n .endr\n bx lr\n");

static uint32_t ticks_of_nothing, ticks_of_sixty_four;

static uint32_t ticks(void)
{
    return metered_ticks & 0xFFFFFFu;
}

static void calibrate(void)
{
    systick[1] = 0xFFFFFF; // reload
    systick[2] = 0;
    systick[0] = 5; // enabled, the processor's clock
    (void)metered_nothing();
    ticks_of_nothing = ticks();
    (void)metered_sixty_four();
    ticks_of_sixty_four = ticks() - ticks_of_nothing;
}

// Instructions of the step, its return included.
static uint32_t instructions(void)
{
    const int32_t beyond = (int32_t)(ticks() - ticks_of_nothing);
    const int32_t half = (int32_t)ticks_of_sixty_four / 2;

    return (uint32_t)((beyond * (int32_t)RESOLUTION + half) /
                      (int32_t)ticks_of_sixty_four) +
           1u;
}

#endif
