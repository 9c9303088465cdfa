// SPDX-License-Identifier: MIT
// The arithmetic of each controller by itself: all operands of a row, digested
// where they are computed. The same source runs on a chip, in the form under
// test, and on the host, in the wide form, whose unit tests are against 64
// bits.
#ifndef ARITH_H
#define ARITH_H
#include <stdint.h>

extern uint16_t arith_row;    // one operand: which is said at each function
extern uint32_t arith_digest; // of the row, after the function

void arith_begin(void);
void arith_add(uint32_t result);

// Before results: of what they are. Nothing on a chip.
#if defined(__SDCC) || defined(__AVR__)
#define ARITH_OPERANDS(a, b)
#else
extern void (*arith_told)(void);  // after each, or null
extern int32_t arith_operands[2]; // of the last one
extern const char *arith_text;    // its expression
#define ARITH_OPERANDS(a, b)                                                   \
    (arith_operands[0] = (int32_t)(a), arith_operands[1] = (int32_t)(b))
#define arith_add(result) (arith_text = #result, arith_add(result))
#endif

void an937_arith(void);      // a gain, and 256 for all magnitudes: 0..511
void an964_arith(void);      // a gain: 0..1023
void an964_8bit_arith(void); // a gain: 0..127
void pid_arith(void);        // the number of a nasty operand: 0..255

#endif
