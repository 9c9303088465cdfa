// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"

// This file is empty for other chips and without assembly.
#if defined(__SDCC_pic14) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_pic14.h"

// The sum, in STK03 and STK04, moves right once per bit of the second operand.
// W holds the first operand. Whatever RRF drops is 0 where both bytes move, and
// so is the carry before the next addition.
// Deviation 20.10: byte and bit become part of the assembly.
#define DROP(byte, bit)                                                        \
    __asm__("bcf STATUS,0\n"                                                   \
            "\tbtfsc " #byte "," #bit "\n"                                     \
            "\taddwf STK03,f\n"                                                \
            "\trrf STK03,f")
// Deviation 20.10: as above.
#define KEEP(byte, bit)                                                        \
    __asm__("btfsc " #byte "," #bit "\n"                                       \
            "\taddwf STK03,f\n"                                                \
            "\trrf STK03,f\n"                                                  \
            "\trrf STK04,f")

// The magnitude in W, the gain in STK00 and STK01. The second label is for a
// sum that does not start at 0.
uint16_t fixpid_7x10_div16(uint8_t magnitude, uint16_t gain) __naked
{
    (void)magnitude;
    (void)gain;
    __asm__("clrf STK03\nfixpid_8x10_sum:\n\tclrf STK04");
    DROP(STK01, 0);
    DROP(STK01, 1);
    DROP(STK01, 2);
    DROP(STK01, 3);
    __asm__("bcf STATUS,0");
    KEEP(STK01, 4);
    KEEP(STK01, 5);
    KEEP(STK01, 6);
    KEEP(STK01, 7);
    KEEP(STK00, 0);
    KEEP(STK00, 1);
    __asm__("rrf STK03,f\n\trrf STK04,f");
    __asm__("rrf STK03,f\n\trrf STK04,w");
    __asm__("movwf STK00\n\tmovf STK03,w\n\treturn");
}

// round_up in STK02. The quotient of above is in STK03 and STK00, its upper
// byte in W, too.
uint8_t fixpid_8x10_div32_byte(uint8_t magnitude, uint16_t gain,
                               uint8_t round_up) __naked
{
    (void)magnitude;
    (void)gain;
    (void)round_up;
    __asm__("movwf STK04\n\tmovf STK02,w\n\tandlw 31\n\tmovwf STK03");
    __asm__("movf STK04,w\n\tpagesel fixpid_8x10_sum\n"
            "\tcall fixpid_8x10_sum\n\tpagesel $");
    __asm__("andlw 0xFE\n\tbtfss STATUS,2\n\tretlw 255");
    __asm__("rrf STK03,f\n\trrf STK00,w\n\treturn");
}

// The gain in W and STK00, the magnitude in STK01 and STK02. The sum is in
// STK04 and STK05; below 2^15, so that the carry is 0 when it moves.
uint16_t fixpid_10x14_div1024(uint16_t gain, uint16_t magnitude) __naked
{
    (void)gain;
    (void)magnitude;
    __asm__("movwf STK03\n\tclrf STK04\n\tclrf STK05");
    __asm__("movlw 10\n\tmovwf STK06");
    __asm__("fixpid_10x14_turn:\n\trrf STK03,f\n\trrf STK00,f");
    __asm__("btfss STATUS,0\n\tgoto fixpid_10x14_move");
    __asm__("movf STK02,w\n\taddwf STK05,f\n\tmovf STK01,w");
    __asm__("btfsc STATUS,0\n\tincfsz STK01,w\n\taddwf STK04,f");
    __asm__("fixpid_10x14_move:\n\trrf STK04,f\n\trrf STK05,f");
    __asm__("decfsz STK06,f\n\tgoto fixpid_10x14_turn");
    __asm__("movf STK05,w\n\tmovwf STK00\n\tmovf STK04,w\n\treturn");
}

#endif
