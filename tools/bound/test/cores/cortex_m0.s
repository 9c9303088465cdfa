@ SPDX-License-Identifier: MIT
@ What a routine takes on a Cortex-M0: instructions, cycles, with the slow multiplier
@ behind "or", and bytes of stack; or a part of why it is refused. Cycles are added up
@ by hand from the core's manual. QEMU measures instructions and stack; r0 leads to 16
@ words there. On a path that it does not take a routine is longer than measured.
        .syntax unified
        .thumb
        .text

plain:                          @ 5 instructions, 7 cycles, 0 bytes
        movs r1, #1
        lsls r1, r1, #2
        subs r1, r1, #1
        sxth r1, r1
        bx lr

product:                        @ 2 instructions, 4 or 35 cycles, 0 bytes
        muls r1, r2, r1
        bx lr

memory:                         @ 8 instructions, 17 cycles, 0 bytes
        ldr r1, [r0, #4]
        ldrh r1, [r0, #2]
        ldrsh r1, [r0, r1]
        ldrb r1, [r0]
        str r1, [r0]
        strh r1, [r0]
        strb r1, [r0, #3]
        bx lr

constant:                       @ 2 instructions, 5 cycles, 0 bytes
        ldr r1, =0x12345678
        bx lr
        .ltorg

several:                        @ 3 instructions, 10 cycles, 0 bytes
        ldmia r0!, {r1, r2, r3}
        stmia r0!, {r1, r2}
        bx lr

pushes:                         @ 2 instructions, 13 cycles, 16 bytes
        push {r4-r6, lr}
        pop {r4-r6, pc}

@ The way with fewer instructions is the longer one in cycles.
taken:                          @ 4 instructions, 7 cycles, 0 bytes, 3 measured
        cmp r0, r0
        beq taken_end
        nop
taken_end:
        bx lr

not_taken:                      @ 8 instructions, 10 cycles, 0 bytes
        cmp r0, r0
        bne not_taken_end
        nop
        nop
        nop
        nop
        nop
not_taken_end:
        bx lr

jumps:                          @ 2 instructions, 6 cycles, 0 bytes
        b jumps_end
jumps_end:
        bx lr

calls:                          @ 5 instructions, 17 or 48 cycles, 8 bytes
        push {r4, lr}
        bl product
        pop {r4, pc}

large:                          @ 4 instructions, 7 cycles, 256 bytes
        sub sp, #256
        str r0, [sp]
        add sp, #256
        bx lr

@ It ends in a jump to the other function, whose stack is the deeper one.
tail_call:                      @ 9 instructions, 18 cycles, 256 bytes
        push {r4, lr}
        pop {r4}
        pop {r1}
        mov lr, r1
        b large

call_and_tail_call:             @ 15 instructions, 25 cycles, 264 bytes
        mov r3, lr
        sub sp, #8
        bl large
        add sp, #8
        mov lr, r3
        b plain

unknown:                        @ refused: no timing of dmb
        dmb
        bx lr

computed:                       @ refused: no path through
        blx r1
        bx lr

from_register:                  @ refused: the stack pointer changes by what is not known
        mov sp, r1
        bx lr

not_alike:                      @ refused: not the same on all paths
        cmp r0, r0
        beq not_alike_end
        push {r1}
not_alike_end:
        bx lr

leaves_some:                    @ refused: not all returns leave the same
        push {r1}
        cmp r0, r0
        beq leaves_some_end
        pop {r1}
        bx lr
leaves_some_end:
        bx lr

        .include "sized.inc"
        sized plain, product, memory, constant, several, pushes, taken, not_taken
        sized jumps, calls, large, tail_call, call_and_tail_call, unknown, computed
        sized from_register, not_alike, leaves_some
