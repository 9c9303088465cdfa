// SPDX-License-Identifier: MIT
#include "fixpid_kernel_pic18.h"

#include "fixpid_arith.h"

#if defined(__SDCC_pic16)

#define POSTINC0 0xFEE
#define POSTDEC0 0xFED
#define PREINC0 0xFEC
#define PLUSW0 0xFEB
#define PRODH 0xFF4
#define PRODL 0xFF3

int32_t fixpid_kernel_sum;

// clang-format off

// sum = 0, and in the same way as the second entry sum += gain * number. A
// number is its magnitude, low byte first, and its sign. MULWF leaves the carry
// alone. `clang-format off` because it takes assembly for C.
// Deviation 40 lines: each is one instruction, and a second part costs a GOTO
void fixpid_kernel_start(void) __naked
{
    __asm
    banksel _fixpid_kernel_sum
    clrf    _fixpid_kernel_sum, b
    clrf    _fixpid_kernel_sum + 1, b
    clrf    _fixpid_kernel_sum + 2, b
    clrf    _fixpid_kernel_sum + 3, b
_fixpid_kernel_add_product:
    global  _fixpid_kernel_add_product
    banksel _fixpid_kernel_sum
    movlw   3
    tstfsz  PLUSW0, a                   ; sign
    bra     fixpid_subtract
    movf    POSTINC0, w, a              ; gain
    mulwf   POSTDEC0, a                 ; low byte
    movf    PRODL, w, a
    addwf   _fixpid_kernel_sum, f, b
    movf    PRODH, w, a
    addwfc  _fixpid_kernel_sum + 1, f, b
    movlw   0
    addwfc  _fixpid_kernel_sum + 2, f, b
    addwfc  _fixpid_kernel_sum + 3, f, b
    movf    POSTINC0, w, a              ; gain
    mulwf   PREINC0, a                  ; high byte
    movf    PRODL, w, a
    addwf   _fixpid_kernel_sum + 1, f, b
    movf    PRODH, w, a
    addwfc  _fixpid_kernel_sum + 2, f, b
    movlw   0
    addwfc  _fixpid_kernel_sum + 3, f, b
    return
fixpid_subtract:
    movf    POSTINC0, w, a              ; gain
    mulwf   POSTDEC0, a                 ; low byte
    movf    PRODL, w, a
    subwf   _fixpid_kernel_sum, f, b
    movf    PRODH, w, a
    subwfb  _fixpid_kernel_sum + 1, f, b
    movlw   0
    subwfb  _fixpid_kernel_sum + 2, f, b
    subwfb  _fixpid_kernel_sum + 3, f, b
    movf    POSTINC0, w, a              ; gain
    mulwf   PREINC0, a                  ; high byte
    movf    PRODL, w, a
    subwf   _fixpid_kernel_sum + 1, f, b
    movf    PRODH, w, a
    subwfb  _fixpid_kernel_sum + 2, f, b
    movlw   0
    subwfb  _fixpid_kernel_sum + 3, f, b
    return
    __endasm;
}

// sum = sum / 16, limited; W has FIXPID_SUM_SATURATED and FIXPID_SUM_NEGATIVE. A
// negative sum is rounded toward zero by adding 15; it is limited if its
// uppermost byte is below 0xFF, or the others are 0.
// Deviation 40 lines: the same
uint8_t fixpid_kernel_sixteenth(void) __naked
{
    __asm
    banksel _fixpid_kernel_sum
    btfsc   _fixpid_kernel_sum + 3, 7, b
    bra     fixpid_negative
    movf    _fixpid_kernel_sum + 3, w, b
    bz      fixpid_shift
fixpid_highest:
    setf    _fixpid_kernel_sum, b       ; (2^24 - 1) / 16
    setf    _fixpid_kernel_sum + 1, b
    movlw   0x0F
    movwf   _fixpid_kernel_sum + 2, b
    clrf    _fixpid_kernel_sum + 3, b
    retlw   0x01
fixpid_negative:
    incfsz  _fixpid_kernel_sum + 3, w, b
    bra     fixpid_lowest
    movf    _fixpid_kernel_sum, w, b
    iorwf   _fixpid_kernel_sum + 1, w, b
    iorwf   _fixpid_kernel_sum + 2, w, b
    bz      fixpid_lowest
    movlw   15
    addwf   _fixpid_kernel_sum, f, b
    movlw   0
    addwfc  _fixpid_kernel_sum + 1, f, b
    addwfc  _fixpid_kernel_sum + 2, f, b
    addwfc  _fixpid_kernel_sum + 3, f, b
    rcall   fixpid_shift
    retlw   0x80
fixpid_lowest:
    rcall   fixpid_highest
    negf    _fixpid_kernel_sum, b
    comf    _fixpid_kernel_sum + 1, f, b
    comf    _fixpid_kernel_sum + 2, f, b
    setf    _fixpid_kernel_sum + 3, b
    retlw   0x81
fixpid_shift:
    swapf   _fixpid_kernel_sum, f, b
    swapf   _fixpid_kernel_sum + 1, w, b
    xorwf   _fixpid_kernel_sum, w, b
    andlw   0xF0
    xorwf   _fixpid_kernel_sum, f, b
    swapf   _fixpid_kernel_sum + 1, f, b
    swapf   _fixpid_kernel_sum + 2, w, b
    xorwf   _fixpid_kernel_sum + 1, w, b
    andlw   0xF0
    xorwf   _fixpid_kernel_sum + 1, f, b
    swapf   _fixpid_kernel_sum + 2, w, b
    andlw   0x0F
    btfsc   _fixpid_kernel_sum + 3, 7, b
    iorlw   0xF0
    movwf   _fixpid_kernel_sum + 2, b
    retlw   0
    __endasm;
}

// clang-format on

#else

#define SUM_MAX INT32_C(0xFFFFFF)

int32_t fixpid_kernel_product(uint8_t gain, uint16_t magnitude,
                              uint8_t negative)
{
    const int32_t product = (int32_t)gain * (int32_t)magnitude;

    return (negative != 0u) ? -product : product;
}

int32_t fixpid_kernel_sixteenth(int32_t sum)
{
    int32_t limited = sum;

    if (limited > SUM_MAX) {
        limited = SUM_MAX;
    }
    if (limited < -SUM_MAX) {
        limited = -SUM_MAX;
    }
    return limited / 16;
}

uint8_t fixpid_kernel_flags(int32_t sum)
{
    uint8_t flags = 0;

    if (sum < 0) {
        flags |= FIXPID_SUM_NEGATIVE;
    }
    if (sum > SUM_MAX) {
        flags |= FIXPID_SUM_SATURATED;
    }
    if (sum < -SUM_MAX) {
        flags |= FIXPID_SUM_SATURATED;
    }
    return flags;
}

#endif
