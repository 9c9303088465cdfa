// SPDX-License-Identifier: MIT
// Answers as many questions as the simulator has put into memory, and meters
// their steps with a timer.
#include "asked.h"

#define QUESTIONS ((const uint8_t *)0x8000)
#define ANSWERS ((uint8_t *)0x4000)
#define COSTS ((volatile uint16_t *)0x3000) // of each step; 0: not metered
#define COUNT (*(volatile uint16_t *)0x2FF0)

#define WDTCTL (*(volatile uint16_t *)0x120)
#define WATCHDOG_OFF 0x5A80u
#define TACTL (*(volatile uint16_t *)0x160)
#define TAR (*(volatile uint16_t *)0x170)
#define TIMER_COUNTS_CYCLES 0x0220u

extern uint8_t bss_begin[], bss_end[];
static volatile uint16_t cost;

STEP_RESULT metered_step(STEP_PARAMETERS)
{
    const uint16_t began = TAR;
    const STEP_RESULT result = STEP(STEP_ARGUMENTS);

    cost = TAR - began;
    return result;
}

// The debugger stops here, and goes on at `answer` with new questions: to load
// them resets the processor, but not its memory.
__attribute__((noinline, noreturn)) void wait(void)
{
    for (;;) {
        __asm__ volatile("nop");
    }
}

__attribute__((noreturn, used)) void begin(void)
{
    WDTCTL = WATCHDOG_OFF;
    for (uint8_t *byte = bss_begin; byte != bss_end; byte++) {
        *byte = 0;
    }
    wait();
}

__attribute__((noreturn, used)) void answer_all(void)
{
    const uint8_t *from = QUESTIONS;
    uint8_t *to = ANSWERS;
    uint8_t *const exchange = (uint8_t *)&EXCHANGE;

    WDTCTL = WATCHDOG_OFF;
    TACTL = TIMER_COUNTS_CYCLES;
    for (uint16_t number = 0; number < COUNT; number++) {
        for (uint16_t at = 0; at < QUESTION_SIZE; at++) {
            exchange[at] = *from++;
        }
        cost = 0;
        REPLY();
        COSTS[number] = cost;
        for (uint16_t at = 0; at < ANSWER_SIZE; at++) {
            *to++ = exchange[at];
        }
    }
    wait();
}

__asm__(".section .start,\"ax\",@progbits\n"
        ".globl start, answer\n"
        "start: mov #0x2f00, r1\n"
        "br #begin\n"
        "answer: mov #0x2f00, r1\n"
        "br #answer_all\n"
        ".text\n");
