// SPDX-License-Identifier: MIT
// What the experiment found: the process, and gains for it. It has its own file
// because SDCC links whole object files.
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_equations.h"
#include "fixpid_autotune_private.h"

#define ROBUSTNESS_MIN 8u
#define ROBUSTNESS_MAX 64u
#define KI_MIN 8u
#define ROBUST_MORE UINT32_C(18)
#define WEIGHT_ONE 256u

// Farther than any two outputs are from each other, in 1/256 of a count.
#define FAR_Q8 UINT32_C(0x40000000)

struct sheet {
    struct number16 numbers[END];
    int32_t deviation_q8[2]; // the mean with each relay, in 1/256 of a count
    int32_t output_q8[2];
};

static void copy(FIXPID_DATA struct number16 *to,
                 FIXPID_DATA const struct number16 *from)
{
    // The analyzer does not see that a table sets each number before its
    // use. NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign)
    to->mantissa = from->mantissa;
    to->exponent = from->exponent;
}

static void take(FIXPID_DATA const struct sheet *sheet, uint8_t which,
                 FIXPID_DATA struct number16 *number)
{
    if ((which & CONSTANT) == 0u) {
        copy(number, &sheet->numbers[which]);
    } else {
        const struct number16 *const constant =
            &constants[which & (uint8_t)~CONSTANT];

        number->mantissa = flash_word(&constant->mantissa);
        number->exponent =
            (int8_t)flash_byte((const uint8_t *)&constant->exponent);
    }
}

// a = a verb b
static void apply(FIXPID_DATA struct number16 *a, uint8_t verb,
                  FIXPID_DATA const struct number16 *b)
{
    switch (verb) {
    case TIMES:
        multiply(a, b);
        break;
    case OVER:
        divide(a, b);
        break;
    case PLUS:
        add(a, b);
        break;
    case MINUS:
        subtract(a, b);
        break;
    default:
        if (greater(a, b) == (verb == (uint8_t)LESSER)) {
            copy(a, b);
        }
        break;
    }
}

// The result of an equation, whose second token is `token`. Returns the token
// behind it.
static const uint8_t *solve(FIXPID_DATA const struct sheet *sheet,
                            const uint8_t *token,
                            FIXPID_DATA struct number16 *result)
{
    const uint8_t *last = token;
    uint8_t verb = flash_byte(&last[1]);
    uint8_t joint = PLUS; // of the sum and the next term
    struct number16 sum;
    struct number16 term;
    struct number16 number;

    make(&sum, 0, 0);
    take(sheet, flash_byte(last), &term);
    while (verb >= (uint8_t)TIMES) {
        last = &last[2];
        take(sheet, flash_byte(last), &number);
        if (verb <= (uint8_t)OVER) {
            apply(&term, verb, &number);
        } else {
            apply(&sum, joint, &term);
            joint = verb;
            copy(&term, &number);
        }
        verb = flash_byte(&last[1]);
    }
    apply(&sum, joint, &term);
    copy(result, &sum);
    return &last[1];
}

static void calculate(FIXPID_DATA struct sheet *sheet, const uint8_t *table)
{
    const uint8_t *token = table;
    uint8_t which = flash_byte(token);

    while (which != (uint8_t)END) {
        token = solve(sheet, &token[1], &sheet->numbers[which]);
        which = flash_byte(token);
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

static bool above(FIXPID_DATA const struct sheet *sheet, uint8_t which,
                  uint8_t limit)
{
    struct number16 a;
    struct number16 b;

    take(sheet, which, &a);
    take(sheet, limit, &b);
    return greater(&a, &b);
}

static uint32_t magnitude(int32_t x)
{
    return (uint32_t)((x < 0) ? fixpid_sub32(0, x) : x);
}

static int32_t with_sign_of(int32_t sign, uint32_t value)
{
    return (sign < 0) ? fixpid_sub32(0, (int32_t)value) : (int32_t)value;
}

// scale * total / steps, in two parts. pre: total / steps is below 2^16. (A
// remainder by % would link SDCC's function for it.)
static int32_t part_of(int32_t total, uint16_t steps, uint16_t scale)
{
    const uint32_t all = magnitude(total);
    const uint16_t whole = (uint16_t)(all / steps);
    const uint16_t rest = (uint16_t)(all - ((uint32_t)whole * steps));

    return with_sign_of(total, ((uint32_t)whole * scale) +
                                   (((uint32_t)rest * scale) / steps));
}

static uint16_t swing(FIXPID_DATA const struct fixpid_autotune *self)
{
    return (uint16_t)((uint16_t)SELF.highest - (uint16_t)SELF.lowest);
}

// What the deviation lies below its mean while the output is high, times the
// steps.
static int32_t area(FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    const int32_t mean = part_of(sums->all, sums->steps, sums->on_steps);

    // Both sums are within 32767^2, and half the rise within 16376.
    return fixpid_sub32(fixpid_sub32(mean, sums->on), sums->rise / 2);
}

// The numbers of one relay. False if it has no area, or not both sides.
static bool measure_relay(FIXPID_DATA struct sheet *sheet,
                          FIXPID_DATA const struct fixpid_autotune *self,
                          uint8_t relay)
{
    const uint8_t phase = (uint8_t)(PHASE_FIRST + relay);
    const uint16_t counts = fixpid_autotune_span(self, phase);
    FIXPID_DATA const struct fixpid_autotune_sums *const sums =
        &SELF.sums[relay];
    const uint16_t steps = sums->steps;
    const uint16_t on_steps = sums->on_steps;
    const uint32_t driven = (uint32_t)counts * on_steps; // above low
    int32_t lobes;

    if (on_steps == 0u) {
        return false;
    }
    if (on_steps >= steps) {
        return false;
    }
    lobes = area(sums);
    if (lobes <= 0) {
        return false;
    }
    sheet->deviation_q8[relay] = part_of(sums->all, steps, 256);
    sheet->output_q8[relay] =
        ((int32_t)fixpid_autotune_level(self, phase, AT_LOW) * 256) +
        part_of((int32_t)driven, steps, 256);
    set(sheet, CYCLES, SELF.config.cycles, (relay == 0u) ? 1 : 0);
    set(sheet, RELAY, counts, 0);
    set(sheet, AREA, (uint32_t)lobes, 0);
    set(sheet, STEPS, steps, 0);
    set(sheet, HIGH_STEPS, on_steps, 0);
    set(sheet, TURNS, magnitude(sums->rise), 0);
    calculate(sheet, one_relay);
    if (sums->rise < 0) {
        set(sheet, TURN, 0, 0);
    }
    return true;
}

// A PI is safe for these. A cause why a PID is not.
static uint8_t refuse_for_pid(FIXPID_DATA const struct sheet *sheet)
{
    if (!above(sheet, ROUNDNESS, C0_3)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    if (above(sheet, HYSTERESIS, C1_5)) {
        return FIXPID_AUTOTUNE_SHAPE;
    }
    if (above(sheet, SPREAD, HALF)) {
        return FIXPID_AUTOTUNE_TWO_PROCESSES;
    }
    return FIXPID_AUTOTUNE_NO_REASON;
}

// The wave that both relays tell of. A cause why the rule does not serve it.
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
    set(sheet, SWING, swing(self), 0);
    set(sheet, NOISE, (SELF.noise * UINT32_C(3)) >> 2, -4);
    calculate(sheet, wave);
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PID) {
        return refuse_for_pid(sheet);
    }
    if (above(sheet, SPREAD, HALF)) {
        calculate(sheet, quicker);
    }
    return FIXPID_AUTOTUNE_NO_REASON;
}

// More measurement is held with less output. Where the slopes differ, the means
// shift by themselves, and a PI does not mind.
static bool runs_away(FIXPID_DATA const struct sheet *sheet, uint8_t rule)
{
    if (!above(sheet, RATIO, C0_06)) {
        return false;
    }
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PID) {
        return true;
    }
    return !above(sheet, SPREAD, C0_2);
}

// The ratio, as the means have it. False if the process runs away.
static bool measure_gain(FIXPID_DATA struct sheet *sheet,
                         FIXPID_DATA const struct fixpid_autotune *self,
                         uint8_t rule)
{
    const int32_t measured = sheet->deviation_q8[0] - sheet->deviation_q8[1];
    const int32_t driven = sheet->output_q8[0] - sheet->output_q8[1];

    set(sheet, DRIVEN, magnitude(driven), 0);
    if (measured > ((int32_t)swing(self) * 16)) { // a 16th of the swing
        set(sheet, ANSWERED, (uint32_t)measured, 0);
        calculate(sheet, ratio_of_means);
        if (driven <= 0) {
            if (runs_away(sheet, rule)) {
                return false;
            }
            set(sheet, RATIO, 0, 0);
        }
    }
    return true;
}

// No process is less round than one of a single lag. A larger ratio means that
// the load has moved.
static void limit_ratio(FIXPID_DATA struct sheet *sheet)
{
    calculate(sheet, lag_roundness);
    while (above(sheet, LAG_ROUNDNESS, LIMIT)) {
        if (!above(sheet, RATIO, C1_256TH)) {
            break;
        }
        calculate(sheet, smaller_ratio);
        calculate(sheet, lag_roundness);
    }
    calculate(sheet, least_ratio);
    if (!above(sheet, LEAST_RATIO, C0_03)) {
        set(sheet, RATIO, 0, 0);
    }
}

// The process of an experiment that is done, TRUE_SLOPE to LAG. A cause why
// there is none that the rule serves.
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
    calculate(sheet, true_slope);
    if (is_zero(sheet, RATIO)) {
        set(sheet, NOISE_PART, fixpid_autotune_noise_band(self), 0);
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
    const int32_t off = shift_right_floor(sheet->deviation_q8[0], 1) +
                        shift_right_floor(sheet->deviation_q8[1], 1);
    int32_t output = shift_right_floor(sheet->output_q8[0], 1) +
                     shift_right_floor(sheet->output_q8[1], 1);
    uint32_t taken;

    set(sheet, FACTOR, magnitude(off), 0);
    apply(&sheet->numbers[FACTOR], TIMES, &sheet->numbers[LEVEL]);
    taken = integer(&sheet->numbers[FACTOR], 0);
    if (taken > FAR_Q8) {
        taken = FAR_Q8;
    }
    output -= with_sign_of(off, taken);
    output = shift_right_floor(output + 128, 8);
    return (int16_t)clamp32(output, SELF.config.output_min,
                            SELF.config.output_max);
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
        process->gain_q8 = integer(&sheet.numbers[GAIN], 8);
        process->lag_q4 = integer(&sheet.numbers[LAG], 4);
    }
    process->dead_q4 = integer(&sheet.numbers[DELAY], 3); // half of it
    process->slope_q24 = integer(&sheet.numbers[TRUE_SLOPE], 24);
    process->holding = holding(&sheet, self);
    process->noise_q4 = (uint16_t)((SELF.noise + 2u) >> 2);
    process->hysteresis = SELF.edge;
    return true;
}

static void apply_rule(FIXPID_DATA struct sheet *sheet, uint8_t rule,
                       uint8_t robustness_q4)
{
    const bool integrating = is_zero(sheet, FLATNESS);

    set(sheet, ROBUST, robustness_q4 + ROBUST_MORE, -5);
    calculate(sheet, pi_gains);
    if (rule == (uint8_t)FIXPID_AUTOTUNE_PI) {
        if (!integrating) {
            calculate(sheet, pi_of_lag);
        }
    } else {
        calculate(sheet, pid_gains);
        calculate(sheet, integrating ? pid_of_integrator : pid_of_lag);
    }
    calculate(sheet, ki_and_kd);
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

// The gains of KP, KI and KD. A cause why one is out of its range.
static uint8_t fold(FIXPID_DATA const struct sheet *sheet, uint8_t filter,
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
