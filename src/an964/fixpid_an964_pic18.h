// SPDX-License-Identifier: MIT
// The products of fixpid_an964_arith.h in assembly for a PIC18 under SDCC.
//
// SDCC passes arguments on a software stack, so the operands have fixed
// addresses, and a function of one controller must not interrupt another's.
// Macros instead of functions: SDCC's pic16 port would keep a copy of each.
#ifndef FIXPID_AN964_PIC18_H
#define FIXPID_AN964_PIC18_H
#include <stdint.h>

#include "fixpid.h"

struct fixpid_an964_operands {
    uint16_t gain;
    uint16_t magnitude;
    uint16_t quotient;
    uint8_t round_up;
    uint8_t limit;
};
extern FIXPID_DATA struct fixpid_an964_operands fixpid_an964_operands;

void fixpid_an964_divide_16(void);   // by a magnitude of one byte
void fixpid_an964_divide_32(void);   // likewise, rounded and limited
void fixpid_an964_divide_1024(void); // by one of two bytes

#define fixpid_10x7_div16(factor, byte)                                        \
    (fixpid_an964_operands.magnitude = (byte),                                 \
     fixpid_an964_operands.gain = (factor), fixpid_an964_divide_16(),          \
     fixpid_an964_operands.quotient)

#define fixpid_10x8_div32(factor, byte, up, most)                              \
    (fixpid_an964_operands.magnitude = (byte),                                 \
     fixpid_an964_operands.gain = (factor),                                    \
     fixpid_an964_operands.round_up = (up),                                    \
     fixpid_an964_operands.limit = (most), fixpid_an964_divide_32(),           \
     (uint8_t)fixpid_an964_operands.quotient)

#define fixpid_10x14_div1024(factor, word)                                     \
    (fixpid_an964_operands.magnitude = (word),                                 \
     fixpid_an964_operands.gain = (factor), fixpid_an964_divide_1024(),        \
     fixpid_an964_operands.quotient)

#endif
