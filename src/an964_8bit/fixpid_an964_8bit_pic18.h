// SPDX-License-Identifier: MIT
// The products of fixpid_an964_8bit_arith.h in assembly for a PIC18 under SDCC.
//
// SDCC passes arguments on a software stack, so the operands have fixed
// addresses, and a function of one controller must not interrupt another's.
// Macros instead of functions: SDCC's pic16 port would keep a copy of each.
#ifndef FIXPID_AN964_8BIT_PIC18_H
#define FIXPID_AN964_8BIT_PIC18_H
#include <stdint.h>

#include "fixpid.h"

struct fixpid_an964_8bit_operands {
    uint8_t magnitude;
    uint8_t round_up;
    uint8_t limit;
};
extern FIXPID_DATA struct fixpid_an964_8bit_operands fixpid_an964_8bit_operands;

// Each computes a quotient of gain * magnitude. The gain is in W, and so is a
// result of one byte.
uint8_t fixpid_an964_8bit_div4(uint8_t gain) __wparam; // rounded and limited
uint8_t fixpid_an964_8bit_div8(uint8_t gain) __wparam; // limited to 127
uint16_t fixpid_an964_8bit_div32(uint8_t gain) __wparam;

#define fixpid_7x7_div4(gain, factor, up, most)                                \
    (fixpid_an964_8bit_operands.magnitude = (factor),                          \
     fixpid_an964_8bit_operands.round_up = (up),                               \
     fixpid_an964_8bit_operands.limit = (most), fixpid_an964_8bit_div4(gain))
#define fixpid_7x7_div8(gain, factor)                                          \
    (fixpid_an964_8bit_operands.magnitude = (factor),                          \
     fixpid_an964_8bit_div8(gain))
#define fixpid_7x7_div32(gain, factor)                                         \
    (fixpid_an964_8bit_operands.magnitude = (factor),                          \
     fixpid_an964_8bit_div32(gain))

#endif
