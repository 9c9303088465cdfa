// SPDX-License-Identifier: MIT
// The equations of fixpid_autotune's result, in bytes that `calculate` reads:
// an 8-bit chip holds them in a third of the room that calls would take.
//
// An equation is the number that it sets, and what that becomes: numbers with a
// verb between each two. TIMES and OVER go first; apart from that it goes from
// left to right. ROUNDER: FORM MINUS C1_03 LESSER C0_47, for example, is
// ROUNDER = min(FORM - 1.03, 0.47), and ONE MINUS ONE is 0. A table ends with
// END.
//
// What they compute. x is the deviation of the measurement from the setpoint,
// limited to 32767 on each side.
//
// Noise: the first 34 steps sum up 32 second differences of x, each at most
// 1023. Three standard deviations of the noise are 3 / 64 of that sum, and the
// hysteresis h that it asks for is 1 more.
//
// Relays: the overshoot beyond the hysteresis on a side is in proportion to the
// output left on that side, so a relay is centred where the setpoint divides
// the overshoot. Its amplitude is scaled by the overshoot that `swing` allows
// over the one seen. Its hysteresis is 3/13 of the overshoot that it will make
// (3/16 of the swing), but at least h and what makes a swing of 6 h. It sums up
// x, x while the output is high, and the steps of both, over its cycles.
//
// Slope, of one relay of height D: t1 and t2 are the mean lengths of its
// halves, P is their sum, A the area of a half's lobe, and X what the
// hysteresis adds to a half.
//   M = t1 * t2 / P
//   k = J + X^2 / M^2 / (J + X^2 / M^2 / J), J = 2 A / (D * M^2)
// k is K / T, of the static gain and the lag. Numbers have 16 significant bits
// and a wide exponent; they truncate, and a difference is never below 0.
//
// Shape, where k and M are the means of both relays and W is the swing:
//   round = k M D / 2 / W less its noise    1/2 is a triangle, 1 a square
//   chi   = X / (k M)                       what the hysteresis makes of it
//   q     = |k1 - k2| / k                   above 1/2: two processes
//   r     = k M / (2 K)                     0 is an integrator, 1 a delay
// 1 / K is the difference of the mean outputs over that of the mean
// measurements, if the latter is above 1/16 of the swing; otherwise r is 0. If
// more measurement was held with less output and r is above 0.06, the process
// runs away.
// - There is no PID for a process that runs away, for two processes, for a
//   round of at most 0.3, or for a chi above 1.5.
// - There is no PI for a process that runs away with a q of at most 0.2. Where
//   the slopes differ more, the means shift by themselves, and r is 0.
// - For two processes a PI takes the larger slope as k, and q is 1/2.
// - One lag with dead time has the round f(r) = 1/2 + r^2 (0.3 + 0.2 r). Where
//   that is above 1.1 round + 1 / M + 0.3 chi, the load has moved: r is reduced
//   by a sixteenth until it fits.
// - s is r less what the mean outputs leave open: a quarter of the relay times
//   1/32 and a step per cycle. Below 0.03 it is an integrator.
//
// Model: k' = k / (1 - r (0.05 + r (0.64 + 0.31 r^3))), and unless integrating
// the lag T = k M / (2 s k'). The delay c, for which the gains allow, is M
// times a sum of products of these numbers. Its factors come from a regression:
// the delay that gives a PI a maximum sensitivity of exactly 1.6, on 92 % of
// random integrators and 93 % of random lags.
//
// Gains, with R the robustness in sixteenths, C = c (R + 18) / 32, L = C / 2:
//   PI              kp = (1 / k' + 0.2 c / K) / C    Ti = T + 0.2 c
//   PI, integrator  kp = 1 / (k' C)                  Ti = 4 C
//   PID             kp = 0.2 / K + 0.45 / (k' L)
//                   Ti = L (0.4 L + 0.8 T) / (L + 0.1 T)
//                   Td = L T / (1.2 L + 4 T)         half of AMIGO's
//   PID, integrator kp = (1 + 10 z) 0.45 / (k' L)
//                   Ti = 8 L / (1 + 6 z)             Td = L / 4
// z is the round above 0.53, at most 0.12; 1 / K and T are by s. Where T is
// above 4 C, a PI has Ti = 4 C (1 + 0.2 c k' / K) and ki = 1 / (4 k' C^2). A K
// found too small makes T too short by the same factor; without 0.2 c / K the
// loop would then be little more than an integral, too large by that factor.
#ifndef FIXPID_AUTOTUNE_EQUATIONS_H
#define FIXPID_AUTOTUNE_EQUATIONS_H
#include <stdint.h>

#include "fixpid_autotune_constants.h"

enum verb {
    TIMES = 0x80, // above every number
    OVER,
    PLUS,
    MINUS,
    LESSER, // of both
    GREATER
};

// What the equations are about. Of the relays the second is measured before the
// first: what is kept of it has a 2.
enum number {
    // Of one relay, from its sums.
    CYCLES,
    RELAY,      // D: high - low
    AREA,       // A, of all cycles
    STEPS,      // P, of all cycles
    HIGH_STEPS, // the part of them at high
    LOW_STEPS,  // and at low
    TURNS,      // sum of the deviations at the turns
    MID,        // M
    TURN,       // X
    RAMP,       // J: the slope of a pure integrator
    CURVE,      // X^2 / M^2
    SLOPE_1,    // k
    RELAY_2,
    STEP_2, // the part of a cycle that a step is
    MID_2,
    TURN_2,
    SLOPE_2,

    // Of the wave that both tell of.
    SLOPE,      // k: the mean
    MEAN_MID,   // M: the mean
    QUICKER,    // the larger slope
    SLOWER,     // the smaller one
    SPREAD,     // q
    MID_RISE,   // k M: what a count of output moves in M
    SWING,      // W, of the last cycle
    NOISE,      // what of W is noise
    NET_SWING,  // what of W is not, and a count
    ROUNDNESS,  // round
    HYSTERESIS, // chi
    LIMIT,      // the largest roundness that a lag may have

    // Of the process.
    DRIVEN,        // difference of the mean outputs
    ANSWERED,      // and of the mean measurements
    RATIO,         // r
    LAG_ROUNDNESS, // f(r)
    DOUBT,         // the part of r that the means leave open
    LEAST_RATIO,   // s: r without it
    PSI,           // psi(r)
    TRUE_SLOPE,    // k'
    COARSENESS,    // 1 / M: a step of a half
    NOISE_PART,    // the part of the swing that the noise asks for
    FORM,          // round / f(r)
    ROUNDER,       // than an integrator, or a lag
    FLATTER,
    MORE, // what makes the delay larger, in M
    LESS, // and smaller
    LEAST_DELAY,
    DELAY,    // c
    FLATNESS, // 1 / K by s; 0 of an integrator
    LEVEL,    // 1 / K by r; 0 of an integrator
    GAIN,     // K by r
    LAG,      // T

    // Of the gains. Times are in steps.
    ROBUST,      // (robustness + 18) / 32
    BEND,        // what a lag besides the integrator adds to round
    AMIGO_DELAY, // L
    KP,
    TI,
    TD,
    KI,
    KD,

    FACTOR, // of a later equation
    DIVISOR,
    END
};

// An equation, or a term of it, a line.
// clang-format off

// k = J + X^2 / M^2 / (J + X^2 / M^2 / J), J = 2 A / (D M^2)
static const uint8_t one_relay[] FIXPID_AUTOTUNE_FLASH = {
    LOW_STEPS, STEPS, MINUS, HIGH_STEPS,
    MID,       HIGH_STEPS, TIMES, LOW_STEPS, OVER, STEPS, OVER, CYCLES,
    DIVISOR,   CYCLES, TIMES, RELAY,
    TURN,      TURNS, OVER, DIVISOR,
    FACTOR,    MID, TIMES, MID,
    CURVE,     TURN, TIMES, TURN, OVER, FACTOR,
    DIVISOR,   RELAY, TIMES, FACTOR,
    RAMP,      AREA, TIMES, TWO, OVER, CYCLES, OVER, DIVISOR,
    DIVISOR,   RAMP, PLUS, CURVE, OVER, RAMP,
    SLOPE_1,   RAMP, PLUS, CURVE, OVER, DIVISOR,
    END
};

static const uint8_t keep_second[] FIXPID_AUTOTUNE_FLASH = {
    RELAY_2, RELAY,
    STEP_2,  CYCLES, OVER, STEPS,
    MID_2,   MID,
    TURN_2,  TURN,
    SLOPE_2, SLOPE_1,
    END
};

static const uint8_t wave[] FIXPID_AUTOTUNE_FLASH = {
    SLOPE,      SLOPE_1, TIMES, HALF, PLUS, SLOPE_2, TIMES, HALF,
    MEAN_MID,   MID, TIMES, HALF, PLUS, MID_2, TIMES, HALF,
    QUICKER,    SLOPE_1, GREATER, SLOPE_2,
    SLOWER,     SLOPE_1, LESSER, SLOPE_2,
    SPREAD,     QUICKER, MINUS, SLOWER,
    SPREAD,     SPREAD, OVER, SLOPE,
    MID_RISE,   SLOPE, TIMES, MEAN_MID,
    NET_SWING,  SWING, MINUS, NOISE, PLUS, ONE,
    ROUNDNESS,  MID, TIMES, RELAY, TIMES, SLOPE_1, TIMES, HALF, OVER, NET_SWING,
    HYSTERESIS, TURN, TIMES, HALF, PLUS, TURN_2, TIMES, HALF,
    HYSTERESIS, HYSTERESIS, OVER, MID_RISE,
    LIMIT,      ROUNDNESS, TIMES, C1_1,
                PLUS, ONE, OVER, MEAN_MID,
                PLUS, HYSTERESIS, TIMES, C0_3,
    RATIO,      ONE, MINUS, ONE, // unless the means tell of one
    END
};

// Of two processes, which a PI has to be safe for.
static const uint8_t quicker[] FIXPID_AUTOTUNE_FLASH = {
    SLOPE,  QUICKER,
    SPREAD, HALF,
    END
};

// r = k M / (2 K): 0 is an integrator, 1 a pure delay
static const uint8_t ratio_of_means[] FIXPID_AUTOTUNE_FLASH = {
    RATIO, DRIVEN, OVER, ANSWERED, TIMES, MID_RISE, TIMES, HALF,
           LESSER, C63_64THS,
    END
};

static const uint8_t lag_roundness[] FIXPID_AUTOTUNE_FLASH = {
    FACTOR,        C0_3, PLUS, RATIO, TIMES, C0_2,
    LAG_ROUNDNESS, HALF, PLUS, RATIO, TIMES, RATIO, TIMES, FACTOR,
    END
};

static const uint8_t smaller_ratio[] FIXPID_AUTOTUNE_FLASH = {
    RATIO, RATIO, TIMES, C15_16THS,
    END
};

// DRIVEN is in 1/256 of a count: 64 of them are a quarter.
static const uint8_t least_ratio[] FIXPID_AUTOTUNE_FLASH = {
    FACTOR,      RELAY, GREATER, RELAY_2,
    DOUBT,       C1_32ND, PLUS, STEP_2,
    DOUBT,       DOUBT, TIMES, FACTOR, TIMES, C64, OVER, DRIVEN,
    FACTOR,      ONE, MINUS, DOUBT,
    LEAST_RATIO, RATIO, TIMES, FACTOR,
    END
};

// psi(r) = 1 - r (0.05 + r (0.64 + r^2 0.31 r))
static const uint8_t true_slope[] FIXPID_AUTOTUNE_FLASH = {
    PSI,         RATIO, TIMES, C0_31,
    PSI,         RATIO, TIMES, RATIO, TIMES, PSI, PLUS, C0_64,
    PSI,         RATIO, TIMES, PSI, PLUS, C0_05,
    PSI,         ONE, MINUS, RATIO, TIMES, PSI,
    TRUE_SLOPE,  SLOPE, OVER, PSI,
    COARSENESS,  ONE, OVER, MEAN_MID, LESSER, QUARTER,
    HYSTERESIS,  HYSTERESIS, LESSER, C0_75,
    LEAST_DELAY, C0_6,
    END
};

// NOISE_PART is what the noise asks for as hysteresis, in counts, before.
static const uint8_t integrator[] FIXPID_AUTOTUNE_FLASH = {
    FLATNESS,   ONE, MINUS, ONE,
    LEVEL,      ONE, MINUS, ONE,
    NOISE_PART, NOISE_PART, OVER, NET_SWING, LESSER, QUARTER,
    ROUNDER,    ROUNDNESS, LESSER, C0_875,
                PLUS, NOISE_PART, TIMES, C0_2,
                MINUS, C0_53,
    FLATTER,    C0_46, MINUS, ROUNDNESS,
    BEND,       ROUNDNESS, MINUS, C0_53,
    MORE,       C4_608,
                PLUS, ROUNDER, TIMES, C26_16,
                PLUS, ROUNDER, TIMES, ROUNDER, TIMES, C22_4,
                PLUS, HYSTERESIS, TIMES, HYSTERESIS, TIMES, C9_462,
                PLUS, COARSENESS, TIMES, C4_627,
                PLUS, SPREAD, TIMES, C1_16,
                PLUS, NOISE_PART, TIMES, C0_216,
    LESS,       HYSTERESIS, TIMES, C11_75,
                PLUS, ROUNDER, TIMES, HYSTERESIS, TIMES, C45_48,
                PLUS, FLATTER, TIMES, C0_808,
    END
};

static const uint8_t flatter_integrator[] FIXPID_AUTOTUNE_FLASH = {
    LEAST_DELAY, C1_2, PLUS, FLATTER, TIMES, FOUR,
    END
};

// T = k M / (2 s k')
static const uint8_t lag[] FIXPID_AUTOTUNE_FLASH = {
    FLATNESS, LEAST_RATIO, TIMES, TWO, OVER, MID_RISE,
    LEVEL,    RATIO, TIMES, TWO, OVER, MID_RISE,
    DIVISOR,  TRUE_SLOPE, TIMES, FLATNESS,
    LAG,      ONE, OVER, DIVISOR,
    FORM,     ROUNDNESS, OVER, LAG_ROUNDNESS,
    ROUNDER,  FORM, MINUS, C1_03, LESSER, C0_47,
    FLATTER,  C0_9, MINUS, FORM,
    MORE,     C3_204,
              PLUS, ROUNDER, TIMES, C4_382,
              PLUS, HYSTERESIS, TIMES, HYSTERESIS, TIMES, C5_488,
              PLUS, COARSENESS, TIMES, C2_068,
              PLUS, RATIO, TIMES, RATIO, TIMES, C2_828,
              PLUS, RATIO, TIMES, ROUNDER, TIMES, C28_086,
              PLUS, RATIO, TIMES, HYSTERESIS, TIMES, C5_285,
              PLUS, SPREAD, TIMES, C1_188,
              PLUS, FLATTER, TIMES, C2_272,
    LESS,     HYSTERESIS, TIMES, C6_815,
              PLUS, ROUNDER, TIMES, HYSTERESIS, TIMES, C11_667,
              PLUS, RATIO, TIMES, C1_193,
    END
};

static const uint8_t delay[] FIXPID_AUTOTUNE_FLASH = {
    DELAY, MORE, MINUS, LESS, GREATER, LEAST_DELAY,
    DELAY, DELAY, TIMES, MEAN_MID,
    END
};

// What the model tells: K and T by r.
static const uint8_t gain_and_lag[] FIXPID_AUTOTUNE_FLASH = {
    GAIN,    ONE, OVER, LEVEL,
    DIVISOR, TRUE_SLOPE, TIMES, LEVEL,
    LAG,     ONE, OVER, DIVISOR,
    END
};

// DELAY is C from here on.
static const uint8_t pi_gains[] FIXPID_AUTOTUNE_FLASH = {
    DELAY,   DELAY, TIMES, ROBUST,
    DIVISOR, TRUE_SLOPE, TIMES, DELAY,
    KP,      ONE, OVER, DIVISOR,
    TI,      DELAY, TIMES, FOUR,
    TD,      ONE, MINUS, ONE,
    END
};

// A gain K that is found too small makes T and Ti too short. With kp's floor it
// is not the integral part alone that is left, and too large. Ti follows kp: ki
// stays what it was.
static const uint8_t pi_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    TI, LAG, LESSER, TI,
    TI, TI, OVER, KP,
    KP, KP, PLUS, FLATNESS, TIMES, C0_2, OVER, ROBUST,
    TI, TI, TIMES, KP,
    END
};

static const uint8_t pid_gains[] FIXPID_AUTOTUNE_FLASH = {
    AMIGO_DELAY, DELAY, TIMES, HALF,
    DIVISOR,     TRUE_SLOPE, TIMES, AMIGO_DELAY,
    KP,          C0_45, OVER, DIVISOR,
    END
};

// The 8 L are the 4 C of a PI.
static const uint8_t pid_of_integrator[] FIXPID_AUTOTUNE_FLASH = {
    BEND,    BEND, LESSER, C0_12,
    FACTOR,  ONE, PLUS, BEND, TIMES, C10,
    KP,      KP, TIMES, FACTOR,
    DIVISOR, ONE, PLUS, BEND, TIMES, C6,
    TI,      TI, OVER, DIVISOR,
    TD,      AMIGO_DELAY, TIMES, QUARTER,
    END
};

// AMIGO, with half of its Td.
static const uint8_t pid_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    KP,      FLATNESS, TIMES, C0_2, PLUS, KP,
    FACTOR,  AMIGO_DELAY, TIMES, C0_4, PLUS, LAG, TIMES, C0_8,
    DIVISOR, AMIGO_DELAY, PLUS, LAG, TIMES, C0_1,
    TI,      FACTOR, TIMES, AMIGO_DELAY, OVER, DIVISOR,
    DIVISOR, AMIGO_DELAY, TIMES, C0_3, PLUS, LAG,
    TD,      AMIGO_DELAY, TIMES, LAG, TIMES, QUARTER, OVER, DIVISOR,
    END
};

static const uint8_t ki_and_kd[] FIXPID_AUTOTUNE_FLASH = {
    KI, KP, OVER, TI,
    KD, KP, TIMES, TD,
    END
};
// clang-format on

#endif
