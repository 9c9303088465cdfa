// SPDX-License-Identifier: MIT
// The functions of fixpid_pid_arith.h for a PIC18 under SDCC: as macros,
// because its pic16 port keeps a copy of each `static inline` function and
// passes arguments through memory; and the longer ones in assembly. Its
// operands have fixed addresses, so a function of one controller must not
// interrupt another's.
#ifndef FIXPID_PID_PIC18_H
#define FIXPID_PID_PIC18_H
#include <stdint.h>

#include "fixpid_pid.h"

#define clamp32(value, low, high)                                              \
    (((value) > (high)) ? (high) : (((value) < (low)) ? (low) : (value)))
#define shift_right_floor(x, n) ((x) >> (n))
#define shift_left(x, n) ((int32_t)((uint32_t)(x) << (n)))
#define complement(x) ((int16_t)(-1 - (x)))

struct fixpid_pid_operands {
    int16_t left; // and result
    int16_t right;
    int32_t wide; // left, and result
    int32_t wide_right;
};
extern FIXPID_DATA struct fixpid_pid_operands FIXPID_PID_OPERANDS_PLACE
    fixpid_pid_operands;

void fixpid_pid_sub16_sat(void); // left -= right
void fixpid_pid_add32_sat(void); // wide += wide_right
void fixpid_pid_mul16(void);     // wide = left * right

#define sub16_sat(a, b)                                                        \
    (fixpid_pid_operands.left = (a), fixpid_pid_operands.right = (b),          \
     fixpid_pid_sub16_sat(), fixpid_pid_operands.left)
#define add32_sat(a, b)                                                        \
    (fixpid_pid_operands.wide = (a), fixpid_pid_operands.wide_right = (b),     \
     fixpid_pid_add32_sat(), fixpid_pid_operands.wide)
#define mul16(gain, x)                                                         \
    (fixpid_pid_operands.left = (int16_t)(gain),                               \
     fixpid_pid_operands.right = (x), fixpid_pid_mul16(),                      \
     fixpid_pid_operands.wide)

// In steps, as SDCC makes a loop of a shift by a variable.
static inline int32_t shift_right_by(int32_t x, uint8_t options)
{
    int32_t quotient = x;

    if ((options & 4u) != 0u) {
        quotient = shift_right_floor(quotient, 4);
    }
    if ((options & 2u) != 0u) {
        quotient = shift_right_floor(quotient, 2);
    }
    if ((options & 1u) != 0u) {
        quotient = shift_right_floor(quotient, 1);
    }
    return quotient;
}

#endif
