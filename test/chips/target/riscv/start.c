// SPDX-License-Identifier: MIT
// What a RISC-V brings to test/chips/target/qemu/runtime.c.
#include "semihosting.h"

// Three instructions of 32 bits, that QEMU knows by their neighbours.
void semihosting(uint32_t operation, const void *argument)
{
    register uint32_t a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = argument;

    __asm__ volatile(".option push\n.option norvc\n.balign 16\n"
                     "    slli x0, x0, 0x1F\n"
                     "    ebreak\n"
                     "    srai x0, x0, 7\n"
                     ".option pop\n"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
}

// The entrance, with a stack and with where every trap goes.
__asm__(".option push\n.option arch, +zicsr\n"
        ".section .vectors, \"ax\"\n"
        "    la sp, stack_top\n"
        "    la t0, trap\n"
        "    csrw mtvec, t0\n"
        "    j reset_handler\n"
        ".balign 4\n"
        "trap:\n"
        "    j fault_handler\n"
        ".option pop\n"
        ".text\n");
