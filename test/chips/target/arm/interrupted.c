// SPDX-License-Identifier: MIT
// The SysTick of a Cortex-M, for a QEMU whose time is the instructions: with
// -icount shift=7 each takes 128 ns, and the boards' counters take no more for
// one count.
#include "../interrupted.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define ICSR (*(volatile uint32_t *)0xE000ED04u)
#define PENDSTCLR (UINT32_C(1) << 25)
#define ENABLED 7u // with an interrupt, from the processor's clock

void interrupt_after(uint16_t delay)
{
    SYST_RVR = delay;
    SYST_CVR = 0;
    SYST_CSR = ENABLED;
}

void interrupt_never(void)
{
    SYST_CSR = 0;
    ICSR = PENDSTCLR;
}

// The seventh word of what the core has pushed is the address to return to.
__attribute__((naked)) void systick_handler(void)
{
    __asm__("ldr r0, [sp, #24]\n\t"
            "push {r4, lr}\n\t"
            "bl interrupt_came\n\t"
            "pop {r4, pc}");
}
