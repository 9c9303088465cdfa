// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"

// This file is empty for other chips and without assembly.
#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "fixpid_an964_8bit_pic18.h"

#define PRODH 0xFF4
#define PRODL 0xFF3
#define STATUS 0xFD8

FIXPID_DATA struct fixpid_an964_8bit_operands fixpid_an964_8bit_operands;

// The addresses of the operands' members.
#define MAGNITUDE _fixpid_an964_8bit_operands
#define ROUND_UP _fixpid_an964_8bit_operands + 1
#define LIMIT _fixpid_an964_8bit_operands + 2

// clang-format off

// The product has 14 bits, and so has its sum with what rounds it up.
uint8_t fixpid_an964_8bit_div4(uint8_t gain) __wparam __naked
{
    (void)gain;
    __asm
    banksel MAGNITUDE
    mulwf   MAGNITUDE, b
    movf    ROUND_UP, w, b
    andlw   3
    addwf   PRODL, f, a
    movlw   0
    addwfc  PRODH, f, a
    rrcf    PRODH, f, a
    rrcf    PRODL, f, a
    bcf     STATUS, 0, a
    rrcf    PRODH, f, a
    rrcf    PRODL, f, a
    movf    LIMIT, w, b
    tstfsz  PRODH, a
    return
    cpfsgt  PRODL, a
    movf    PRODL, w, a
    return
    __endasm;
}

// Above 127 if the product has a bit in 0xFC00; else two of its bits are in
// PRODH.
uint8_t fixpid_an964_8bit_div8(uint8_t gain) __wparam __naked
{
    (void)gain;
    __asm
    banksel MAGNITUDE
    mulwf   MAGNITUDE, b
    movf    PRODH, w, a
    andlw   0xFC
    btfss   STATUS, 2, a
    retlw   127
    rrcf    PRODH, f, a
    rrcf    PRODL, f, a
    rrcf    PRODH, f, a
    rrcf    PRODL, f, a
    bcf     STATUS, 0, a
    rrcf    PRODL, w, a
    return
    __endasm;
}

// Three moves to the left leave the quotient in the carry and PRODH. A word is
// returned in PRODL and W.
uint16_t fixpid_an964_8bit_div32(uint8_t gain) __wparam __naked
{
    (void)gain;
    __asm
    banksel MAGNITUDE
    mulwf   MAGNITUDE, b
    rlcf    PRODL, f, a
    rlcf    PRODH, f, a
    rlcf    PRODL, f, a
    rlcf    PRODH, f, a
    rlcf    PRODL, f, a
    rlcf    PRODH, f, a
    clrf    PRODL, a
    rlcf    PRODL, f, a
    movf    PRODH, w, a
    return
    __endasm;
}

// clang-format on

#endif
