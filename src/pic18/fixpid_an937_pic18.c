// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

// Nothing where another chip or no assembly is meant.
#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include <stddef.h>

#include "fixpid_an937_pic18.h"

// The layout that the assembly relies on: each member is where it looks.
#define CHECK_OFFSET(member, offset)                                           \
    typedef char fixpid_##member##_is_elsewhere                                \
        [(offsetof(struct fixpid_an937, member) == (offset)) ? 1 : -1]
CHECK_OFFSET(error, 0);
CHECK_OFFSET(accumulated_error, 4);
CHECK_OFFSET(delta, 8);
CHECK_OFFSET(kp_q4, 12);
CHECK_OFFSET(ki_q4, 16);
CHECK_OFFSET(kd_q4, 20);

#define POSTINC0 0xFEE
#define PLUSW0 0xFEB
#define INDF0 0xFEF
#define PRODH 0xFF4
#define PRODL 0xFF3

FIXPID_DATA struct fixpid_an937_operands fixpid_an937_operands;

// clang-format off

void fixpid_an937_product(void) __naked
{
    __asm
    banksel _fixpid_an937_operands
    clrf    _fixpid_an937_operands, b
    clrf    _fixpid_an937_operands + 1, b
    clrf    _fixpid_an937_operands + 2, b
    clrf    _fixpid_an937_operands + 3, b
    bra     fixpid_add_product
    __endasm;
}

// sum = 0, then three times sum += gain * number. A number is its magnitude, low
// byte first, and its sign. The low product waits in `low` until the high one is
// added to its upper byte.
// Deviation 40 lines: each is one instruction
void fixpid_an937_products(void) __naked
{
    __asm
    banksel _fixpid_an937_operands
    clrf    _fixpid_an937_operands, b
    clrf    _fixpid_an937_operands + 1, b
    clrf    _fixpid_an937_operands + 2, b
    clrf    _fixpid_an937_operands + 3, b
    rcall   fixpid_add_product
    rcall   fixpid_add_product
fixpid_add_product:
    movlw   12
    movf    PLUSW0, w, a                ; gain
    mulwf   POSTINC0, a                 ; low byte
    movff   PRODL, _fixpid_an937_operands + 4
    movff   PRODH, _fixpid_an937_operands + 5
    mulwf   POSTINC0, a                 ; high byte
    movf    _fixpid_an937_operands + 5, w, b
    addwf   PRODL, f, a
    movlw   0
    addwfc  PRODH, f, a
    tstfsz  POSTINC0, a                 ; sign
    bra     fixpid_subtract
    movf    POSTINC0, w, a              ; padding
    movf    _fixpid_an937_operands + 4, w, b
    addwf   _fixpid_an937_operands, f, b
    movf    PRODL, w, a
    addwfc  _fixpid_an937_operands + 1, f, b
    movf    PRODH, w, a
    addwfc  _fixpid_an937_operands + 2, f, b
    movlw   0
    addwfc  _fixpid_an937_operands + 3, f, b
    return
fixpid_subtract:
    movf    POSTINC0, w, a              ; padding
    movf    _fixpid_an937_operands + 4, w, b
    subwf   _fixpid_an937_operands, f, b
    movf    PRODL, w, a
    subwfb  _fixpid_an937_operands + 1, f, b
    movf    PRODH, w, a
    subwfb  _fixpid_an937_operands + 2, f, b
    movlw   0
    subwfb  _fixpid_an937_operands + 3, f, b
    return
    __endasm;
}

// sum = sum / 16, limited; W has SUM_SATURATED (0x01) and SUM_NEGATIVE (0x80). A
// negative sum is rounded toward zero by adding 15; it is limited if its
// uppermost byte is below 0xFF, or the others are 0.
// Deviation 40 lines: the same
uint8_t fixpid_an937_divide(void) __naked
{
    __asm
    banksel _fixpid_an937_operands
    btfsc   _fixpid_an937_operands + 3, 7, b
    bra     fixpid_negative
    movf    _fixpid_an937_operands + 3, w, b
    bz      fixpid_shift
fixpid_highest:
    setf    _fixpid_an937_operands, b       ; (2^24 - 1) / 16
    setf    _fixpid_an937_operands + 1, b
    movlw   0x0F
    movwf   _fixpid_an937_operands + 2, b
    clrf    _fixpid_an937_operands + 3, b
    retlw   0x01
fixpid_negative:
    incfsz  _fixpid_an937_operands + 3, w, b
    bra     fixpid_lowest
    movf    _fixpid_an937_operands, w, b
    iorwf   _fixpid_an937_operands + 1, w, b
    iorwf   _fixpid_an937_operands + 2, w, b
    bz      fixpid_lowest
    movlw   15
    addwf   _fixpid_an937_operands, f, b
    movlw   0
    addwfc  _fixpid_an937_operands + 1, f, b
    addwfc  _fixpid_an937_operands + 2, f, b
    addwfc  _fixpid_an937_operands + 3, f, b
    rcall   fixpid_shift
    retlw   0x80
fixpid_lowest:
    rcall   fixpid_highest
    negf    _fixpid_an937_operands, b
    comf    _fixpid_an937_operands + 1, f, b
    comf    _fixpid_an937_operands + 2, f, b
    setf    _fixpid_an937_operands + 3, b
    retlw   0x81
fixpid_shift:
    swapf   _fixpid_an937_operands, f, b
    swapf   _fixpid_an937_operands + 1, w, b
    xorwf   _fixpid_an937_operands, w, b
    andlw   0xF0
    xorwf   _fixpid_an937_operands, f, b
    swapf   _fixpid_an937_operands + 1, f, b
    swapf   _fixpid_an937_operands + 2, w, b
    xorwf   _fixpid_an937_operands + 1, w, b
    andlw   0xF0
    xorwf   _fixpid_an937_operands + 1, f, b
    swapf   _fixpid_an937_operands + 2, w, b
    andlw   0x0F
    btfsc   _fixpid_an937_operands + 3, 7, b
    iorlw   0xF0
    movwf   _fixpid_an937_operands + 2, b
    retlw   0
    __endasm;
}

// clang-format on

#endif
