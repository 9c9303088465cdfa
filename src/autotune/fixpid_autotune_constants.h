// SPDX-License-Identifier: MIT
// The constants of fixpid_autotune's result, mantissa * 2^exponent: the
// mantissa is the nearest one of 32768 to 65535. Those of a regression have
// more digits than their names. It was repeated after these were chosen, by
// tools/lib/autotune/refit of commit 8668fb10. Its numbers differ a little from
// these, and loops with them were not better: so these stay.
#ifndef FIXPID_AUTOTUNE_CONSTANTS_H
#define FIXPID_AUTOTUNE_CONSTANTS_H
#include <stdint.h>

#include "fixpid_autotune_arith.h"

// A number with this bit is one of these, and not one of a sheet.
#define CONSTANT 0x40u

enum constant_name {
    ONE = CONSTANT,
    TWO,
    FOUR,
    HALF,
    QUARTER,
    C1_32ND,
    C1_256TH,
    C15_16THS,
    C63_64THS,
    C0_03,
    C0_05,
    C0_06,
    C0_1,
    C0_12,
    C0_2,
    C0_216,
    C0_3,
    C0_31,
    C0_4,
    C0_45,
    C0_46,
    C0_47,
    C0_53,
    C0_6,
    C0_64,
    C0_75,
    C0_8,
    C0_808,
    C0_875,
    C0_9,
    C1_03,
    C1_1,
    C1_16,
    C1_188,
    C1_193,
    C1_2,
    C1_5,
    C2_068,
    C2_272,
    C2_828,
    C3_204,
    C4_382,
    C4_608,
    C4_627,
    C5_285,
    C5_488,
    C6,
    C6_815,
    C9_462,
    C10,
    C11_667,
    C11_75,
    C22_4,
    C26_16,
    C28_086,
    C45_48,
    C64
};

static const struct number16 constants[] FIXPID_AUTOTUNE_FLASH = {
    {32768u, -15}, // 1: exact
    {32768u, -14}, // 2: exact
    {32768u, -13}, // 4: exact
    // 1/2: exact; two processes if their slopes are so far apart,
    // by trial on random plants
    {32768u, -16},
    {32768u, -17}, // 1/4: exact
    // 1/32: exact: what the mean outputs leave open, of the relay
    {32768u, -20},
    {32768u, -23}, // 1/256: exact: where the search for R ends
    {61440u, -16}, // 15/16: exact: its steps
    {64512u, -16}, // 63/64: exact: below the 1 of a pure delay
    {62915u, -21}, // 0.03: R of an integrator, by trial on random plants
    // 0.05: derived: psi(R), one lag's slope over the one of its wave
    {52429u, -20},
    // 0.06: R of a process that runs away, by trial on random plants
    {62915u, -20},
    {52429u, -19}, // 0.1: AMIGO (Astrom and Hagglund 2006): TI
    // 0.12: most of BEND that a PID makes use of, by trial on random plants
    {62915u, -19},
    // 0.2: derived: f(R), the roundness of one lag; AMIGO (Astrom and Hagglund
    // 2006): KP; regression, integrator: V in E
    {52429u, -18},
    {56623u, -18}, // 0.216: regression, integrator: V
    // 0.3: derived: f(R), and least of ROUND; AMIGO (Astrom and Hagglund 2006):
    // TD; CHI in LIMIT
    {39322u, -17},
    {40632u, -17}, // 0.31: derived: psi(R)
    {52429u, -17}, // 0.4: AMIGO (Astrom and Hagglund 2006): TI
    {58982u, -17}, // 0.45: AMIGO (Astrom and Hagglund 2006): KP
    // 0.46: regression, integrator: where a wave is flatter than an
    // integrator's
    {60293u, -17},
    {61604u, -17}, // 0.47: regression, lag: most of E
    // 0.53: derived: ROUND of an integrator's wave, where one lag ends
    {34734u, -16},
    {39322u, -16}, // 0.6: least delay, by trial on random plants
    {41943u, -16}, // 0.64: derived: psi(R)
    {49152u, -16}, // 0.75: regression: most of CHI
    {52429u, -16}, // 0.8: AMIGO (Astrom and Hagglund 2006): TI
    {52953u, -16}, // 0.808: regression, integrator: FLATTER
    {57344u, -16}, // 0.875: regression, integrator: most of ROUND
    {58982u, -16}, // 0.9: regression, lag: where a wave is flatter than a lag's
    {33751u, -15}, // 1.03: derived: Z of one lag, where it ends
    // 1.1: what ROUND may lie below f(R), by trial on random plants
    {36045u, -15},
    {38011u, -15}, // 1.16: regression, integrator: Q
    {38935u, -15}, // 1.188: regression, lag: Q
    {39086u, -15}, // 1.193: regression, lag: R
    {39322u, -15}, // 1.2: regression, integrator: least delay of a flatter wave
    // 1.5: most of CHI that is a lag or an integrator,
    // by trial on random plants
    {49152u, -15},
    {33882u, -14}, // 2.068: regression, lag: I
    {37224u, -14}, // 2.272: regression, lag: FLATTER
    {46334u, -14}, // 2.828: regression, lag: R R
    {52494u, -14}, // 3.204: regression, lag
    {35898u, -13}, // 4.382: regression, lag: E
    {37748u, -13}, // 4.608: regression, integrator
    {37905u, -13}, // 4.627: regression, integrator: I
    {43295u, -13}, // 5.285: regression, lag: R CHI
    {44957u, -13}, // 5.488: regression, lag: CHI CHI
    // 6: TI of an integrator with a lag, by trial on random plants
    {49152u, -13},
    {55829u, -13}, // 6.815: regression, lag: CHI
    {38757u, -12}, // 9.462: regression, integrator: CHI CHI
    // 10: KP of an integrator with a lag, by trial on random plants
    {40960u, -12},
    {47790u, -12}, // 11.667: regression, lag: E CHI
    {48128u, -12}, // 11.75: regression, integrator: CHI
    {45875u, -11}, // 22.4: regression, integrator: E E
    {53576u, -11}, // 26.16: regression, integrator: E
    {57520u, -11}, // 28.086: regression, lag: R E
    {46572u, -10}, // 45.48: regression, integrator: E CHI
    {32768u, -9},  // 64: exact: a quarter of 256
};

#endif
