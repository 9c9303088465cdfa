// SPDX-License-Identifier: MIT
#include "fixpid_an937_pic18.h"

#include "fixpid_an937_arith.h"

#if defined(__SDCC_pic16)

#define POSTINC0 0xFEE
#define PLUSW0 0xFEB
#define INDF0 0xFEF
#define PRODH 0xFF4
#define PRODL 0xFF3

struct fixpid_kernel fixpid_kernel;

// clang-format off

// sum = 0, then three times sum += gain * number. A number is its magnitude, low
// byte first, and its sign; the next one is 4 bytes behind, its gain 12. The low
// product waits in `low` until the high one is added to its upper byte.
// Deviation 40 lines: each is one instruction
void fixpid_kernel_products(void) __naked
{
    __asm
    banksel _fixpid_kernel
    clrf    _fixpid_kernel, b
    clrf    _fixpid_kernel + 1, b
    clrf    _fixpid_kernel + 2, b
    clrf    _fixpid_kernel + 3, b
    rcall   fixpid_add_product
    rcall   fixpid_add_product
fixpid_add_product:
    movlw   12
    movf    PLUSW0, w, a                ; gain
    mulwf   POSTINC0, a                 ; low byte
    movff   PRODL, _fixpid_kernel + 4
    movff   PRODH, _fixpid_kernel + 5
    mulwf   POSTINC0, a                 ; high byte
    movf    _fixpid_kernel + 5, w, b
    addwf   PRODL, f, a
    movlw   0
    addwfc  PRODH, f, a
    tstfsz  POSTINC0, a                 ; sign
    bra     fixpid_subtract
    movf    POSTINC0, w, a              ; padding
    movf    _fixpid_kernel + 4, w, b
    addwf   _fixpid_kernel, f, b
    movf    PRODL, w, a
    addwfc  _fixpid_kernel + 1, f, b
    movf    PRODH, w, a
    addwfc  _fixpid_kernel + 2, f, b
    movlw   0
    addwfc  _fixpid_kernel + 3, f, b
    return
fixpid_subtract:
    movf    POSTINC0, w, a              ; padding
    movf    _fixpid_kernel + 4, w, b
    subwf   _fixpid_kernel, f, b
    movf    PRODL, w, a
    subwfb  _fixpid_kernel + 1, f, b
    movf    PRODH, w, a
    subwfb  _fixpid_kernel + 2, f, b
    movlw   0
    subwfb  _fixpid_kernel + 3, f, b
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
    banksel _fixpid_kernel
    btfsc   _fixpid_kernel + 3, 7, b
    bra     fixpid_negative
    movf    _fixpid_kernel + 3, w, b
    bz      fixpid_shift
fixpid_highest:
    setf    _fixpid_kernel, b       ; (2^24 - 1) / 16
    setf    _fixpid_kernel + 1, b
    movlw   0x0F
    movwf   _fixpid_kernel + 2, b
    clrf    _fixpid_kernel + 3, b
    retlw   0x01
fixpid_negative:
    incfsz  _fixpid_kernel + 3, w, b
    bra     fixpid_lowest
    movf    _fixpid_kernel, w, b
    iorwf   _fixpid_kernel + 1, w, b
    iorwf   _fixpid_kernel + 2, w, b
    bz      fixpid_lowest
    movlw   15
    addwf   _fixpid_kernel, f, b
    movlw   0
    addwfc  _fixpid_kernel + 1, f, b
    addwfc  _fixpid_kernel + 2, f, b
    addwfc  _fixpid_kernel + 3, f, b
    rcall   fixpid_shift
    retlw   0x80
fixpid_lowest:
    rcall   fixpid_highest
    negf    _fixpid_kernel, b
    comf    _fixpid_kernel + 1, f, b
    comf    _fixpid_kernel + 2, f, b
    setf    _fixpid_kernel + 3, b
    retlw   0x81
fixpid_shift:
    swapf   _fixpid_kernel, f, b
    swapf   _fixpid_kernel + 1, w, b
    xorwf   _fixpid_kernel, w, b
    andlw   0xF0
    xorwf   _fixpid_kernel, f, b
    swapf   _fixpid_kernel + 1, f, b
    swapf   _fixpid_kernel + 2, w, b
    xorwf   _fixpid_kernel + 1, w, b
    andlw   0xF0
    xorwf   _fixpid_kernel + 1, f, b
    swapf   _fixpid_kernel + 2, w, b
    andlw   0x0F
    btfsc   _fixpid_kernel + 3, 7, b
    iorlw   0xF0
    movwf   _fixpid_kernel + 2, b
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
