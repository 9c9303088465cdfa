// SPDX-License-Identifier: MIT
// The numbers of fixpid_an937_arith.h for a PIC18 under SDCC: in
// sign-magnitude, as fixpid_an937_narrow.h has them, with the products in
// assembly.
//
// Macros instead of functions: SDCC's pic16 port would keep a copy of each, and
// reach the numbers through a pointer. The assembly finds the numbers by FSR0,
// with the next one 4 bytes on and the gain of each 12; its operands have fixed
// addresses, so a function of one controller must not interrupt another's.
#ifndef FIXPID_AN937_PIC18_H
#define FIXPID_AN937_PIC18_H
#include <stdint.h>

#include "fixpid_an937.h"

struct fixpid_an937_operands {
    int32_t sum;
    uint16_t low; // product
};
extern FIXPID_DATA struct fixpid_an937_operands fixpid_an937_operands;

void fixpid_an937_product(void);   // sum = the number at FSR0 times its gain
void fixpid_an937_products(void);  // sum = that of the three from FSR0 on
uint8_t fixpid_an937_divide(void); // sum = limited sum / 16; returns flags

extern __sfr __at(0xFE9) FSR0L;
extern __sfr __at(0xFEA) FSR0H;

#define fixpid_an937_point_at(number)                                          \
    (FSR0L = (uint8_t)(uint16_t)(number),                                      \
     FSR0H = (uint8_t)((uint16_t)(number) >> 8))

#define fixpid_number_set(number, from)                                        \
    do {                                                                       \
        uint16_t magnitude_ = (uint16_t)(from);                                \
        (number)->parts.negative = 0;                                          \
        if (((uint8_t)(magnitude_ >> 8) & 0x80u) != 0u) {                      \
            (number)->parts.negative = 1;                                      \
            magnitude_ = fixpid_negated(magnitude_);                           \
        }                                                                      \
        (number)->parts.magnitude = magnitude_;                                \
    } while (0)

#define fixpid_number_value(number)                                            \
    (((number)->parts.negative != 0u) ? (-(int32_t)(number)->parts.magnitude)  \
                                      : ((int32_t)(number)->parts.magnitude))

#define fixpid_number_difference(number, left, right)                          \
    do {                                                                       \
        uint16_t difference_ = (uint16_t)((left) - (right));                   \
        (number)->parts.negative = 0;                                          \
        if ((left) < (right)) {                                                \
            (number)->parts.negative = 1;                                      \
            difference_ = fixpid_negated(difference_);                         \
        }                                                                      \
        (number)->parts.magnitude = difference_;                               \
    } while (0)

#define fixpid_number_add(number, addend, limit, flags)                        \
    do {                                                                       \
        uint16_t sum_ = (number)->parts.magnitude;                             \
        if ((number)->parts.negative == (addend)->parts.negative) {            \
            sum_ = (uint16_t)(sum_ + (addend)->parts.magnitude);               \
            if (sum_ < (addend)->parts.magnitude) {                            \
                sum_ = UINT16_MAX;                                             \
                *(flags) = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;             \
            }                                                                  \
        } else if (sum_ >= (addend)->parts.magnitude) {                        \
            sum_ = (uint16_t)(sum_ - (addend)->parts.magnitude);               \
        } else {                                                               \
            sum_ = (uint16_t)((addend)->parts.magnitude - sum_);               \
            (number)->parts.negative ^= 1u;                                    \
        }                                                                      \
        if (sum_ > (limit)) {                                                  \
            sum_ = (limit);                                                    \
            *(flags) = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;                 \
        }                                                                      \
        (number)->parts.magnitude = sum_;                                      \
    } while (0)

// The gain is where the assembly finds it.
#define fixpid_number_term(gain, number)                                       \
    (fixpid_an937_point_at(number), fixpid_an937_product(),                    \
     fixpid_an937_operands.sum)

#define fixpid_an937_output(self, flags)                                       \
    (fixpid_an937_point_at(&(self)->error), fixpid_an937_products(),           \
     *(flags) = (uint8_t)(fixpid_an937_divide() | *(flags)),                   \
     fixpid_an937_operands.sum)

#endif
