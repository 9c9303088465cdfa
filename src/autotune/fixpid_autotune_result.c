// SPDX-License-Identifier: MIT
// What the experiment found: the process, and gains for it. It has its own file
// because SDCC links whole object files.
//
// The formulas are tables of operations on the numbers of a sheet: an 8-bit
// chip holds them in a third of the room that calls would take.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_arith.h"
#include "fixpid_autotune_constants.h"
#include "fixpid_autotune_private.h"

#define ROBUSTNESS_MIN 8u
#define ROBUSTNESS_MAX 64u
#define KI_MIN 8u
#define STEPS_MAX 32767u
#define DEVIATION_MAX UINT32_C(32767)
#define ROBUST_MORE UINT32_C(18)
#define WEIGHT_ONE 256u

// Farther than any two outputs are from each other, in 1/256 of a count.
#define FAR_Q8 UINT32_C(0x40000000)

// The registers of a sheet. A 0 or 1 behind a name is of the first relay or the
// second.
enum number {
    // Of one relay, from its sums.
    N,    // cycles
    D,    // high - low
    A,    // area of what the deviation lies below its mean at high
    P,    // steps
    ON,   // of them, at high
    OFF,  // and at low
    RISE, // deviation at the turns
    D1,
    STEP, // one of a cycle of the second relay

    // What they make of the wave.
    M0, // ON OFF / P of one cycle, steps
    M1,
    X0, // what the hysteresis adds to a half, per step
    X1,
    K0, // slope, K / T
    K1,
    M, // means of both
    K,
    KM,
    W,     // swing of the last cycle
    NOISE, // what of it is noise
    NET,   // what of it is not
    ROUND, // 1/2 is a triangle, 1 a square
    CHI,   // what of a half the hysteresis makes
    Q,     // difference of the slopes

    // Of the process.
    DU, // difference of the mean outputs
    DY, // and of the mean deviations
    R,  // KM / 2 over K: 0 integrating, 1 a pure delay
    S,  // the smallest R that the means leave open
    F,  // ROUND of one lag with that R
    LIMIT,
    SLOPE, // K / T, without what the lag takes from it
    FLAT,  // 1 / K by S; 0 if integrating
    LEVEL, // 1 / K by R
    T,     // lag, unless integrating
    V,     // noise of the swing
    I,     // steps are coarse
    Z,     // ROUND over that of one lag
    E,     // what the wave is rounder
    FLATTER,
    MORE,
    LESS,
    LEAST,
    C,    // delay that the gains allow for
    BEND, // what a lag besides the integrator adds to ROUND

    // The gains of a rule.
    ROBUST,
    L, // delay of AMIGO
    KP,
    TI,
    TD,
    KI,
    KD,

    X, // on the way
    Y,
    END // of a table
};

// {C, A, TIMES, B} is C = A B.
enum verb {
    TIMES,
    OVER,
    PLUS,
    MINUS,
    LESSER,
    GREATER,
    TIMES_ONTO // C = C + A B
};

struct operation {
    uint8_t to; // or END
    uint8_t a;
    uint8_t verb;
    uint8_t b;
};

struct sheet {
    struct number16 numbers[END];
};

// An operation a line.
// clang-format off

// M = ON OFF / P / N
// X = RISE / (N D)
// K = J + X^2 / M^2 / (J + X^2 / M^2 / J), where
//     J = 2 A / N / (D M^2) is the slope of a pure integrator
static const struct operation one_relay[] FIXPID_AUTOTUNE_FLASH = {
    {M0, ON, TIMES, OFF},
    {M0, M0, OVER, P},
    {M0, M0, OVER, N},
    {X, N, TIMES, D},
    {X0, RISE, OVER, X},
    {X, M0, TIMES, M0},
    {Y, X0, TIMES, X0},
    {Y, Y, OVER, X}, // X^2 / M^2
    {K0, D, TIMES, X},
    {X, A, TIMES, TWO},
    {X, X, OVER, N},
    {X, X, OVER, K0}, // J
    {K0, Y, OVER, X},
    {K0, X, PLUS, K0},
    {K0, Y, OVER, K0},
    {K0, X, PLUS, K0},
    {END, 0, 0, 0},
};

static const struct operation keep_second[] FIXPID_AUTOTUNE_FLASH = {
    {K1, K0, TIMES, ONE},
    {M1, M0, TIMES, ONE},
    {X1, X0, TIMES, ONE},
    {D1, D, TIMES, ONE},
    {STEP, N, OVER, P},
    {END, 0, 0, 0},
};

// K, M: the means of both
// NET = 1 + (W - NOISE)
// ROUND = K0 M0 D / 2 / NET
// CHI = (X0 + X1) / 2 / KM
// Q = |K0 - K1| / K
// LIMIT = 1.1 ROUND + 1 / M + 0.3 CHI
static const struct operation wave[] FIXPID_AUTOTUNE_FLASH = {
    {K, K0, PLUS, K1},
    {K, K, TIMES, HALF},
    {M, M0, PLUS, M1},
    {M, M, TIMES, HALF},
    {KM, K, TIMES, M},
    {NET, W, MINUS, NOISE},
    {NET, ONE, PLUS, NET},
    {ROUND, M0, TIMES, D},
    {ROUND, K0, TIMES, ROUND},
    {ROUND, ROUND, TIMES, HALF},
    {ROUND, ROUND, OVER, NET},
    {CHI, X0, PLUS, X1},
    {CHI, CHI, TIMES, HALF},
    {CHI, CHI, OVER, KM},
    {X, K0, MINUS, K1},
    {Q, K1, MINUS, K0},
    {Q, X, PLUS, Q},
    {Q, Q, OVER, K},
    {I, ONE, OVER, M},
    {LIMIT, ROUND, TIMES, C1_1},
    {LIMIT, LIMIT, PLUS, I},
    {LIMIT, CHI, TIMES_ONTO, C0_3},
    {END, 0, 0, 0},
};

// A PI is for the quicker one of two processes.
static const struct operation quicker[] FIXPID_AUTOTUNE_FLASH = {
    {K, K0, GREATER, K1},
    {Q, ONE, TIMES, HALF},
    {END, 0, 0, 0},
};

// R = min(KM DU / DY / 2, 63/64)
static const struct operation static_gain[] FIXPID_AUTOTUNE_FLASH = {
    {X, DU, OVER, DY},
    {R, KM, TIMES, X},
    {R, R, TIMES, HALF},
    {R, R, LESSER, C63_64THS},
    {END, 0, 0, 0},
};

// F = 1/2 + R^2 (0.3 + 0.2 R): the round of one lag with dead time
static const struct operation one_lag[] FIXPID_AUTOTUNE_FLASH = {
    {X, R, TIMES, C0_2},
    {X, C0_3, PLUS, X},
    {Y, R, TIMES, R},
    {X, Y, TIMES, X},
    {F, HALF, PLUS, X},
    {END, 0, 0, 0},
};

static const struct operation smaller_ratio[] FIXPID_AUTOTUNE_FLASH = {
    {R, R, TIMES, C15_16THS},
    {END, 0, 0, 0},
};

// S = R (1 - D / 4 (1/32 + STEP) / DU): D is the larger relay, in 1/256 of a
// count, as DU is.
static const struct operation what_means_leave[] FIXPID_AUTOTUNE_FLASH = {
    {Y, D, GREATER, D1},
    {Y, Y, TIMES, C64},
    {X, C1_32ND, PLUS, STEP},
    {X, Y, TIMES, X},
    {X, X, OVER, DU},
    {X, ONE, MINUS, X},
    {S, R, TIMES, X},
    {END, 0, 0, 0},
};

// SLOPE = K / psi, with psi = 1 - R (R (R^2 0.31 R + 0.64) + 0.05)
// I = min(1 / M, 1/4), CHI = min(CHI, 0.75)
// BEND = ROUND - 0.53
static const struct operation slope[] FIXPID_AUTOTUNE_FLASH = {
    {X, R, TIMES, C0_31},
    {Y, R, TIMES, R},
    {X, Y, TIMES, X},
    {X, X, PLUS, C0_64},
    {X, R, TIMES, X},
    {X, X, PLUS, C0_05},
    {X, R, TIMES, X},
    {X, ONE, MINUS, X},
    {SLOPE, K, OVER, X},
    {I, I, LESSER, QUARTER},
    {CHI, CHI, LESSER, C0_75},
    {BEND, ROUND, MINUS, C0_53},
    {LEAST, ONE, TIMES, C0_6},
    {END, 0, 0, 0},
};

// The delay of an integrator is MORE - LESS times M.
// V = min(V / NET, 1/4), where V was what the noise asks for as hysteresis
// E = min(ROUND, 0.875) + 0.2 V - 0.53, FLATTER = 0.46 - ROUND
static const struct operation integrator[] FIXPID_AUTOTUNE_FLASH = {
    {V, V, OVER, NET},
    {V, V, LESSER, QUARTER},
    {E, ROUND, LESSER, C0_875},
    {E, V, TIMES_ONTO, C0_2},
    {E, E, MINUS, C0_53},
    {FLATTER, C0_46, MINUS, ROUND},

    {MORE, ONE, TIMES, C4_608},
    {MORE, E, TIMES_ONTO, C26_16},
    {X, E, TIMES, E},
    {MORE, X, TIMES_ONTO, C22_4},
    {X, CHI, TIMES, CHI},
    {MORE, X, TIMES_ONTO, C9_462},
    {MORE, I, TIMES_ONTO, C4_627},
    {MORE, Q, TIMES_ONTO, C1_16},
    {MORE, V, TIMES_ONTO, C0_216},

    {LESS, CHI, TIMES, C11_75},
    {X, E, TIMES, CHI},
    {LESS, X, TIMES_ONTO, C45_48},
    {LESS, FLATTER, TIMES_ONTO, C0_808},
    {END, 0, 0, 0},
};

static const struct operation flatter_integrator[] FIXPID_AUTOTUNE_FLASH = {
    {LEAST, FLATTER, TIMES, FOUR},
    {LEAST, C1_2, PLUS, LEAST},
    {END, 0, 0, 0},
};

// The delay of a lag is MORE - LESS times M.
// Z = ROUND / F, E = min(Z - 1.03, 0.47), FLATTER = 0.9 - Z
// FLAT = 2 S / KM, LEVEL = 2 R / KM, T = 1 / (SLOPE FLAT)
static const struct operation lag[] FIXPID_AUTOTUNE_FLASH = {
    {Z, ROUND, OVER, F},
    {E, Z, MINUS, C1_03},
    {E, E, LESSER, C0_47},
    {FLATTER, C0_9, MINUS, Z},

    {MORE, ONE, TIMES, C3_204},
    {MORE, E, TIMES_ONTO, C4_382},
    {X, CHI, TIMES, CHI},
    {MORE, X, TIMES_ONTO, C5_488},
    {MORE, I, TIMES_ONTO, C2_068},
    {X, R, TIMES, R},
    {MORE, X, TIMES_ONTO, C2_828},
    {X, R, TIMES, E},
    {MORE, X, TIMES_ONTO, C28_086},
    {X, R, TIMES, CHI},
    {MORE, X, TIMES_ONTO, C5_285},
    {MORE, Q, TIMES_ONTO, C1_188},
    {MORE, FLATTER, TIMES_ONTO, C2_272},

    {LESS, CHI, TIMES, C6_815},
    {X, E, TIMES, CHI},
    {LESS, X, TIMES_ONTO, C11_667},
    {LESS, R, TIMES_ONTO, C1_193},

    {X, S, TIMES, TWO},
    {FLAT, X, OVER, KM},
    {X, R, TIMES, TWO},
    {LEVEL, X, OVER, KM},
    {X, SLOPE, TIMES, FLAT},
    {T, ONE, OVER, X},
    {END, 0, 0, 0},
};

// C = max(MORE - LESS, LEAST) M
static const struct operation delay[] FIXPID_AUTOTUNE_FLASH = {
    {C, MORE, MINUS, LESS},
    {C, C, GREATER, LEAST},
    {C, C, TIMES, M},
    {END, 0, 0, 0},
};

// K = 1 / LEVEL, T = 1 / (SLOPE LEVEL): what the model tells
static const struct operation gain_and_lag[] FIXPID_AUTOTUNE_FLASH = {
    {K, ONE, OVER, LEVEL},
    {X, SLOPE, TIMES, LEVEL},
    {T, ONE, OVER, X},
    {END, 0, 0, 0},
};

// With C = C ROBUST: KP = 1 / (SLOPE C), TI = 4 C
// and for the other rule L = C / 2
static const struct operation pi_rule[] FIXPID_AUTOTUNE_FLASH = {
    {C, C, TIMES, ROBUST},
    {TI, C, TIMES, FOUR},
    {L, C, TIMES, HALF},
    {X, SLOPE, TIMES, C},
    {KP, ONE, OVER, X},
    {END, 0, 0, 0},
};

// With Y = min(T, TI) / KP: KP + 0.2 FLAT / ROBUST, TI = Y KP. A gain that is
// too small by n makes T and TI n times too short. KP has a floor, so that the
// loop is not left with an integral part alone, which would be n times too
// large. KI, which is KP / TI, stays what it was.
static const struct operation pi_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    {Y, T, LESSER, TI},
    {Y, Y, OVER, KP},
    {X, FLAT, TIMES, C0_2},
    {X, X, OVER, ROBUST},
    {KP, KP, PLUS, X},
    {TI, Y, TIMES, KP},
    {END, 0, 0, 0},
};

// AMIGO PID, with half of its TD: KP = 0.45 / (SLOPE L)
static const struct operation pid_rule[] FIXPID_AUTOTUNE_FLASH = {
    {X, SLOPE, TIMES, L},
    {KP, C0_45, OVER, X},
    {END, 0, 0, 0},
};

// With Z = min(BEND, 0.12): KP (1 + 10 Z), TI / (1 + 6 Z), TD = L / 4
static const struct operation pid_of_integrator[] FIXPID_AUTOTUNE_FLASH = {
    {Z, BEND, LESSER, C0_12},
    {X, Z, TIMES, C10},
    {X, ONE, PLUS, X},
    {KP, KP, TIMES, X},
    {X, Z, TIMES, C6},
    {X, ONE, PLUS, X},
    {TI, TI, OVER, X},
    {TD, L, TIMES, QUARTER},
    {END, 0, 0, 0},
};

// KP + 0.2 FLAT, TI = (0.4 L + 0.8 T) L / (L + 0.1 T),
// TD = L T / 4 / (0.3 L + T)
static const struct operation pid_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    {X, FLAT, TIMES, C0_2},
    {KP, X, PLUS, KP},
    {X, L, TIMES, C0_4},
    {X, T, TIMES_ONTO, C0_8},
    {X, X, TIMES, L},
    {Y, T, TIMES, C0_1},
    {Y, L, PLUS, Y},
    {TI, X, OVER, Y},
    {TD, L, TIMES, T},
    {TD, TD, TIMES, QUARTER},
    {X, L, TIMES, C0_3},
    {X, X, PLUS, T},
    {TD, TD, OVER, X},
    {END, 0, 0, 0},
};

static const struct operation gains_of_times[] FIXPID_AUTOTUNE_FLASH = {
    {KI, KP, OVER, TI},
    {KD, KP, TIMES, TD},
    {END, 0, 0, 0},
};
// clang-format on

static void take(FIXPID_DATA const struct sheet *sheet,
                 FIXPID_DATA struct number16 *number, uint8_t which)
{
    if ((which & CONSTANT) == 0u) {
        // The analyzer does not see that a table sets each number before its
        // use. NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign)
        number->mantissa = sheet->numbers[which].mantissa;
        number->exponent = sheet->numbers[which].exponent;
    } else {
        const struct constant *const constant =
            &constants[which & (uint8_t)~CONSTANT];

        number->mantissa = flash_word(&constant->mantissa);
        number->exponent =
            (int8_t)flash_byte((const uint8_t *)&constant->exponent);
    }
}

// to = min(a, b) if `minimum`, else max(a, b)
static void choose(FIXPID_DATA struct number16 *to,
                   FIXPID_DATA const struct number16 *a,
                   FIXPID_DATA const struct number16 *b, bool minimum)
{
    struct number16 more;
    FIXPID_DATA const struct number16 *chosen = a;

    subtract(&more, a, b);
    if ((more.mantissa != 0u) == minimum) {
        chosen = b;
    }
    to->mantissa = chosen->mantissa;
    to->exponent = chosen->exponent;
}

// to_number = a_number verb b_number
static void operate(FIXPID_DATA struct sheet *sheet, uint8_t to_number,
                    uint8_t a_number, uint8_t verb, uint8_t b_number)
{
    FIXPID_DATA struct number16 *const to = &sheet->numbers[to_number];
    struct number16 a;
    struct number16 b;

    take(sheet, &a, a_number);
    take(sheet, &b, b_number);
    switch (verb) {
    case TIMES:
        multiply(to, &a, &b);
        break;
    case OVER:
        divide(to, &a, &b);
        break;
    case PLUS:
        add(to, &a, &b);
        break;
    case MINUS:
        subtract(to, &a, &b);
        break;
    case TIMES_ONTO:
        multiply(&a, &a, &b);
        add(to, to, &a);
        break;
    default:
        choose(to, &a, &b, verb == (uint8_t)LESSER);
        break;
    }
}

// Does the operations of a table, up to its END.
static void calculate(FIXPID_DATA struct sheet *sheet,
                      const struct operation *table)
{
    const struct operation *operation = table;
    uint8_t to = flash_byte(&operation->to);

    while (to != (uint8_t)END) {
        operate(sheet, to, flash_byte(&operation->a),
                flash_byte(&operation->verb), flash_byte(&operation->b));
        operation++;
        to = flash_byte(&operation->to);
    }
}

static void set(FIXPID_DATA struct sheet *sheet, uint8_t which, uint32_t value,
                int8_t exponent)
{
    make(&sheet->numbers[which], value, exponent);
}

static bool is_zero(FIXPID_DATA const struct sheet *sheet, uint8_t which)
{
    // The analyzer does not see that the tables set each number before its use.
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
    return sheet->numbers[which].mantissa == 0u;
}

static void clear(FIXPID_DATA struct sheet *sheet, uint8_t which)
{
    make(&sheet->numbers[which], 0, 0);
}

static uint32_t magnitude(int32_t x)
{
    const uint32_t pattern = (uint32_t)x;

    return (x < 0) ? (~pattern + 1u) : pattern;
}

static int32_t with_sign_of(int32_t sign, uint32_t value)
{
    return (sign < 0) ? -(int32_t)value : (int32_t)value;
}

// scale * total / steps, in two parts. pre: total / steps is below 2^16, and
// scale at most 32767. (A remainder by % would link SDCC's function for it.)
static uint32_t part_of(uint32_t total, uint16_t steps, uint16_t scale)
{
    const uint32_t whole = total / steps;
    const uint32_t rest = total - (whole * steps);

    return (whole * scale) + ((rest * scale) / steps);
}

// The mean deviation, 1/256 of a count.
static int32_t deviation_q8(FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    return with_sign_of(sums->all,
                        part_of(magnitude(sums->all), sums->steps, 256));
}

// The mean output of one relay, 1/256 of a count.
static int32_t output_q8(FIXPID_DATA const struct fixpid_autotune *self,
                         uint8_t relay)
{
    const uint8_t phase = (uint8_t)(PHASE_FIRST + relay);
    const uint16_t relay_counts = fixpid_autotune_span(self, phase);
    FIXPID_DATA const struct fixpid_autotune_sums *const sums =
        &SELF.sums[relay];

    return ((int32_t)fixpid_autotune_level(self, phase, AT_LOW) * 256) +
           (int32_t)part_of((uint32_t)relay_counts * sums->on_steps,
                            sums->steps, 256);
}

// True if the sums can be those of cycles, each of which has steps at high and
// at low. Flipped bits may have made other sums of them.
static bool sums_make_sense(FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    const uint32_t steps = sums->steps;

    if (steps > STEPS_MAX) {
        return false;
    }
    if (sums->on_steps == 0u) {
        return false;
    }
    if (sums->on_steps >= steps) {
        return false;
    }
    if (magnitude(sums->all) > (steps * DEVIATION_MAX)) {
        return false;
    }
    return magnitude(sums->on) <= (sums->on_steps * DEVIATION_MAX);
}

static uint16_t swing(FIXPID_DATA const struct fixpid_autotune *self)
{
    return (uint16_t)((uint16_t)SELF.highest - (uint16_t)SELF.lowest);
}

// a > b, more exactly: a - b is not 0
static bool above(FIXPID_DATA struct sheet *sheet, uint8_t a, uint8_t b)
{
    operate(sheet, Y, a, MINUS, b);
    return !is_zero(sheet, Y);
}

// The numbers of one relay. False if its sums make no sense, or no area.
static bool measure_relay(FIXPID_DATA struct sheet *sheet,
                          FIXPID_DATA const struct fixpid_autotune *self,
                          uint8_t relay)
{
    FIXPID_DATA const struct fixpid_autotune_sums *const sums =
        &SELF.sums[relay];
    const uint32_t rise = magnitude(sums->rise);
    int32_t area;

    if (!sums_make_sense(sums)) {
        return false;
    }
    // Each within 32767^2, and 16376. Each cycle has steps at high and at low.
    area = with_sign_of(sums->all, part_of(magnitude(sums->all), sums->steps,
                                           sums->on_steps)) -
           sums->on - with_sign_of(sums->rise, rise >> 1);
    if (area <= 0) {
        return false;
    }
    set(sheet, N, SELF.config.cycles, (relay == 0u) ? 1 : 0);
    set(sheet, D, fixpid_autotune_span(self, (uint8_t)(PHASE_FIRST + relay)),
        0);
    set(sheet, A, (uint32_t)area, 0);
    set(sheet, P, sums->steps, 0);
    set(sheet, ON, sums->on_steps, 0);
    set(sheet, OFF, (uint16_t)(sums->steps - sums->on_steps), 0);
    set(sheet, RISE, rise, 0);
    calculate(sheet, one_relay);
    if (sums->rise < 0) {
        clear(sheet, X0);
    }
    return true;
}

static uint8_t refuse_for_pid(FIXPID_DATA struct sheet *sheet)
{
    if (!above(sheet, ROUND, C0_3)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    if (above(sheet, CHI, C1_5)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    if (above(sheet, Q, HALF)) {
        return FIXPID_AUTOTUNE_TWO_PROCESSES;
    }
    return FIXPID_AUTOTUNE_NO_REASON;
}

// The wave that both relays tell of. A cause why it is none that the rule
// serves.
static uint8_t measure_wave(FIXPID_DATA struct sheet *sheet,
                            FIXPID_DATA const struct fixpid_autotune *self,
                            uint8_t rule)
{
    if (!measure_relay(sheet, self, 1)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    calculate(sheet, keep_second);
    if (!measure_relay(sheet, self, 0)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    set(sheet, W, swing(self), 0);
    set(sheet, NOISE, (SELF.noise * UINT32_C(3)) >> 2, -4);
    calculate(sheet, wave);
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PID) {
        return refuse_for_pid(sheet);
    }
    if (above(sheet, Q, HALF)) {
        calculate(sheet, quicker);
    }
    return FIXPID_AUTOTUNE_NO_REASON;
}

// More measurement is held with less output. Where the slopes differ, the means
// shift by themselves, and a PI does not mind.
static bool runs_away(FIXPID_DATA struct sheet *sheet, uint8_t rule)
{
    if (!above(sheet, R, C0_06)) {
        return false;
    }
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PID) {
        return true;
    }
    return !above(sheet, Q, C0_2);
}

// R, as the means have it. False if the process runs away.
static bool measure_gain(FIXPID_DATA struct sheet *sheet,
                         FIXPID_DATA const struct fixpid_autotune *self,
                         uint8_t rule)
{
    const int32_t measured =
        deviation_q8(&SELF.sums[0]) - deviation_q8(&SELF.sums[1]);
    const int32_t driven = output_q8(self, 0) - output_q8(self, 1);

    clear(sheet, R);
    set(sheet, DU, magnitude(driven), 0);
    if (measured > ((int32_t)swing(self) * 16)) { // a 16th of the swing
        set(sheet, DY, (uint32_t)measured, 0);
        calculate(sheet, static_gain);
        if (driven <= 0) {
            if (runs_away(sheet, rule)) {
                return false;
            }
            clear(sheet, R);
        }
    }
    return true;
}

// No process is less round than one of a single lag. A larger R means that the
// load has moved.
static void limit_ratio(FIXPID_DATA struct sheet *sheet)
{
    calculate(sheet, one_lag);
    while (above(sheet, F, LIMIT)) {
        if (!above(sheet, R, C1_256TH)) {
            break;
        }
        calculate(sheet, smaller_ratio);
        calculate(sheet, one_lag);
    }
    calculate(sheet, what_means_leave);
    if (!above(sheet, S, C0_03)) {
        clear(sheet, R);
    }
}

// The process of an experiment that is done, SLOPE to C. A cause why there is
// none.
static uint8_t identify(FIXPID_DATA struct sheet *sheet,
                        FIXPID_DATA const struct fixpid_autotune *self,
                        uint8_t rule)
{
    const uint8_t cause = measure_wave(sheet, self, rule);

    if (cause != (uint8_t)FIXPID_AUTOTUNE_NO_REASON) {
        return cause;
    }
    if (!measure_gain(sheet, self, rule)) {
        return FIXPID_AUTOTUNE_RUNS_AWAY;
    }
    limit_ratio(sheet);
    calculate(sheet, slope);
    if (is_zero(sheet, R)) {
        clear(sheet, FLAT);
        clear(sheet, LEVEL);
        set(sheet, V, fixpid_autotune_noise_band(self), 0);
        calculate(sheet, integrator);
        if (!is_zero(sheet, FLATTER)) {
            calculate(sheet, flatter_integrator);
        }
    } else {
        calculate(sheet, lag);
    }
    calculate(sheet, delay);
    return FIXPID_AUTOTUNE_NO_REASON;
}

// The mean output, less what the mean deviation takes, within the output range.
static int16_t holding(FIXPID_DATA struct sheet *sheet,
                       FIXPID_DATA const struct fixpid_autotune *self)
{
    const int32_t off = shift_right_floor(deviation_q8(&SELF.sums[0]), 1) +
                        shift_right_floor(deviation_q8(&SELF.sums[1]), 1);
    int32_t output = shift_right_floor(output_q8(self, 0), 1) +
                     shift_right_floor(output_q8(self, 1), 1);
    FIXPID_DATA struct number16 *const part = &sheet->numbers[X];
    uint32_t taken;

    set(sheet, X, magnitude(off), 0);
    multiply(part, &sheet->numbers[LEVEL], part);
    taken = integer(part, 0);
    if (taken > FAR_Q8) {
        taken = FAR_Q8;
    }
    output -= with_sign_of(off, taken);
    output = shift_right_floor(output + 128, 8);
    if (output < SELF.config.output_min) {
        return SELF.config.output_min;
    }
    if (output > SELF.config.output_max) {
        return SELF.config.output_max;
    }
    return (int16_t)output;
}

bool fixpid_autotune_model(FIXPID_DATA const struct fixpid_autotune *self,
                           struct fixpid_autotune_process *process)
{
    struct sheet sheet;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(process != 0);
    if (SELF.state != (uint8_t)FIXPID_AUTOTUNE_DONE) {
        return false;
    }
    if (identify(&sheet, self, FIXPID_AUTOTUNE_PI) !=
        (uint8_t)FIXPID_AUTOTUNE_NO_REASON) {
        return false;
    }
    process->gain_q8 = FIXPID_AUTOTUNE_INTEGRATING;
    process->lag_q4 = FIXPID_AUTOTUNE_INTEGRATING;
    if (!is_zero(&sheet, LEVEL)) {
        calculate(&sheet, gain_and_lag);
        process->gain_q8 = integer(&sheet.numbers[K], 8);
        process->lag_q4 = integer(&sheet.numbers[T], 4);
    }
    process->dead_q4 = integer(&sheet.numbers[C], 3); // half of it
    process->slope_q24 = integer(&sheet.numbers[SLOPE], 24);
    process->holding = holding(&sheet, self);
    process->noise_q4 = (uint16_t)((SELF.noise + 2u) >> 2);
    process->hysteresis = SELF.edge;
    return true;
}

static void apply_rule(FIXPID_DATA struct sheet *sheet, uint8_t rule,
                       uint8_t robustness_q4)
{
    const bool integrating = is_zero(sheet, FLAT);

    set(sheet, ROBUST, robustness_q4 + ROBUST_MORE, -5);
    clear(sheet, TD);
    calculate(sheet, pi_rule);
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PI) {
        if (!integrating) {
            calculate(sheet, pi_of_lag);
        }
    } else {
        calculate(sheet, pid_rule);
        calculate(sheet, integrating ? pid_of_integrator : pid_of_lag);
    }
    calculate(sheet, gains_of_times);
}

// The largest one that lags at most an eighth of TD, or one more with a PID.
static uint8_t filter_of(FIXPID_DATA const struct sheet *sheet, uint8_t rule)
{
    uint32_t lag_steps = integer(&sheet->numbers[TD], 0) >> 3;
    uint8_t filter = rule;

    while (lag_steps > 1u) {
        lag_steps >>= 1;
        filter++;
    }
    return (filter > FIXPID_PID_FILTER_MAX) ? (uint8_t)FIXPID_PID_FILTER_MAX
                                            : filter;
}

// The gains of KP, TI and TD. A cause why one is out of its range.
static uint8_t fold(FIXPID_DATA struct sheet *sheet, uint8_t filter,
                    struct fixpid_pid_gains *gains)
{
    const uint32_t kp_q8 = integer(&sheet->numbers[KP], 8);
    const uint32_t ki_q24 = integer(&sheet->numbers[KI], 24);
    const uint32_t kd_q8 =
        integer(&sheet->numbers[KD], (int8_t)(8 - (int8_t)filter));

    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return FIXPID_AUTOTUNE_GAIN_TOO_LARGE;
    }
    if (ki_q24 > FIXPID_PID_KI_MAX) {
        return FIXPID_AUTOTUNE_GAIN_TOO_LARGE;
    }
    if (kd_q8 > FIXPID_PID_KD_MAX) {
        return FIXPID_AUTOTUNE_GAIN_TOO_LARGE;
    }
    if (ki_q24 < KI_MIN) {
        return FIXPID_AUTOTUNE_GAIN_TOO_SMALL;
    }
    gains->kp_q8 = (uint16_t)kp_q8;
    gains->ki_q24 = ki_q24;
    gains->kd_q8 = (uint16_t)kd_q8;
    gains->derivative_filter = filter;
    return FIXPID_AUTOTUNE_NO_REASON;
}

static bool rule_legal(uint8_t rule, uint8_t robustness_q4)
{
    if (rule > (uint8_t)FIXPID_AUTOTUNE_PID) {
        return false;
    }
    if (robustness_q4 < ROBUSTNESS_MIN) {
        return false;
    }
    return robustness_q4 <= ROBUSTNESS_MAX;
}

// The gains, or the cause why there are none, and nothing written.
static uint8_t find_gains(FIXPID_DATA const struct fixpid_autotune *self,
                          uint8_t rule, uint8_t robustness_q4,
                          struct fixpid_pid_gains *gains)
{
    struct sheet sheet;
    uint8_t cause;

    if (SELF.state != (uint8_t)FIXPID_AUTOTUNE_DONE) {
        return FIXPID_AUTOTUNE_NOT_DONE;
    }
    if (!rule_legal(rule, robustness_q4)) {
        return FIXPID_AUTOTUNE_NOT_LEGAL;
    }
    cause = identify(&sheet, self, rule);
    if (cause != (uint8_t)FIXPID_AUTOTUNE_NO_REASON) {
        return cause;
    }
    apply_rule(&sheet, rule, robustness_q4);
    return fold(&sheet, filter_of(&sheet, rule), gains);
}

bool fixpid_autotune_result(FIXPID_DATA const struct fixpid_autotune *self,
                            uint8_t rule, uint8_t robustness_q4,
                            struct fixpid_pid_config *config)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    if (find_gains(self, rule, robustness_q4, &config->gains) !=
        (uint8_t)FIXPID_AUTOTUNE_NO_REASON) {
        return false;
    }
    config->setpoint_weight_q8 = WEIGHT_ONE;
    config->proportional_on_measurement = false;
    return true;
}

uint8_t fixpid_autotune_reason(FIXPID_DATA const struct fixpid_autotune *self,
                               uint8_t rule, uint8_t robustness_q4)
{
    struct fixpid_pid_gains gains;

    FIXPID_ASSERT(VALID_SELF);
    return find_gains(self, rule, robustness_q4, &gains);
}
