// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

// This file is empty for other chips.
#if defined(__SDCC_pic16)
#include <stddef.h>

#include "fixpid_an937_arith.h"

FIXPID_DATA struct fixpid_an937_operands fixpid_an937_operands;
#ifdef FIXPID_AN937_SIGNALS_PLACE
FIXPID_DATA uint16_t FIXPID_AN937_SIGNALS_PLACE fixpid_an937_word;
#endif

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

// fixpid_an937.h states the object's size, for users who give it a place.
#define OBJECT_BYTES 24u
typedef char fixpid_object_has_another_size
    [(sizeof(struct fixpid_an937) == OBJECT_BYTES) ? 1 : -1];

#if !defined(FIXPID_NO_ASSEMBLY)

#define FSR0H 0xFEA
#define FSR0L 0xFE9
#define POSTINC0 0xFEE
#define PLUSW0 0xFEB
#define PRODH 0xFF4
#define PRODL 0xFF3

// clang-format off

// The addresses of the operands' members.
#define SUM _fixpid_an937_operands
#define LOW _fixpid_an937_operands + 4

// Points FSR0 at the first number.
#ifdef FIXPID_AN937_OBJECT
#define ERROR FIXPID_JOINED(, FIXPID_AN937_OBJECT)
#define POINT_AT_ERROR_LOW lfsr 0, ERROR
#define POINT_AT_ERROR_HIGH
#else
#define POINT_AT_ERROR_LOW movff LOW, FSR0L
#define POINT_AT_ERROR_HIGH movff LOW + 1, FSR0H
#endif

// An object in access RAM has products of its own, below, which go on in the
// middle of this function.
#if defined(FIXPID_AN937_OBJECT) && defined(FIXPID_AN937_IN_ACCESS_RAM)
#define DIVIDED_SUM fixpid_an937_divided_sum_by_fsr0
#else
#define DIVIDED_SUM fixpid_an937_divided_sum
#endif

// sum = 0, then three times sum += gain * number. A number is its magnitude, low
// byte first, and its sign; the next is 4 bytes on, its gain 12. The low product
// waits in `low` until the high one is added to its upper byte.
//
// Then the sum, limited, by 16: W gets SUM_SATURATED (0x01) and SUM_NEGATIVE
// (0x80). A negative sum is rounded toward zero by adding 15; it is limited if its
// uppermost byte is below 0xFF, or the others are 0.
// Deviation 40 lines: each is one instruction
uint8_t DIVIDED_SUM(void) __naked
{
    __asm
    banksel SUM
    POINT_AT_ERROR_LOW
    POINT_AT_ERROR_HIGH
    clrf    SUM, b
    clrf    SUM + 1, b
    clrf    SUM + 2, b
    clrf    SUM + 3, b
    rcall   fixpid_add_product
    rcall   fixpid_add_product
    rcall   fixpid_add_product
fixpid_divide:
    btfsc   SUM + 3, 7, b
    bra     fixpid_negative
    movf    SUM + 3, w, b
    bz      fixpid_shift
fixpid_highest:
    setf    SUM, b       ; (2^24 - 1) / 16
    setf    SUM + 1, b
    movlw   0x0F
    movwf   SUM + 2, b
    clrf    SUM + 3, b
    retlw   0x01
fixpid_lowest:
    rcall   fixpid_highest
    negf    SUM, b
    comf    SUM + 1, f, b
    comf    SUM + 2, f, b
    setf    SUM + 3, b
    retlw   0x81
fixpid_negative:
    incfsz  SUM + 3, w, b
    bra     fixpid_lowest
    movf    SUM, w, b
    iorwf   SUM + 1, w, b
    iorwf   SUM + 2, w, b
    bz      fixpid_lowest
    movlw   15
    addwf   SUM, f, b
    movlw   0
    addwfc  SUM + 1, f, b
    addwfc  SUM + 2, f, b
    addwfc  SUM + 3, f, b
    rcall   fixpid_shift
    retlw   0x80
fixpid_shift:
    swapf   SUM, f, b
    swapf   SUM + 1, w, b
    xorwf   SUM, w, b
    andlw   0xF0
    xorwf   SUM, f, b
    swapf   SUM + 1, f, b
    swapf   SUM + 2, w, b
    xorwf   SUM + 1, w, b
    andlw   0xF0
    xorwf   SUM + 1, f, b
    swapf   SUM + 2, w, b
    andlw   0x0F
    btfsc   SUM + 3, 7, b
    iorlw   0xF0
    movwf   SUM + 2, b
    retlw   0
fixpid_add_product:
    movlw   12
    movf    PLUSW0, w, a                ; gain
    mulwf   POSTINC0, a                 ; low byte
    movff   PRODL, LOW
    movff   PRODH, LOW + 1
    mulwf   POSTINC0, a                 ; high byte
    movf    LOW + 1, w, b
    addwf   PRODL, f, a
    movlw   0
    addwfc  PRODH, f, a
    btfsc   POSTINC0, 0, a              ; sign
    bra     fixpid_subtract
    movf    POSTINC0, w, a              ; padding
    movf    LOW, w, b
    addwf   SUM, f, b
    movf    PRODL, w, a
    addwfc  SUM + 1, f, b
    movf    PRODH, w, a
    addwfc  SUM + 2, f, b
    movlw   0
    addwfc  SUM + 3, f, b
    return
fixpid_subtract:
    movf    POSTINC0, w, a              ; padding
    movf    LOW, w, b
    subwf   SUM, f, b
    movf    PRODL, w, a
    subwfb  SUM + 1, f, b
    movf    PRODH, w, a
    subwfb  SUM + 2, f, b
    movlw   0
    subwfb  SUM + 3, f, b
    return
    __endasm;
}

void fixpid_an937_product(void) __naked
{
    __asm
    banksel SUM
    movff   LOW, FSR0L
    movff   LOW + 1, FSR0H
    clrf    SUM, b
    clrf    SUM + 1, b
    clrf    SUM + 2, b
    clrf    SUM + 3, b
    goto    fixpid_add_product
    __endasm;
}

#if defined(FIXPID_AN937_OBJECT) && defined(FIXPID_AN937_IN_ACCESS_RAM)

#define ACCUMULATED ERROR + 4
#define DELTA ERROR + 8
#define KP ERROR + 12
#define KI ERROR + 16
#define KD ERROR + 20

// The sum is assigned the first product, which has 24 bits, and negated where the
// error is negative. The others are added or subtracted, low byte first.
// Deviation 40 lines: each is one instruction
uint8_t fixpid_an937_divided_sum(void) __naked
{
    __asm
    banksel SUM
    movf    KP, w, a
    mulwf   ERROR, a
    movff   PRODL, SUM
    movff   PRODH, SUM + 1
    mulwf   ERROR + 1, a
    movf    PRODL, w, a
    addwf   SUM + 1, f, b
    movlw   0
    addwfc  PRODH, w, a
    movwf   SUM + 2, b
    clrf    SUM + 3, b
    btfss   ERROR + 2, 0, a
    bra     fixpid_error_end
    comf    SUM + 1, f, b
    comf    SUM + 2, f, b
    comf    SUM + 3, f, b
    negf    SUM, b
    movlw   0
    addwfc  SUM + 1, f, b
    addwfc  SUM + 2, f, b
    addwfc  SUM + 3, f, b
fixpid_error_end:
    btfsc   ACCUMULATED + 2, 0, a
    bra     fixpid_subtract_accumulated
    movf    KI, w, a
    mulwf   ACCUMULATED, a
    movf    PRODL, w, a
    addwf   SUM, f, b
    movf    PRODH, w, a
    addwfc  SUM + 1, f, b
    movlw   0
    addwfc  SUM + 2, f, b
    addwfc  SUM + 3, f, b
    movf    KI, w, a
    mulwf   ACCUMULATED + 1, a
    movf    PRODL, w, a
    addwf   SUM + 1, f, b
    movf    PRODH, w, a
    addwfc  SUM + 2, f, b
    movlw   0
    addwfc  SUM + 3, f, b
    bra     fixpid_accumulated_end
fixpid_subtract_accumulated:
    movf    KI, w, a
    mulwf   ACCUMULATED, a
    movf    PRODL, w, a
    subwf   SUM, f, b
    movf    PRODH, w, a
    subwfb  SUM + 1, f, b
    movlw   0
    subwfb  SUM + 2, f, b
    subwfb  SUM + 3, f, b
    movf    KI, w, a
    mulwf   ACCUMULATED + 1, a
    movf    PRODL, w, a
    subwf   SUM + 1, f, b
    movf    PRODH, w, a
    subwfb  SUM + 2, f, b
    movlw   0
    subwfb  SUM + 3, f, b
fixpid_accumulated_end:
    btfsc   DELTA + 2, 0, a
    bra     fixpid_subtract_delta
    movf    KD, w, a
    mulwf   DELTA, a
    movf    PRODL, w, a
    addwf   SUM, f, b
    movf    PRODH, w, a
    addwfc  SUM + 1, f, b
    movlw   0
    addwfc  SUM + 2, f, b
    addwfc  SUM + 3, f, b
    movf    KD, w, a
    mulwf   DELTA + 1, a
    movf    PRODL, w, a
    addwf   SUM + 1, f, b
    movf    PRODH, w, a
    addwfc  SUM + 2, f, b
    movlw   0
    addwfc  SUM + 3, f, b
    bra     fixpid_delta_end
fixpid_subtract_delta:
    movf    KD, w, a
    mulwf   DELTA, a
    movf    PRODL, w, a
    subwf   SUM, f, b
    movf    PRODH, w, a
    subwfb  SUM + 1, f, b
    movlw   0
    subwfb  SUM + 2, f, b
    subwfb  SUM + 3, f, b
    movf    KD, w, a
    mulwf   DELTA + 1, a
    movf    PRODL, w, a
    subwf   SUM + 1, f, b
    movf    PRODH, w, a
    subwfb  SUM + 2, f, b
    movlw   0
    subwfb  SUM + 3, f, b
fixpid_delta_end:
    goto    fixpid_divide
    __endasm;
}

#endif

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
        if (((factor).negative & 1u) != 0u) {                                  \
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
