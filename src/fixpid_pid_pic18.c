// SPDX-License-Identifier: MIT
#include "fixpid_pid_pic18.h"

#if defined(__SDCC_pic16)

#define PRODH 0xFF4
#define PRODL 0xFF3
#define WREG 0xFE8
#define STATUS 0xFD8

__data struct fixpid_operands fixpid_operands;

// Where the members lie.
#define LEFT _fixpid_operands
#define RIGHT _fixpid_operands + 2
#define WIDE _fixpid_operands + 4
#define WIDE_RIGHT _fixpid_operands + 8

// clang-format off

// With an overflow (STATUS, OV) the difference has the wrong sign.
void fixpid_kernel_difference(void) __naked
{
    __asm
    banksel LEFT
    movf    RIGHT, w, b
    subwf   LEFT, f, b
    movf    RIGHT + 1, w, b
    subwfb  LEFT + 1, f, b
    btfss   STATUS, 3, a
    return
    clrf    LEFT, b
    movlw   0x80
    btfss   LEFT + 1, 7, b
    bra     fixpid_difference_end
    setf    LEFT, b
    movlw   0x7F
fixpid_difference_end:
    movwf   LEFT + 1, b
    return
    __endasm;
}

// It overflows where both have one sign and the sum the other. (Not by OV,
// which simulators get wrong after an addition with carry.) `right` is a
// scratch: bit 7 of it says that the signs differ.
void fixpid_kernel_signed_sum(void) __naked
{
    __asm
    banksel LEFT
    movf    WIDE + 3, w, b
    xorwf   WIDE_RIGHT + 3, w, b
    movwf   RIGHT, b
    movf    WIDE_RIGHT, w, b
    addwf   WIDE, f, b
    movf    WIDE_RIGHT + 1, w, b
    addwfc  WIDE + 1, f, b
    movf    WIDE_RIGHT + 2, w, b
    addwfc  WIDE + 2, f, b
    movf    WIDE_RIGHT + 3, w, b
    addwfc  WIDE + 3, f, b
    btfsc   RIGHT, 7, b
    return
    xorwf   WIDE + 3, w, b
    btfss   WREG, 7, a
    return
    clrf    WIDE, b
    clrf    WIDE + 1, b
    clrf    WIDE + 2, b
    movlw   0x80
    btfss   WIDE + 3, 7, b
    bra     fixpid_sum_end
    setf    WIDE, b
    setf    WIDE + 1, b
    setf    WIDE + 2, b
    movlw   0x7F
fixpid_sum_end:
    movwf   WIDE + 3, b
    return
    __endasm;
}

// Four products of the patterns; that of a negative `right` is 2^16 too much.
// `wide_right` is a scratch.
void fixpid_kernel_signed_product(void) __naked
{
    __asm
    banksel LEFT
    movf    LEFT, w, b
    mulwf   RIGHT, b
    movff   PRODL, WIDE
    movff   PRODH, WIDE + 1
    mulwf   RIGHT + 1, b
    movff   PRODL, WIDE_RIGHT
    movff   PRODH, WIDE_RIGHT + 1
    movf    LEFT + 1, w, b
    mulwf   RIGHT + 1, b
    movff   PRODL, WIDE + 2
    movff   PRODH, WIDE + 3
    mulwf   RIGHT, b
    movf    PRODL, w, a
    addwf   WIDE + 1, f, b
    movf    PRODH, w, a
    addwfc  WIDE + 2, f, b
    movlw   0
    addwfc  WIDE + 3, f, b
    movf    WIDE_RIGHT, w, b
    addwf   WIDE + 1, f, b
    movf    WIDE_RIGHT + 1, w, b
    addwfc  WIDE + 2, f, b
    movlw   0
    addwfc  WIDE + 3, f, b
    btfss   RIGHT + 1, 7, b
    return
    movf    LEFT, w, b
    subwf   WIDE + 2, f, b
    movf    LEFT + 1, w, b
    subwfb  WIDE + 3, f, b
    return
    __endasm;
}

// clang-format on

#endif
