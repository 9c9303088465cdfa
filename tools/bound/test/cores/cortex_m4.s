@ SPDX-License-Identifier: MIT
@ As cortex_m0.s, for a Cortex-M4.
        .syntax unified
        .thumb
        .text

plain:                          @ 9 instructions, 12 cycles, 0 bytes
        movw r1, #1000
        add.w r1, r1, r1, lsl #3
        ssat r1, #8, r1
        ubfx r1, r1, #2, #4
        clz r2, r1
        qadd r1, r1, r2
        sxth r1, r1
        uxtah r1, r1, r2
        bx lr

products:                       @ 6 instructions, 9 cycles, 0 bytes
        mul r1, r1, r1
        mla r1, r1, r1, r1
        smull r1, r2, r2, r2
        smulbb r1, r1, r1
        smlabb r1, r1, r1, r1
        bx lr

quotient:                       @ 2 instructions, 16 cycles, 0 bytes
        sdiv r1, r1, r1
        bx lr

memory:                         @ 7 instructions, 18 cycles, 0 bytes
        ldr r1, [r0, #4]
        ldrsh.w r1, [r0, #2]
        str r1, [r0]
        strb.w r1, [r0, #3]
        ldrd r2, r3, [r0]
        strd r2, r3, [r0]
        bx lr

constant:                       @ 2 instructions, 7 cycles, 0 bytes
        ldr r1, =0x12345678
        bx lr
        .ltorg

several:                        @ 3 instructions, 11 cycles, 0 bytes
        ldmia r0!, {r1, r2, r3}
        stmia r0!, {r1, r2}
        bx lr

pushes:                         @ 2 instructions, 13 cycles, 16 bytes
        push {r4-r6, lr}
        pop {r4-r6, pc}

wide_pushes:                    @ 2 instructions, 19 cycles, 28 bytes
        push.w {r4-r9, lr}
        pop.w {r4-r9, pc}

one_pushed:                     @ 4 instructions, 9 cycles, 4 bytes
        str.w r4, [sp, #-4]!
        nop
        ldr.w r4, [sp], #4
        bx lr

return_popped:                  @ 2 instructions, 7 cycles, 4 bytes
        str.w lr, [sp, #-4]!
        ldr.w pc, [sp], #4

@ The way with fewer instructions is the longer one in cycles.
taken:                          @ 4 instructions, 9 cycles, 0 bytes, 3 measured
        cmp r0, r0
        beq taken_end
        nop
taken_end:
        bx lr

zero:                           @ 4 instructions, 9 cycles, 0 bytes, 3 measured
        movs r1, #0
        cbz r1, zero_end
        nop
zero_end:
        bx lr

not_taken:                      @ 8 instructions, 11 cycles, 0 bytes
        cmp r0, r0
        bne not_taken_end
        nop
        nop
        nop
        nop
        nop
not_taken_end:
        bx lr

@ What is skipped costs as much as what is not.
skipped:                        @ 5 instructions, 9 cycles, 0 bytes
        cmp r0, r0
        ite ne
        ldrne r1, [r0]
        addeq r1, r1, #1
        bx lr

@ The first return is not taken, and has popped nothing.
return_skipped:                 @ 5 instructions, 12 cycles, 8 bytes
        push {r4, lr}
        cmp r0, r0
        it ne
        popne {r4, pc}
        pop {r4, pc}

calls:                          @ 9 instructions, 22 cycles, 8 bytes
        push {r4, lr}
        bl products
        pop {r4, pc}

large:                          @ 4 instructions, 8 cycles, 1024 bytes
        sub.w sp, sp, #1024
        str r0, [sp]
        add.w sp, sp, #1024
        bx lr

@ It ends in a jump to the other function, whose stack is the deeper one.
tail_call:                      @ 7 instructions, 18 cycles, 1024 bytes
        push {r4, lr}
        ldmia.w sp!, {r4, lr}
        b.w large

unknown:                        @ refused: no timing of dmb
        dmb
        bx lr

computed:                       @ refused: no path through
        tbb [pc, r1]

pushed_sometimes:               @ refused: the stack pointer changes by what is not known
        cmp r0, r0
        it eq
        subeq sp, sp, #8
        bx lr

        .include "sized.inc"
        sized plain, products, quotient, memory, constant, several, pushes
        sized wide_pushes, one_pushed, return_popped, taken, zero, not_taken, skipped
        sized return_skipped, calls, large, tail_call, unknown, computed
        sized pushed_sometimes
