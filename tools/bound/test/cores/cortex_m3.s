@ SPDX-License-Identifier: MIT
@ As cortex_m0.s, what takes longer on a Cortex-M3 than on a Cortex-M4.
        .syntax unified
        .thumb
        .text

products:                       @ 5 instructions, 14 cycles, 0 bytes
        mul r1, r1, r1
        mla r1, r1, r1, r1
        mls r1, r1, r1, r1
        smull r1, r2, r2, r2
        bx lr

accumulated:                    @ 2 instructions, 11 cycles, 0 bytes
        umlal r1, r2, r2, r2
        bx lr

quotient:                       @ 2 instructions, 16 cycles, 0 bytes
        udiv r1, r1, r1
        bx lr

of_cortex_m4:                   @ refused: no timing of smulbb
        smulbb r1, r1, r1
        bx lr

        .include "sized.inc"
        sized products, accumulated, quotient, of_cortex_m4
