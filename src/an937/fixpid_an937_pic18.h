// SPDX-License-Identifier: MIT
// The numbers of fixpid_an937_arith.h for a PIC18 under SDCC, in sign-magnitude
// as fixpid_an937_narrow.h has them, with the products in assembly or in C. The
// sign is the lowest bit of its byte, whatever the others are.
//
// Macros instead of functions: SDCC's pic16 port keeps a copy of each inline
// function and reaches the numbers through a pointer; in C a step takes 408
// cycles so and 609 with the functions. The operands have fixed addresses, so a
// function of one controller must not interrupt another's.
#ifndef FIXPID_AN937_PIC18_H
#define FIXPID_AN937_PIC18_H
#include <stdint.h>

#include "fixpid_an937.h"

// What a step works on: a local variable, or one that has a place, which SDCC
// need not save.
#ifdef FIXPID_AN937_SIGNALS_PLACE
#define fixpid_an937_word                                                      \
    FIXPID_JOINED(fixpid_an937_word,                                           \
                  FIXPID_PLACE_SUFFIX(FIXPID_AN937_SIGNALS_PLACE))
extern FIXPID_DATA uint16_t FIXPID_AN937_SIGNALS_PLACE fixpid_an937_word;
#define FIXPID_AN937_WORD fixpid_an937_word
#else
#define FIXPID_AN937_WORD uint16_t fixpid_an937_word
#endif

#define fixpid_number_set(number, from)                                        \
    do {                                                                       \
        FIXPID_AN937_WORD = (uint16_t)(from);                                  \
        (number)->parts.negative = 0;                                          \
        if (((uint8_t)(fixpid_an937_word >> 8) & 0x80u) != 0u) {               \
            (number)->parts.negative = 1;                                      \
            fixpid_an937_word = fixpid_negated(fixpid_an937_word);             \
        }                                                                      \
        (number)->parts.magnitude = fixpid_an937_word;                         \
    } while (0)

#define fixpid_number_value(number)                                            \
    ((((number)->parts.negative & 1u) != 0u)                                   \
         ? (-(int32_t)(number)->parts.magnitude)                               \
         : ((int32_t)(number)->parts.magnitude))

#define fixpid_number_difference(number, left, right)                          \
    do {                                                                       \
        FIXPID_AN937_WORD = (uint16_t)((left) - (right));                      \
        (number)->parts.negative = 0;                                          \
        if ((left) < (right)) {                                                \
            (number)->parts.negative = 1;                                      \
            fixpid_an937_word = fixpid_negated(fixpid_an937_word);             \
        }                                                                      \
        (number)->parts.magnitude = fixpid_an937_word;                         \
    } while (0)

#define fixpid_number_add(number, addend, limit, flags)                        \
    do {                                                                       \
        FIXPID_AN937_WORD = (number)->parts.magnitude;                         \
        if ((((number)->parts.negative ^ (addend)->parts.negative) & 1u) ==    \
            0u) {                                                              \
            fixpid_an937_word =                                                \
                (uint16_t)(fixpid_an937_word + (addend)->parts.magnitude);     \
            if (fixpid_an937_word < (addend)->parts.magnitude) {               \
                fixpid_an937_word = UINT16_MAX;                                \
                *(flags) = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;             \
            }                                                                  \
        } else if (fixpid_an937_word >= (addend)->parts.magnitude) {           \
            fixpid_an937_word =                                                \
                (uint16_t)(fixpid_an937_word - (addend)->parts.magnitude);     \
        } else {                                                               \
            fixpid_an937_word =                                                \
                (uint16_t)((addend)->parts.magnitude - fixpid_an937_word);     \
            (number)->parts.negative ^= 1u;                                    \
        }                                                                      \
        if (fixpid_an937_word > (limit)) {                                     \
            fixpid_an937_word = (limit);                                       \
            *(flags) = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;                 \
        }                                                                      \
        (number)->parts.magnitude = fixpid_an937_word;                         \
    } while (0)

// The operands of the products, and of the sum that they make.
struct fixpid_an937_operands {
    int32_t sum;
    union {
        FIXPID_DATA const union fixpid_an937_number *number; // until it is read
        uint16_t low;                                        // product
    } at;
};
extern FIXPID_DATA struct fixpid_an937_operands fixpid_an937_operands;

// sum = number * gain, which lies 12 bytes on
void fixpid_an937_product(void);
#define fixpid_number_term(gain, factor)                                       \
    (fixpid_an937_operands.at.number = (factor), fixpid_an937_product(),       \
     fixpid_an937_operands.sum)

// The address of an object at `__at(address)`, and one beyond all where it has
// no place. The smallest access RAM of a PIC18 ends at 0x5F, and the object has
// 24 bytes.
#define FIXPID_ADDRESS_OF___at(address) (address)
#define FIXPID_ADDRESS_OF_ 0xFFFF
#if FIXPID_JOINED(FIXPID_ADDRESS_OF, FIXPID_AN937_PLACE) <= 0x48
#define FIXPID_AN937_IN_ACCESS_RAM
#endif

// sum = the three terms of the object, or of the controller whose first number
// `number` points at, limited and divided by 16. Returns SUM_SATURATED and
// SUM_NEGATIVE. The function's name has the object's and its place, so that the
// sources link only if they agree.
#ifdef FIXPID_AN937_OBJECT
#define fixpid_an937_divided_sum                                               \
    FIXPID_JOINED(fixpid_an937_divided_sum_of, FIXPID_AN937_NAMED)
#define fixpid_an937_point_at(self) ((void)(self))
#else
#define fixpid_an937_point_at(self)                                            \
    (fixpid_an937_operands.at.number = &(self)->error)
#endif
uint8_t fixpid_an937_divided_sum(void);

#define fixpid_an937_output(self, flags)                                       \
    (fixpid_an937_point_at(self),                                              \
     *(flags) = (uint8_t)(fixpid_an937_divided_sum() | *(flags)),              \
     fixpid_an937_operands.sum)

#endif
