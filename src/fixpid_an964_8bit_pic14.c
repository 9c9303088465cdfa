// SPDX-License-Identifier: MIT
// The products of AN964's 8-bit form.
#include "fixpid_an964_pic14.h"

#if defined(__SDCC_pic14)

// The sum moves right once per bit of STK01; W has the other operand. Below
// 2 * 127 before it moves, and the carry is 0 after each bit. Then STK02 has
// the product's upper 7 bits and STK03 its lower 7, at the top.
// Deviation 20.10: the bit becomes part of the assembly.
#define ADD_AND_MOVE(bit)                                                      \
    __asm__("btfsc STK01," #bit "\n"                                           \
            "\taddwf STK02,f\n"                                                \
            "\trrf STK02,f\n"                                                  \
            "\trrf STK03,f")
#define MULTIPLY()                                                             \
    ADD_AND_MOVE(0);                                                           \
    ADD_AND_MOVE(1);                                                           \
    ADD_AND_MOVE(2);                                                           \
    ADD_AND_MOVE(3);                                                           \
    ADD_AND_MOVE(4);                                                           \
    ADD_AND_MOVE(5);                                                           \
    ADD_AND_MOVE(6)

// up in W, x in STK00, k in STK01. A quotient above 127 has a bit in 0x7C of
// the upper byte.
uint8_t fixpid_kernel_7x7_2(uint8_t up, uint8_t x, uint8_t k) __naked
{
    (void)up;
    (void)x;
    (void)k;
    __asm__(
        "andlw 3\n\tmovwf STK02\n\tclrf STK03\n\tmovf STK00,w\n\tbcf STATUS,0");
    MULTIPLY();
    __asm__("movf STK02,w\n\tandlw 0x7C\n\tbtfss STATUS,2\n\tretlw 127");
    __asm__("rrf STK02,f\n\trrf STK03,f\n\trrf STK02,f\n\trrf STK03,f");
    __asm__("rrf STK02,f\n\trrf STK03,w\n\treturn");
}

// Likewise with 0x78, and add is 0.
uint8_t fixpid_kernel_7x7_3(uint8_t x, uint8_t k) __naked
{
    (void)x;
    (void)k;
    __asm__("clrf STK02\n\tclrf STK03\n\tmovwf STK01\n\tmovf STK00,w");
    __asm__("bcf STATUS,0");
    MULTIPLY();
    __asm__("movf STK02,w\n\tandlw 0x78\n\tbtfss STATUS,2\n\tretlw 127");
    __asm__("swapf STK02,f\n\tswapf STK03,w\n\tandlw 0x0F\n\tiorwf STK02,w");
    __asm__("return");
}

uint16_t fixpid_kernel_7x7_5(uint8_t x, uint8_t k) __naked
{
    (void)x;
    (void)k;
    __asm__("clrf STK02\n\tclrf STK03\n\tmovwf STK01\n\tmovf STK00,w");
    __asm__("bcf STATUS,0");
    MULTIPLY();
    __asm__("rlf STK03,f\n\trlf STK02,f\n\trlf STK03,f\n\trlf STK02,w");
    __asm__("movwf STK00\n\tmovlw 0\n\tbtfsc STATUS,0\n\tmovlw 1\n\treturn");
}

#else

static uint8_t limited(uint16_t value)
{
    if (value > 127u) {
        return 127;
    }
    return (uint8_t)value;
}

uint8_t fixpid_kernel_7x7_2(uint8_t up, uint8_t x, uint8_t k)
{
    return limited((uint16_t)((((uint32_t)x * k) + (up & 3u)) >> 2));
}

uint8_t fixpid_kernel_7x7_3(uint8_t x, uint8_t k)
{
    return limited((uint16_t)(((uint32_t)x * k) >> 3));
}

uint16_t fixpid_kernel_7x7_5(uint8_t x, uint8_t k)
{
    return (uint16_t)(((uint32_t)x * k) >> 5);
}

#endif
