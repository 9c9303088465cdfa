# SPDX-License-Identifier: MIT
# As cortex_m0.s, for an Ibex, whose return costs three: two, and one for a caller
# whose next instruction may be unaligned.
        .text

        .balign 4
plain:                          # 5 instructions, 7 cycles, 0 bytes
        li t0, 1
        slli t0, t0, 2
        sltiu t0, t0, 1
        neg t0, t0
        ret

products:                       # 3 instructions, 10 cycles, 0 bytes
        mul t0, t0, t0
        mulhu t0, t0, t0
        ret

quotients:                      # 3 instructions, 79 cycles, 0 bytes
        div t0, t0, t0
        remu t0, t0, t0
        ret

memory:                         # 6 instructions, 13 cycles, 0 bytes
        lw t0, 0(a0)
        lhu t0, 2(a0)
        lb t0, 1(a0)
        sw t0, 0(a0)
        sh t0, 2(a0)
        ret

# The way with fewer instructions is the longer one in cycles.
        .balign 4
taken:                          # 4 instructions, 7 cycles, 0 bytes, 3 measured
        li t0, 0
        beqz t0, taken_end
        nop
taken_end:
        ret

not_taken:                      # 7 instructions, 9 cycles, 0 bytes
        li t0, 0
        bnez t0, not_taken_end
        nop
        nop
        nop
        nop
not_taken_end:
        ret

# The branch leads to 32 bits of two words.
        .balign 4
unaligned:                      # 5 instructions, 9 cycles, 0 bytes, 4 measured
        c.li t0, 0
        .option norvc
        beqz t0, unaligned_end
        nop
unaligned_end:
        addi t0, t0, 1000
        .option rvc
        ret

        .balign 4
jumps:                          # 2 instructions, 5 cycles, 0 bytes
        j jumps_end
jumps_end:
        ret

# What returns finds 32 bits of two words.
        .balign 4
calls:                          # 9 instructions, 22 cycles, 16 bytes
        addi sp, sp, -16
        c.swsp ra, 0(sp)
        c.jal products
        .option norvc
        lw ra, 0(sp)
        .option rvc
        addi sp, sp, 16
        ret

        .balign 4
large:                          # 4 instructions, 7 cycles, 256 bytes
        addi sp, sp, -256
        sw t0, 0(sp)
        addi sp, sp, 256
        ret

# It ends in a jump to the other function, whose stack is the deeper one.
tail_call:                      # 5 instructions, 9 cycles, 256 bytes
        j large

call_and_tail_call:             # 15 instructions, 22 cycles, 272 bytes
        mv t2, ra
        addi sp, sp, -16
        jal large
        addi sp, sp, 16
        mv ra, t2
        j plain

        .balign 4
three_turns:                    # 9 instructions, 15 cycles, 0 bytes
        li t0, 3
        nop
three_turns_turn:
        addi t0, t0, -1
        bnez t0, three_turns_turn
        ret

unknown:                        # refused: no timing of fence
        fence
        ret

computed:                       # refused: no path through
        jr t0

from_register:                  # refused: the stack pointer changes by what is not known
        mv sp, t0
        ret

not_alike:                      # refused: not the same on all paths
        beqz t0, not_alike_end
        addi sp, sp, -16
not_alike_end:
        ret

leaves_some:                    # refused: not all returns leave the same
        addi sp, sp, -16
        beqz t0, leaves_some_end
        addi sp, sp, 16
        ret
leaves_some_end:
        ret

        .include "sized.inc"
        sized plain, products, quotients, memory, taken, not_taken, unaligned, jumps
        sized calls, large, tail_call, call_and_tail_call, three_turns, unknown
        sized computed, from_register, not_alike, leaves_some
