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

#ifndef __SDCC
extern void (*arith_told)(uint32_t result); // after each, or null
#endif

void arith_begin(void);
void arith_add(uint32_t result);

void an937_arith(void);      // a gain, and 256 for all magnitudes: 0..511
void an964_arith(void);      // a gain: 0..1023
void an964_8bit_arith(void); // a gain: 0..127
void pid_arith(void);        // the number of a nasty operand: 0..255

#endif
