// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"

// This file is empty for other chips and without assembly.
#if defined(__SDCC_pic14) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic14.h"

// The sum moves right once per bit of STK01; W has the other operand. Below
// 2 * 127 before it moves, and the carry is 0 after each bit. Then STK02 has
// the product's upper 7 bits and STK03 its lower 7, at the top.
// Deviation 20.10: the bit becomes part of the assembly.
#define ADD_AND_MOVE(bit)                                                      \
    __asm__("btfsc STK01," #bit "\n"                                           \
            "\taddwf STK02,f\n"                                                \
            "\trrf STK02,f\n"                                                  \
            "\trrf STK03,f")
#define MULTIPLY                                                               \
    ADD_AND_MOVE(0);                                                           \
    ADD_AND_MOVE(1);                                                           \
    ADD_AND_MOVE(2);                                                           \
    ADD_AND_MOVE(3);                                                           \
    ADD_AND_MOVE(4);                                                           \
    ADD_AND_MOVE(5);                                                           \
    ADD_AND_MOVE(6)

// round_up in W, the gain in STK00, the magnitude in STK01. A quotient above
// 127 has a bit in 0x7C of the upper byte.
uint8_t fixpid_7x7_div4_byte(uint8_t round_up, uint8_t gain,
                             uint8_t magnitude) __naked
{
    (void)round_up;
    (void)gain;
    (void)magnitude;
    __asm__(
        "andlw 3\n\tmovwf STK02\n\tclrf STK03\n\tmovf STK00,w\n\tbcf STATUS,0");
    MULTIPLY;
    __asm__("movf STK02,w\n\tandlw 0x7C\n\tbtfss STATUS,2\n\tretlw 127");
    __asm__("rrf STK02,f\n\trrf STK03,f\n\trrf STK02,f\n\trrf STK03,f");
    __asm__("rrf STK02,f\n\trrf STK03,w\n\treturn");
}

// The gain in W, the magnitude in STK00; a quotient above 127 has a bit in 0x78
// of the upper byte. Nothing is added first.
uint8_t fixpid_7x7_div8(uint8_t gain, uint8_t magnitude) __naked
{
    (void)gain;
    (void)magnitude;
    __asm__("clrf STK02\n\tclrf STK03\n\tmovwf STK01\n\tmovf STK00,w");
    __asm__("bcf STATUS,0");
    MULTIPLY;
    __asm__("movf STK02,w\n\tandlw 0x78\n\tbtfss STATUS,2\n\tretlw 127");
    __asm__("swapf STK02,f\n\tswapf STK03,w\n\tandlw 0x0F\n\tiorwf STK02,w");
    __asm__("return");
}

uint16_t fixpid_7x7_div32(uint8_t gain, uint8_t magnitude) __naked
{
    (void)gain;
    (void)magnitude;
    __asm__("clrf STK02\n\tclrf STK03\n\tmovwf STK01\n\tmovf STK00,w");
    __asm__("bcf STATUS,0");
    MULTIPLY;
    __asm__("rlf STK03,f\n\trlf STK02,f\n\trlf STK03,f\n\trlf STK02,w");
    __asm__("movwf STK00\n\tmovlw 0\n\tbtfsc STATUS,0\n\tmovlw 1\n\treturn");
}

#endif
