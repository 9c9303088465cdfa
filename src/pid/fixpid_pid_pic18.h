// SPDX-License-Identifier: MIT
// The functions of fixpid_signed.h for a PIC18 under SDCC: as macros,
// because its pic16 port keeps a copy of each `static inline` function and
// passes arguments through memory; and the longer ones in assembly. Its
// operands have fixed addresses, so a function of one controller must not
// interrupt another's.
#ifndef FIXPID_PID_PIC18_H
#define FIXPID_PID_PIC18_H
#include <stdint.h>

#include "../common/fixpid_bits.h"
#include "fixpid_pid.h"

#ifdef FIXPID_PID_OPERANDS_PLACE // sources that disagree do not link
#define fixpid_pid_operands                                                    \
    FIXPID_JOINED(fixpid_pid_operands,                                         \
                  FIXPID_PLACE_SUFFIX(FIXPID_PID_OPERANDS_PLACE))
#else
#define FIXPID_PID_OPERANDS_PLACE
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
void fixpid_pid_add_byte(void);    // wide += right; right = wide; wide >>= 8
void fixpid_pid_shift_right(void); // wide >>= right & 7

#define add32_apart fixpid_add32

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
#define FIXPID_HAS_ADD_PRODUCT
#define add_product(a, fraction, factor, x, fine)                              \
    (fixpid_pid_operands.left.gain = (factor),                                 \
     fixpid_pid_operands.right.value = (x),                                    \
     fixpid_pid_operands.wide_right = (a), fixpid_pid_mul16(),                 \
     (void)((fine) ? (fixpid_pid_operands.right.shift = *(fraction),           \
                      fixpid_pid_add_byte(),                                   \
                      *(fraction) = fixpid_pid_operands.right.shift)           \
                   : 0u),                                                      \
     fixpid_pid_add32_sat(), fixpid_pid_operands.wide)
#define shift_right_by(x, places)                                              \
    (fixpid_pid_operands.wide = (x),                                           \
     fixpid_pid_operands.right.shift = (places), fixpid_pid_shift_right(),     \
     fixpid_pid_operands.wide)

#endif
