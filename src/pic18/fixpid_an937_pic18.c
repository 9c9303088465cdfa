// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

// This file is empty for other chips.
#if defined(__SDCC_pic16)
#include <stddef.h>

#include "../fixpid_an937_arith.h"

FIXPID_DATA struct fixpid_an937_operands fixpid_an937_operands;

// The layout that the products rely on: each member is where they look.
// Deviation 20.10: the compiler's message shall name the member.
#define CHECK_OFFSET(member, offset)                                           \
    typedef char fixpid_##member##_is_elsewhere                                \
        [(offsetof(struct fixpid_an937, member) == (offset)) ? 1 : -1]
CHECK_OFFSET(error, 0);
CHECK_OFFSET(accumulated_error, 4);
CHECK_OFFSET(delta, 8);
CHECK_OFFSET(kp_q4, 12);
CHECK_OFFSET(ki_q4, 16);
CHECK_OFFSET(kd_q4, 20);

#if !defined(FIXPID_NO_ASSEMBLY)

#define FSR0H 0xFEA
#define FSR0L 0xFE9
#define POSTINC0 0xFEE
#define PLUSW0 0xFEB
#define PRODH 0xFF4
#define PRODL 0xFF3

// clang-format off

// Points FSR0 at the first number.
#ifdef FIXPID_AN937_OBJECT
#define ERROR FIXPID_JOINED(, FIXPID_AN937_OBJECT)
#define POINT_AT_ERROR_LOW lfsr 0, ERROR
#define POINT_AT_ERROR_HIGH
#else
#define POINT_AT_ERROR_LOW movff _fixpid_an937_operands + 4, FSR0L
#define POINT_AT_ERROR_HIGH movff _fixpid_an937_operands + 5, FSR0H
#endif

// sum = 0, then three times sum += gain * number. A number is its magnitude, low
// byte first, and its sign; the next is 4 bytes on, its gain 12. The low product
// waits in `low` until the high one is added to its upper byte.
//
// Then the sum, limited, by 16: W gets SUM_SATURATED (0x01) and SUM_NEGATIVE
// (0x80). A negative sum is rounded toward zero by adding 15; it is limited if its
// uppermost byte is below 0xFF, or the others are 0.
// Deviation 40 lines: each is one instruction
uint8_t fixpid_an937_divided_sum(void) __naked
{
    __asm
    banksel _fixpid_an937_operands
    POINT_AT_ERROR_LOW
    POINT_AT_ERROR_HIGH
    clrf    _fixpid_an937_operands, b
    clrf    _fixpid_an937_operands + 1, b
    clrf    _fixpid_an937_operands + 2, b
    clrf    _fixpid_an937_operands + 3, b
    rcall   fixpid_add_product
    rcall   fixpid_add_product
    rcall   fixpid_add_product
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
fixpid_lowest:
    rcall   fixpid_highest
    negf    _fixpid_an937_operands, b
    comf    _fixpid_an937_operands + 1, f, b
    comf    _fixpid_an937_operands + 2, f, b
    setf    _fixpid_an937_operands + 3, b
    retlw   0x81
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

void fixpid_an937_product(void) __naked
{
    __asm
    banksel _fixpid_an937_operands
    movff   _fixpid_an937_operands + 4, FSR0L
    movff   _fixpid_an937_operands + 5, FSR0H
    clrf    _fixpid_an937_operands, b
    clrf    _fixpid_an937_operands + 1, b
    clrf    _fixpid_an937_operands + 2, b
    clrf    _fixpid_an937_operands + 3, b
    goto    fixpid_add_product
    __endasm;
}

// clang-format on

#else

#define SUM fixpid_an937_operands.sum
#define SUM_MAX INT32_C(0xFFFFFF) // 24 bits
#define NUMBER fixpid_an937_operands.at.number

// (SDCC does not follow a pointer that is a member without a copy of it.)
#ifdef FIXPID_AN937_OBJECT
#define SELF FIXPID_AN937_OBJECT
#define LOCAL_SELF
#else
#define SELF (*self)
#define LOCAL_SELF                                                             \
    FIXPID_DATA const struct fixpid_an937 *const self =                        \
        (FIXPID_DATA const struct fixpid_an937 *)NUMBER;
#endif

// A product is put together here, because shifts and casts would copy it twice.
static FIXPID_DATA union {
    int32_t all;
    struct {
        uint8_t lowest;
        uint16_t middle;
        uint8_t highest;
    } bytes;
} product;

// sum += gain * factor (its parts), from two 8 x 8 products; the upper one and
// what the lower one carries into it are at most 65025 + 254. SDCC finds its
// multiplier only without a cast, and copies the operands of what is not a
// macro.
#define ADD_PRODUCT(sum, gain, factor)                                         \
    do {                                                                       \
        const uint8_t low_byte = (uint8_t)((factor).magnitude & 0xFFu);        \
        const uint16_t low = (gain)*low_byte;                                  \
        const uint8_t high_byte = (uint8_t)((factor).magnitude >> 8);          \
        const uint16_t high = (gain)*high_byte;                                \
        product.bytes.middle = (uint16_t)(high + (uint8_t)(low >> 8));         \
        product.bytes.lowest = (uint8_t)low;                                   \
        if ((factor).negative != 0u) {                                         \
            (sum) -= product.all;                                              \
        } else {                                                               \
            (sum) += product.all;                                              \
        }                                                                      \
    } while (0)

void fixpid_an937_product(void)
{
    FIXPID_DATA const union fixpid_an937_number *const number = NUMBER;
    const uint8_t gain = ((FIXPID_DATA const uint8_t *)number)[12];

    product.bytes.highest = 0;
    SUM = 0;
    ADD_PRODUCT(SUM, gain, number->parts);
}

uint8_t fixpid_an937_divided_sum(void)
{
    LOCAL_SELF
    int32_t sum = 0;
    uint8_t flags = 0;

    product.bytes.highest = 0;
    ADD_PRODUCT(sum, SELF.kp_q4, SELF.error.parts);
    ADD_PRODUCT(sum, SELF.ki_q4, SELF.accumulated_error.parts);
    ADD_PRODUCT(sum, SELF.kd_q4, SELF.delta.parts);
    if (sum < 0) {
        flags = FIXPID_AN937_SUM_NEGATIVE;
        sum = -sum;
    }
    if ((uint8_t)((uint32_t)sum >> 24) != 0u) {
        flags |= FIXPID_AN937_SUM_SATURATED;
        sum = SUM_MAX;
    }
    sum = (int32_t)((uint32_t)sum >> 4);
    if ((flags & FIXPID_AN937_SUM_NEGATIVE) != 0u) {
        sum = -sum;
    }
    SUM = sum;
    return flags;
}

#endif

#endif
