// SPDX-License-Identifier: MIT
// Instructions of a RISC-V in QEMU: with -icount its own counter has them.
#ifndef COUNTER_H
#define COUNTER_H
#include <stdint.h>

#define TICKS_MASK UINT32_MAX
#define ROUTINE(name, text) name ":\n" text "    ret\n"

// As the call of the step: between the two readings lie a call, the routine
// with its return, and one reading.
#define METERED(name, routine)                                                 \
    __asm__(".option push\n.option arch, +zicsr\n.text\n.global " name         \
            "\n" name ":\n"                                                    \
            "    addi sp, sp, -16\n"                                           \
            "    sw ra, 12(sp)\n"                                              \
            "    sw s0, 8(sp)\n"                                               \
            "    csrr s0, minstret\n"                                          \
            "    call " routine "\n"                                           \
            "    csrr t0, minstret\n"                                          \
            "    sub t0, t0, s0\n"                                             \
            "    la t1, metered_ticks\n"                                       \
            "    sw t0, 0(t1)\n"                                               \
            "    lw ra, 12(sp)\n"                                              \
            "    lw s0, 8(sp)\n"                                               \
            "    addi sp, sp, 16\n"                                            \
            "    ret\n.option pop\n")

static void counter_begin(void)
{
    // it always counts
}

#endif
