// SPDX-License-Identifier: MIT
// What the routines of a program in assembly take on a core in QEMU. Build with
// -DROUTINES="EACH(plain) EACH(product)". Prints a line for each:
//
//   plain instructions 5 stack 0
#include "metered.h"
#include "put.h"

#define PAINTED 2048u // bytes below the stack pointer
#define PAINT 0xA5u

typedef uint32_t (*routine)(uint32_t *words);

#define EACH(name)                                                             \
    uint32_t metered_##name(uint32_t *words);                                  \
    METERED("metered_" #name, #name);
ROUTINES
#undef EACH

static uint32_t words[16];

// Bytes that a call has written below the stack pointer.
static __attribute__((noinline)) uint32_t stack_of(routine metered)
{
    register uintptr_t stack_pointer __asm__("sp");
    volatile uint8_t *const top = (volatile uint8_t *)stack_pointer;
    uint32_t depth = PAINTED;

    for (uint32_t at = 1; at <= PAINTED; at++) {
        *(top - at) = PAINT;
    }
    (void)metered(words);
    while (depth > 0u && *(top - depth) == PAINT) {
        depth--;
    }
    return depth;
}

// A routine that is known to take so many bytes.
#ifdef __riscv
#define KNOWN_BYTES 16u
__asm__(ROUTINE("known", "    addi sp, sp, -16\n    sw t0, 0(sp)\n"
                         "    addi sp, sp, 16\n"));
#else
#define KNOWN_BYTES 4u
__asm__(ROUTINE("known", "    push {r0}\n    add sp, #4\n"));
#endif
METERED("metered_known", "known");
uint32_t metered_known(uint32_t *unused);

static void report(const char *name, routine metered)
{
    const uint32_t beside = stack_of(metered_known) - KNOWN_BYTES;
    const uint32_t touched = stack_of(metered);

    put_text(name);
    put_number(" stack ", touched > beside ? touched - beside : 0u);
    put_number(" instructions ", instructions());
    put_text("\n");
}

int main(void)
{
    calibrate();
#define EACH(name) report(#name, metered_##name);
    ROUTINES
    return 0;
}
