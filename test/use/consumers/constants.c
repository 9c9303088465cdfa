// SPDX-License-Identifier: MIT
// Compiled as C and as C++. With BEYOND, a constant out of range, or WRONG, a
// number that is added to each that is expected, it does not compile.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"

#ifndef WRONG
#define WRONG 0
#endif
#ifndef BEYOND
#define BEYOND 0
#endif

// In static initialisers, of the types that they are for.
extern const struct fixpid_pid_gains gains;
const struct fixpid_pid_gains gains = {FIXPID_PID_KP(2.5), BEYOND, 0, 0};
extern const uint8_t gain_q4;
const uint8_t gain_q4 = FIXPID_AN937_GAIN(6.0);
extern const uint32_t rate;
const uint32_t rate = FIXPID_SLEW_RATE(10, 4);

#define IS(name, constant, value)                                              \
    extern const unsigned name;                                                \
    const unsigned name = FIXPID_CHECKED(1, (constant) == (value) + WRONG)

IS(is_0, FIXPID_PID_KP(0), 0);
IS(is_1, FIXPID_PID_KP(2.5), 640);
IS(is_2, FIXPID_PID_KP(127.998), 32767);
IS(is_3, FIXPID_PID_KI(0, 100), 0);
IS(is_4, FIXPID_PID_KI(0.5, 100), 83886);
IS(is_5, FIXPID_PID_KI(127.99609375, 1), 2147418112);
IS(is_6, FIXPID_PID_KD(0, 1, 0), 0);
IS(is_7, FIXPID_PID_KD(0.1, 100, 2), 640);
IS(is_8, FIXPID_PID_KD(125.998, 1, 0), 32255);
IS(is_9, FIXPID_PID_KI(0.5, FIXPID_PERIOD_MS(10)), 83886);
IS(is_10, FIXPID_PID_KD(0.1, FIXPID_PERIOD_MS(10), 2), 640);
IS(is_11, FIXPID_PID_TI(2, 30, FIXPID_PERIOD_MS(100)), 111848);
IS(is_12, FIXPID_PID_TI(2, 30, 10), 111848);
IS(is_13, FIXPID_PID_TI(0, 10, 1), 0);
IS(is_14, FIXPID_PID_TI(1, 2, 0.01), 838860800);
IS(is_15, FIXPID_PID_TD(1.5, 3, 100, 4), 7200);
IS(is_16, FIXPID_PID_TD(0, 3, 100, 4), 0);
IS(is_17, FIXPID_PID_TD(2, 0.5, 100, 7), 200);
IS(is_18, FIXPID_SLEW_RATE(0, 100), 0);
IS(is_19, FIXPID_SLEW_RATE(0, 0.001), 0);
IS(is_20, FIXPID_SLEW_RATE(0.5, 65536), 1);
IS(is_21, FIXPID_SLEW_RATE(10, 4), 163840);
IS(is_22, FIXPID_SLEW_RATE(2.5, 65536), 3);
IS(is_23, FIXPID_SLEW_RATE(10, FIXPID_PERIOD_MS(250)), 163840);
IS(is_24, FIXPID_SLEW_RATE(8388607, 65536), 8388607);
IS(is_25, FIXPID_SLEW_RATE(65535, 1), 4294901760);
IS(is_26, FIXPID_SLEW_RATE(65535.5, 1), 4294934528);
IS(is_27, FIXPID_AN937_GAIN(0.0), 0);
IS(is_28, FIXPID_AN937_GAIN(6.0), 96);
IS(is_29, FIXPID_AN937_GAIN(15.9375), 255);
