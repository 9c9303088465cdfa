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
#define shift_left(x, n) ((int32_t)((uint32_t)(x) << (n)))
#define is_just(limit, counts, integral, fraction)                             \
    (((uint16_t)((limit) ^ (counts)) | (uint16_t)(integral) | (fraction)) == 0u)
#define complement(x) ((int16_t)(-1 - (x)))

#ifdef FIXPID_PID_OPERANDS_PLACED // sources that disagree do not link
#define fixpid_pid_operands fixpid_pid_operands_placed
#endif
union fixpid_pid_operand { // a cast would copy it
    int16_t value;
    uint16_t gain;
    uint8_t shift;
};
struct fixpid_pid_operands {
    union fixpid_pid_operand left; // and result
    union fixpid_pid_operand right;
    int32_t wide; // left, and result
    int32_t wide_right;
};
extern FIXPID_DATA struct fixpid_pid_operands FIXPID_PID_OPERANDS_PLACE
    fixpid_pid_operands;

void fixpid_pid_sub16_sat(void);   // left -= right
void fixpid_pid_add32_sat(void);   // wide += wide_right
void fixpid_pid_mul16(void);       // wide = left * right
void fixpid_pid_shift_right(void); // wide >>= right & 7

// None of these may stand among another one's arguments.
#define sub16_sat(a, b)                                                        \
    (fixpid_pid_operands.left.value = (a),                                     \
     fixpid_pid_operands.right.value = (b), fixpid_pid_sub16_sat(),            \
     fixpid_pid_operands.left.value)
#define add32_sat(a, b)                                                        \
    (fixpid_pid_operands.wide = (a), fixpid_pid_operands.wide_right = (b),     \
     fixpid_pid_add32_sat(), fixpid_pid_operands.wide)
#define mul16(factor, x)                                                       \
    (fixpid_pid_operands.left.gain = (factor),                                 \
     fixpid_pid_operands.right.value = (x), fixpid_pid_mul16(),                \
     fixpid_pid_operands.wide)
#define shift_right_by(x, options)                                             \
    (fixpid_pid_operands.wide = (x),                                           \
     fixpid_pid_operands.right.shift = (options), fixpid_pid_shift_right(),    \
     fixpid_pid_operands.wide)

#endif
