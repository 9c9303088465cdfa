// SPDX-License-Identifier: MIT
// What the experiment found: the process, and gains for it. It has its own file
// because SDCC links whole object files.
//
// The formulas are tables of operations on the numbers of a sheet: an 8-bit
// chip holds them in a third of the room that calls would take.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_arith.h"
#include "fixpid_autotune_private.h"

#define ROBUSTNESS_MIN 8u
#define ROBUSTNESS_MAX 64u
#define KI_MIN 8u
#define STEPS_MAX 32767u
#define DEVIATION_MAX UINT32_C(32767)
#define WEIGHT_ONE 256u

// Farther than any two outputs are from each other, in 1/256 of a count.
#define FAR_Q8 UINT32_C(0x40000000)

enum verb { MULTIPLY, DIVIDE, ADD, SUBTRACT, MINIMUM, MAXIMUM, END };

enum number {
    // Of one relay, from its sums.
    CYCLES,
    RELAY, // high - low
    AREA,  // of what the deviation lies below its mean at high
    STEPS,
    HIGH_STEPS,
    LOW_STEPS,
    RISE,

    // What it makes of them; then the mean of both relays; then the process.
    SLOPE,    // K / T
    MID,      // HIGH_STEPS LOW_STEPS / STEPS of one cycle
    TURN,     // what the hysteresis adds to a half
    ULTIMATE, // Ku
    PERIOD,   // Tu
    SLOPE_2,  // the same of the second relay
    MID_2,
    TURN_2,
    ULTIMATE_2,
    PERIOD_2,

    SWING, // of the last cycle
    NOISE, // what of it is noise
    FLAT,  // 1 / K, 0 if integrating
    ROUND, // of the wave: 1/2 a triangle, 1 a square
    LIMIT, // of the round that RATIO expects
    RATIO, // MID K / T / 2: 0 integrating, 1 a pure delay
    DEAD,  // L
    LAG,   // T, unless integrating
    LATER, // what a second lag adds to L

    // The gains of a rule.
    ROBUST, // closed loop's time constant over L, and 1
    DELAY,  // L and the controller's own half step
    KP,
    TI,
    TD,
    KI,
    KD,

    X, // on the way
    Y,

    // Constants.
    ONE,
    TWO,
    FOUR,
    EIGHT,
    HALF,
    QUARTER,
    RATIO_MIN,
    RATIO_MAX,
    C15_16,
    C0_05,
    C0_1,
    C0_15,
    C0_2,
    C0_3,
    C0_31,
    C0_35,
    C0_4,
    C0_45,
    C0_64,
    C0_8,
    C1_04,
    C1_1,
    C2_5,
    C3_2424,
    C6,
    C7,
    C12,
    C13,
    C13_4
};

static const struct constant {
    uint16_t mantissa;
    int8_t exponent;
} constants[] FIXPID_AUTOTUNE_FLASH = {
    {32768u, -15}, // 1
    {32768u, -14}, // 2
    {32768u, -13}, // 4
    {32768u, -12}, // 8
    {32768u, -16}, // 1/2
    {32768u, -17}, // 1/4
    {32768u, -23}, // 1/256
    {64512u, -16}, // 63/64
    {61440u, -16}, // 15/16
    {52429u, -20}, // 0.05
    {52429u, -19}, // 0.1
    {39322u, -18}, // 0.15
    {52429u, -18}, // 0.2
    {39322u, -17}, // 0.3
    {40632u, -17}, // 0.31
    {45875u, -17}, // 0.35
    {52429u, -17}, // 0.4
    {58982u, -17}, // 0.45
    {41943u, -16}, // 0.64
    {52429u, -16}, // 0.8
    {34079u, -15}, // 1.04
    {36045u, -15}, // 1.1
    {40960u, -14}, // 2.5
    {53124u, -14}, // 3.24243
    {49152u, -13}, // 6
    {57344u, -13}, // 7
    {49152u, -12}, // 12
    {53248u, -12}, // 13
    {54886u, -12}, // 13.4
};

struct operation {
    uint8_t verb;
    uint8_t to;
    uint8_t a;
    uint8_t b;
};

struct sheet {
    struct number16 numbers[ONE];
};

// MID = HIGH_STEPS LOW_STEPS / STEPS / CYCLES
// ULTIMATE = 3.24243 STEPS RELAY (MID CYCLES / STEPS)^2 / AREA
// TURN = RISE / (CYCLES RELAY)
// SLOPE = X + Y / (X + Y / X), of which the Ys are what the hysteresis takes
//     from the area: X = 2 AREA / CYCLES / (RELAY MID^2), Y = TURN^2 / MID^2
// ROUND = SLOPE MID RELAY / 2: its wave's area over MID
static const struct operation relay_numbers[] FIXPID_AUTOTUNE_FLASH = {
    {DIVIDE, PERIOD, STEPS, CYCLES},
    {MULTIPLY, X, HIGH_STEPS, LOW_STEPS},
    {DIVIDE, X, X, STEPS},
    {DIVIDE, MID, X, CYCLES},
    {DIVIDE, X, X, STEPS},
    {MULTIPLY, X, X, X},
    {MULTIPLY, Y, STEPS, RELAY},
    {MULTIPLY, Y, Y, X},
    {DIVIDE, Y, Y, AREA},
    {MULTIPLY, ULTIMATE, Y, C3_2424},
    {MULTIPLY, X, CYCLES, RELAY},
    {DIVIDE, TURN, RISE, X},
    {MULTIPLY, X, MID, MID},
    {MULTIPLY, Y, TURN, TURN},
    {DIVIDE, Y, Y, X},
    {MULTIPLY, SLOPE, RELAY, X},
    {MULTIPLY, X, AREA, TWO},
    {DIVIDE, X, X, CYCLES},
    {DIVIDE, X, X, SLOPE},
    {DIVIDE, SLOPE, Y, X},
    {ADD, SLOPE, X, SLOPE},
    {DIVIDE, SLOPE, Y, SLOPE},
    {ADD, SLOPE, X, SLOPE},
    {MULTIPLY, ROUND, MID, RELAY},
    {MULTIPLY, ROUND, SLOPE, ROUND},
    {MULTIPLY, ROUND, ROUND, HALF},
    {END, 0, 0, 0},
};

static const struct operation keep_second[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, SLOPE_2, SLOPE, ONE},   {MULTIPLY, MID_2, MID, ONE},
    {MULTIPLY, TURN_2, TURN, ONE},     {MULTIPLY, ULTIMATE_2, ULTIMATE, ONE},
    {MULTIPLY, PERIOD_2, PERIOD, ONE}, {END, 0, 0, 0},
};

// The means of both relays.
// ROUND = ROUND / (1 + SWING - NOISE)
// RATIO = min(SLOPE MID FLAT / 2, 63/64)
// LIMIT = 1.1 ROUND + 1 / MID
static const struct operation both_relays[] FIXPID_AUTOTUNE_FLASH = {
    {SUBTRACT, X, SWING, NOISE},
    {ADD, X, ONE, X},
    {DIVIDE, ROUND, ROUND, X},
    {ADD, SLOPE, SLOPE, SLOPE_2},
    {MULTIPLY, SLOPE, SLOPE, HALF},
    {ADD, MID, MID, MID_2},
    {MULTIPLY, MID, MID, HALF},
    {ADD, TURN, TURN, TURN_2},
    {MULTIPLY, TURN, TURN, HALF},
    {ADD, ULTIMATE, ULTIMATE, ULTIMATE_2},
    {MULTIPLY, ULTIMATE, ULTIMATE, HALF},
    {ADD, PERIOD, PERIOD, PERIOD_2},
    {MULTIPLY, PERIOD, PERIOD, HALF},
    {MULTIPLY, RATIO, SLOPE, MID},
    {MULTIPLY, RATIO, RATIO, FLAT},
    {MULTIPLY, RATIO, RATIO, HALF},
    {MINIMUM, RATIO, RATIO, RATIO_MAX},
    {MULTIPLY, X, ROUND, C1_1},
    {DIVIDE, LIMIT, ONE, MID},
    {ADD, LIMIT, X, LIMIT},
    {END, 0, 0, 0},
};

// X: the round of one lag with dead time, 1/2 + RATIO^2 (0.3 + 0.2 RATIO)
// Y: what that is above LIMIT
static const struct operation expected_round[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, RATIO, C0_2},
    {ADD, X, C0_3, X},
    {MULTIPLY, Y, RATIO, RATIO},
    {MULTIPLY, X, Y, X},
    {ADD, X, HALF, X},
    {SUBTRACT, Y, X, LIMIT},
    {END, 0, 0, 0},
};

// Y: what RATIO is above the one of an integrator
static const struct operation smaller_ratio[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, RATIO, RATIO, C15_16},
    {SUBTRACT, Y, RATIO, RATIO_MIN},
    {END, 0, 0, 0},
};

// FLAT = 2 RATIO / (SLOPE MID)
// Y: what RATIO is above the one of an integrator
static const struct operation one_lag[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, SLOPE, MID},
    {MULTIPLY, FLAT, RATIO, TWO},
    {DIVIDE, FLAT, FLAT, X},
    {SUBTRACT, Y, RATIO, RATIO_MIN},
    {END, 0, 0, 0},
};

// SLOPE = SLOPE / (1 - RATIO (RATIO (RATIO^2 0.31 RATIO + 0.64) + 0.05))
// DEAD = max(1/2, 1 + (MID + MID RATIO) - TURN / SLOPE)
// LATER = z (max(1 - 6 RATIO, 1/4) (2.5 + 8 z)), where z is what the wave is
//     rounder than X, that of one lag, less 1.04
static const struct operation dead_time[] FIXPID_AUTOTUNE_FLASH = {
    {DIVIDE, X, ROUND, X},
    {SUBTRACT, LATER, X, C1_04},
    {MULTIPLY, X, RATIO, C6},
    {SUBTRACT, X, ONE, X},
    {MAXIMUM, X, X, QUARTER},
    {MULTIPLY, Y, LATER, EIGHT},
    {ADD, Y, C2_5, Y},
    {MULTIPLY, X, X, Y},
    {MULTIPLY, LATER, LATER, X},
    {MULTIPLY, X, RATIO, C0_31},
    {MULTIPLY, Y, RATIO, RATIO},
    {MULTIPLY, X, Y, X},
    {ADD, X, X, C0_64},
    {MULTIPLY, X, RATIO, X},
    {ADD, X, X, C0_05},
    {MULTIPLY, X, RATIO, X},
    {SUBTRACT, X, ONE, X},
    {DIVIDE, SLOPE, SLOPE, X},
    {DIVIDE, X, TURN, SLOPE},
    {MULTIPLY, Y, MID, RATIO},
    {ADD, Y, MID, Y},
    {ADD, Y, ONE, Y},
    {SUBTRACT, DEAD, Y, X},
    {MAXIMUM, DEAD, DEAD, HALF},
    {ADD, DELAY, DEAD, HALF},
    {END, 0, 0, 0},
};

// LAG = 1 / (SLOPE FLAT), Y = 1 / FLAT
static const struct operation lag_and_gain[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, SLOPE, FLAT},
    {DIVIDE, LAG, ONE, X},
    {DIVIDE, Y, ONE, FLAT},
    {END, 0, 0, 0},
};

// SIMC. With c = DELAY (1 + LATER) ROBUST: KP = 1 / (SLOPE c), TI = 4 c
static const struct operation simc[] FIXPID_AUTOTUNE_FLASH = {
    {ADD, X, ONE, LATER},    {MULTIPLY, X, DELAY, X}, {MULTIPLY, X, X, ROBUST},
    {MULTIPLY, TI, X, FOUR}, {MULTIPLY, X, SLOPE, X}, {DIVIDE, KP, ONE, X},
    {END, 0, 0, 0},
};

static const struct operation simc_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    {MINIMUM, TI, LAG, TI},
    {END, 0, 0, 0},
};

// AMIGO PI of an integrator: KP = 0.35 / (SLOPE DELAY), TI = 13.4 DELAY
static const struct operation amigo_pi[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, SLOPE, DELAY},
    {DIVIDE, KP, C0_35, X},
    {MULTIPLY, TI, DELAY, C13_4},
    {END, 0, 0, 0},
};

// AMIGO PI, with L for DELAY and T for LAG:
// KP = 0.15 FLAT + (0.35 - L T / (L + T)^2) / (SLOPE L)
// TI = 0.35 L + 13 L T^2 / (T^2 + L (12 T + 7 L))
static const struct operation amigo_pi_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    {ADD, Y, DELAY, LAG},
    {MULTIPLY, Y, Y, Y},
    {MULTIPLY, KP, DELAY, LAG},
    {DIVIDE, KP, KP, Y},
    {SUBTRACT, KP, C0_35, KP},
    {DIVIDE, KP, KP, X}, // X of amigo_pi
    {MULTIPLY, X, FLAT, C0_15},
    {ADD, KP, X, KP},
    {MULTIPLY, X, LAG, C12},
    {MULTIPLY, Y, DELAY, C7},
    {ADD, X, X, Y},
    {MULTIPLY, X, DELAY, X},
    {MULTIPLY, Y, LAG, LAG},
    {ADD, X, Y, X},
    {MULTIPLY, Y, DELAY, Y},
    {MULTIPLY, Y, Y, C13},
    {DIVIDE, Y, Y, X},
    {MULTIPLY, X, DELAY, C0_35},
    {ADD, TI, X, Y},
    {END, 0, 0, 0},
};

// AMIGO PID of an integrator: KP = 0.45 / (SLOPE DELAY), TI = 8 DELAY,
// TD = DELAY / 2
static const struct operation amigo_pid[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, SLOPE, DELAY},
    {DIVIDE, KP, C0_45, X},
    {MULTIPLY, TI, DELAY, EIGHT},
    {MULTIPLY, TD, DELAY, HALF},
    {END, 0, 0, 0},
};

// AMIGO PID, with L for DELAY and T for LAG: KP = 0.2 FLAT + 0.45 / (SLOPE L),
// TI = (0.4 L + 0.8 T) L / (L + 0.1 T), TD = L T / 2 / (0.3 L + T),
// Y: what T is above L
static const struct operation amigo_pid_of_lag[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, X, FLAT, C0_2},
    {ADD, KP, X, KP},
    {MULTIPLY, X, DELAY, C0_4},
    {MULTIPLY, Y, LAG, C0_8},
    {ADD, X, X, Y},
    {MULTIPLY, X, X, DELAY},
    {MULTIPLY, Y, LAG, C0_1},
    {ADD, Y, DELAY, Y},
    {DIVIDE, TI, X, Y},
    {MULTIPLY, TD, DELAY, LAG},
    {MULTIPLY, TD, TD, HALF},
    {MULTIPLY, X, DELAY, C0_3},
    {ADD, X, X, LAG},
    {DIVIDE, TD, TD, X},
    {SUBTRACT, Y, LAG, DELAY},
    {END, 0, 0, 0},
};

// A rule of Ku and Tu. classic_rule sets KP, TI and TD to its factors first.
static const struct operation classic[] FIXPID_AUTOTUNE_FLASH = {
    {MULTIPLY, KP, ULTIMATE, KP},
    {DIVIDE, TI, PERIOD, TI},
    {MULTIPLY, TD, PERIOD, TD},
    {END, 0, 0, 0},
};

static const struct operation gains_of_times[] FIXPID_AUTOTUNE_FLASH = {
    {DIVIDE, KI, KP, TI},
    {MULTIPLY, KD, KP, TD},
    {END, 0, 0, 0},
};

static void take(FIXPID_DATA const struct sheet *sheet,
                 FIXPID_DATA struct number16 *number, uint8_t which)
{
    if (which < (uint8_t)ONE) {
        number->mantissa = sheet->numbers[which].mantissa;
        number->exponent = sheet->numbers[which].exponent;
    } else {
        const struct constant *const constant =
            &constants[which - (uint8_t)ONE];

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

// Does the operations of a table, up to its END.
static void calculate(FIXPID_DATA struct sheet *sheet,
                      const struct operation *table)
{
    const struct operation *operation = table;
    uint8_t verb = flash_byte(&operation->verb);

    while (verb != (uint8_t)END) {
        FIXPID_DATA struct number16 *const to =
            &sheet->numbers[flash_byte(&operation->to)];
        struct number16 a;
        struct number16 b;

        take(sheet, &a, flash_byte(&operation->a));
        take(sheet, &b, flash_byte(&operation->b));
        switch (verb) {
        case MULTIPLY:
            multiply(to, &a, &b);
            break;
        case DIVIDE:
            divide(to, &a, &b);
            break;
        case ADD:
            add(to, &a, &b);
            break;
        case SUBTRACT:
            subtract(to, &a, &b);
            break;
        default:
            choose(to, &a, &b, verb == (uint8_t)MINIMUM);
            break;
        }
        operation++;
        verb = flash_byte(&operation->verb);
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

// The numbers of one relay. False if its sums make no sense.
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
    set(sheet, CYCLES, SELF.config.cycles, (relay == 0u) ? 1 : 0);
    set(sheet, RELAY,
        fixpid_autotune_span(self, (uint8_t)(PHASE_FIRST + relay)), 0);
    set(sheet, AREA, (uint32_t)area, 0);
    set(sheet, STEPS, sums->steps, 0);
    set(sheet, HIGH_STEPS, sums->on_steps, 0);
    set(sheet, LOW_STEPS, (uint16_t)(sums->steps - sums->on_steps), 0);
    set(sheet, RISE, rise, 0);
    calculate(sheet, relay_numbers);
    if (sums->rise < 0) {
        set(sheet, TURN, 0, 0);
    }
    return true;
}

// FLAT, unless the process shows no static gain.
static void measure_gain(FIXPID_DATA struct sheet *sheet,
                         FIXPID_DATA const struct fixpid_autotune *self)
{
    const uint16_t swing =
        (uint16_t)((uint16_t)SELF.highest - (uint16_t)SELF.lowest);
    const int32_t measured =
        deviation_q8(&SELF.sums[0]) - deviation_q8(&SELF.sums[1]);
    const int32_t driven = output_q8(self, 0) - output_q8(self, 1);

    set(sheet, SWING, swing, 0);
    set(sheet, NOISE, (SELF.noise * UINT32_C(3)) >> 2, -4);
    set(sheet, FLAT, 0, 0);
    if (measured <= ((int32_t)swing * 16)) { // a 16th of the swing
        return;
    }
    if (driven > 0) {
        // 1/256 of a count, both
        make(&sheet->numbers[X], (uint32_t)driven, 0);
        make(&sheet->numbers[Y], (uint32_t)measured, 0);
        divide(&sheet->numbers[FLAT], &sheet->numbers[X], &sheet->numbers[Y]);
    }
}

// No process is less round than one of a single lag. A larger RATIO means that
// the load has changed.
static void limit_ratio(FIXPID_DATA struct sheet *sheet)
{
    calculate(sheet, expected_round);
    while (!is_zero(sheet, Y)) {
        calculate(sheet, smaller_ratio);
        if (is_zero(sheet, Y)) {
            break;
        }
        calculate(sheet, expected_round);
    }
    calculate(sheet, one_lag);
    if (is_zero(sheet, Y)) {
        set(sheet, FLAT, 0, 0);
        set(sheet, RATIO, 0, 0);
    }
}

// The process, SLOPE to LATER, and its DELAY. False if there is none.
static bool identify(FIXPID_DATA struct sheet *sheet,
                     FIXPID_DATA const struct fixpid_autotune *self)
{
    if (SELF.state != (uint8_t)FIXPID_AUTOTUNE_DONE) {
        return false;
    }
    if (!measure_relay(sheet, self, 1)) {
        return false;
    }
    calculate(sheet, keep_second);
    if (!measure_relay(sheet, self, 0)) {
        return false;
    }
    measure_gain(sheet, self);
    calculate(sheet, both_relays);
    limit_ratio(sheet);
    calculate(sheet, expected_round);
    calculate(sheet, dead_time);
    if (!is_zero(sheet, FLAT)) {
        calculate(sheet, lag_and_gain);
    }
    return true;
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
    multiply(part, &sheet->numbers[FLAT], part);
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
                           struct fixpid_autotune_process *model)
{
    struct sheet sheet;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(model != 0);
    if (!identify(&sheet, self)) {
        return false;
    }
    model->gain_q8 = FIXPID_AUTOTUNE_INTEGRATING;
    model->lag_q4 = FIXPID_AUTOTUNE_INTEGRATING;
    if (!is_zero(&sheet, FLAT)) {
        model->gain_q8 = integer(&sheet.numbers[Y], 8);
        model->lag_q4 = integer(&sheet.numbers[LAG], 4);
    }
    model->dead_q4 = integer(&sheet.numbers[DEAD], 4);
    model->slope_q24 = integer(&sheet.numbers[SLOPE], 24);
    model->ultimate_q8 = integer(&sheet.numbers[ULTIMATE], 8);
    model->period_q4 = integer(&sheet.numbers[PERIOD], 4);
    model->holding = holding(&sheet, self);
    model->noise_q4 = (uint16_t)((SELF.noise + 2u) >> 2);
    model->hysteresis = (uint16_t)fixpid_autotune_hysteresis(self);
    return true;
}

// kp_q8 = 256 KP / Ku, reset_q8 = 256 Tu / TI, rate_q8 = 256 TD / Tu
static void classic_rule(FIXPID_DATA struct sheet *sheet, uint8_t kp_q8,
                         uint16_t reset_q8, uint8_t rate_q8)
{
    set(sheet, KP, kp_q8, -8);
    set(sheet, TI, reset_q8, -8);
    set(sheet, TD, rate_q8, -8);
    calculate(sheet, classic);
}

// A table for an integrator, and what a lag changes in it.
static void process_rule(FIXPID_DATA struct sheet *sheet,
                         const struct operation *integrator,
                         const struct operation *of_lag)
{
    set(sheet, TD, 0, 0);
    set(sheet, Y, 1, 0);
    calculate(sheet, integrator);
    if (!is_zero(sheet, FLAT)) {
        calculate(sheet, of_lag);
    }
}

static void apply_rule(FIXPID_DATA struct sheet *sheet, uint8_t rule,
                       uint8_t robustness_q4)
{
    set(sheet, ROBUST, (uint32_t)robustness_q4 + 16u, -4);
    switch (rule) {
    case FIXPID_AUTOTUNE_SIMC_PI:
        process_rule(sheet, simc, simc_of_lag);
        break;
    case FIXPID_AUTOTUNE_AMIGO_PI:
        process_rule(sheet, amigo_pi, amigo_pi_of_lag);
        break;
    case FIXPID_AUTOTUNE_AMIGO_PID:
        process_rule(sheet, amigo_pid, amigo_pid_of_lag);
        break;
    case FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI:
        classic_rule(sheet, 80, 116, 0);
        break;
    case FIXPID_AUTOTUNE_TYREUS_LUYBEN_PID:
        classic_rule(sheet, 116, 116, 41);
        break;
    case FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PI:
        classic_rule(sheet, 115, 307, 0);
        break;
    default:
        classic_rule(sheet, 154, 512, 32);
        break;
    }
}

// The gains of KP, TI and TD. False if one is out of its range.
static bool fold(FIXPID_DATA struct sheet *sheet,
                 struct fixpid_pid_gains *gains)
{
    uint32_t lag_steps = integer(&sheet->numbers[TD], 0) >> 3;
    uint8_t filter = 0;
    uint32_t kp_q8;
    uint32_t ki_q24;
    uint32_t kd_q8;

    while (lag_steps > 1u) {
        lag_steps >>= 1;
        filter++;
    }
    if (filter > FIXPID_PID_FILTER_MAX) {
        filter = FIXPID_PID_FILTER_MAX;
    }
    calculate(sheet, gains_of_times);
    kp_q8 = integer(&sheet->numbers[KP], 8);
    ki_q24 = integer(&sheet->numbers[KI], 24);
    kd_q8 = integer(&sheet->numbers[KD], (int8_t)(8 - (int8_t)filter));
    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (ki_q24 < KI_MIN) {
        return false;
    }
    if (ki_q24 > FIXPID_PID_KI_MAX) {
        return false;
    }
    if (kd_q8 > FIXPID_PID_KD_MAX) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp_q8;
    gains->ki_q24 = ki_q24;
    gains->kd_q8 = (uint16_t)kd_q8;
    gains->derivative_filter = filter;
    return true;
}

static bool rule_legal(uint8_t rule, uint8_t robustness_q4)
{
    if (rule > (uint8_t)FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PID) {
        return false;
    }
    if (robustness_q4 < ROBUSTNESS_MIN) {
        return false;
    }
    return robustness_q4 <= ROBUSTNESS_MAX;
}

bool fixpid_autotune_result(FIXPID_DATA const struct fixpid_autotune *self,
                            uint8_t rule, uint8_t robustness_q4,
                            struct fixpid_pid_config *config)
{
    struct sheet sheet;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(config != 0);
    if (!rule_legal(rule, robustness_q4)) {
        return false;
    }
    if (!identify(&sheet, self)) {
        return false;
    }
    apply_rule(&sheet, rule, robustness_q4);
    if (!fold(&sheet, &config->gains)) {
        return false;
    }
    config->setpoint_weight_q8 = WEIGHT_ONE;
    config->proportional_on_measurement = false;
    if (rule == (uint8_t)FIXPID_AUTOTUNE_AMIGO_PID) {
        if (!is_zero(&sheet, Y)) { // more lag than dead time
            config->setpoint_weight_q8 = 0;
            config->proportional_on_measurement = true;
        }
    }
    return true;
}
