// SPDX-License-Identifier: MIT
// The functions of fixpid_bits.h for SDCC's pic16 port, as macros: it keeps a
// copy of each `static inline` function in flash, and passes its arguments
// through memory.
#ifndef FIXPID_BITS_PIC18_H
#define FIXPID_BITS_PIC18_H

#define fixpid_negated(bits) ((uint16_t)(0u - (bits)))
#define shift_right_floor(x, n) ((x) >> (n))

#endif
