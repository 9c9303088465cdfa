// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"

// This file is empty for other chips and without assembly.
#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_pic18.h"

#define PRODH 0xFF4
#define PRODL 0xFF3
#define STATUS 0xFD8

FIXPID_DATA struct fixpid_an964_operands fixpid_an964_operands;

// The addresses of the operands' members.
#define GAIN _fixpid_an964_operands
#define MAGNITUDE _fixpid_an964_operands + 2
#define QUOTIENT _fixpid_an964_operands + 4
#define ROUND_UP _fixpid_an964_operands + 6
#define LIMIT _fixpid_an964_operands + 7

// clang-format off

// The product has 18 bits, in QUOTIENT + 1, QUOTIENT and PRODL; then every nibble moves
// one place.
void fixpid_an964_divide_16(void) __naked
{
    __asm
    rcall   fixpid_an964_multiply
    swapf   PRODL, w, a
    andlw   0x0F
    movwf   PRODL, a
    swapf   QUOTIENT, w, b
    movwf   QUOTIENT, b
    andlw   0xF0
    iorwf   PRODL, w, a
    movwf   PRODL, a
    movlw   0x0F
    andwf   QUOTIENT, f, b
    swapf   QUOTIENT + 1, w, b
    iorwf   QUOTIENT, w, b
    movwf   QUOTIENT + 1, b
    movff   PRODL, QUOTIENT
    return
fixpid_an964_multiply:
    banksel GAIN
    movf    MAGNITUDE, w, b
    mulwf   GAIN + 1, b
    movff   PRODL, QUOTIENT
    movff   PRODH, QUOTIENT + 1
    mulwf   GAIN, b
    movf    PRODH, w, a
    addwf   QUOTIENT, f, b
    movlw   0
    addwfc  QUOTIENT + 1, f, b
    return
    __endasm;
}

// After three moves to the left the quotient is in the upper two bytes. What the
// carry brings in stays in the lowest.
void fixpid_an964_divide_32(void) __naked
{
    __asm
    rcall   fixpid_an964_multiply
    movf    ROUND_UP, w, b
    andlw   31
    addwf   PRODL, f, a
    movlw   0
    addwfc  QUOTIENT, f, b
    addwfc  QUOTIENT + 1, f, b
    rlcf    PRODL, f, a
    rlcf    QUOTIENT, f, b
    rlcf    QUOTIENT + 1, f, b
    rlcf    PRODL, f, a
    rlcf    QUOTIENT, f, b
    rlcf    QUOTIENT + 1, f, b
    rlcf    PRODL, f, a
    rlcf    QUOTIENT, f, b
    rlcf    QUOTIENT + 1, f, b
    movf    LIMIT, w, b
    tstfsz  QUOTIENT + 1, b
    bra     fixpid_an964_limited
    cpfsgt  QUOTIENT, b
    return
fixpid_an964_limited:
    movwf   QUOTIENT, b
    return
    __endasm;
}

// The quotient is the upper 14 bits of the product, which has 24. The lowest byte of
// the products does not change them.
void fixpid_an964_divide_1024(void) __naked
{
    __asm
    banksel GAIN
    movf    MAGNITUDE, w, b
    mulwf   GAIN, b
    movff   PRODH, QUOTIENT
    mulwf   GAIN + 1, b
    movff   PRODH, QUOTIENT + 1
    movf    PRODL, w, a
    addwf   QUOTIENT, f, b
    movlw   0
    addwfc  QUOTIENT + 1, f, b
    movf    MAGNITUDE + 1, w, b
    mulwf   GAIN, b
    movf    PRODL, w, a
    addwf   QUOTIENT, f, b
    movf    PRODH, w, a
    addwfc  QUOTIENT + 1, f, b
    movf    MAGNITUDE + 1, w, b
    mulwf   GAIN + 1, b
    movf    PRODL, w, a
    addwf   QUOTIENT + 1, f, b
    bcf     STATUS, 0, a
    rrcf    QUOTIENT + 1, f, b
    rrcf    QUOTIENT, f, b
    bcf     STATUS, 0, a
    rrcf    QUOTIENT + 1, f, b
    rrcf    QUOTIENT, f, b
    return
    __endasm;
}

// clang-format on

#endif
