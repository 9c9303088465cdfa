// SPDX-License-Identifier: MIT
#include "fixpid_pid.h"

#include <limits.h>

#include "fixpid_pid_accept.h"
#include "fixpid_pid_private.h"

#define SPECIAL (REVERSE | ON_ERROR | WEIGHTED)

// The bits that a configuration must not have without the feature: a bool, or
// those of a weight that is neither 0 nor WEIGHT_ONE.
#define NO_REVERSE (HAS_REVERSE ? 0u : 1u)
#define NO_ON_ERROR (HAS_DERIVATIVE_ON_ERROR ? 0u : 1u)
#define NO_WEIGHT (HAS_WEIGHT ? 0u : 0xFEFFu)
#define ONE_IF_WEIGHT (HAS_WEIGHT ? 1u : 0u) // otherwise NO_WEIGHT refuses it

// The lowest three bits of `options` are the derivative filter. The sign bit is
// the one that a PID with small gains tests in each step.
#define FILTER (HAS_FILTER ? 0x07u : 0u)
#define KI_FINE 0x80u // ki has 24 fractional bits; neither bit: 16
#define KI_COARSE (HAS_COARSE_KI ? 0x10u : 0u) // ki has 8

#define FEEDFORWARD (HAS_FEEDFORWARD ? SELF.feedforward : 0)
#define KI_KEPT_MAX 32767u
#define KI_MIDDLE_MAX UINT32_C(8388479) // rounds to 32767 * 256

// The signals of one step. A compiler that inlines keeps them in registers;
// SDCC, where it gives locals fixed addresses or reaches them through a stack
// pointer, is much faster with an object that has a name.
struct signals {
    int32_t p_d_ff;   // P + D + feed-forward, Q24.8
    int32_t integral; // the candidate, Q16.16
    signal_word error;
    signal_word derivative_input; // falls with the error
    int16_t setpoint;             // for special_errors
    uint8_t fraction;             // the candidate's next eight bits
};

#if defined(__SDCC_pic14) || defined(__SDCC_pic16) || defined(__SDCC_mcs51)
#ifndef FIXPID_PID_SIGNALS_PLACE
#define FIXPID_PID_SIGNALS_PLACE
#endif
FIXPID_DATA struct signals FIXPID_PID_SIGNALS_PLACE fixpid_pid_signals;
#define NAMED_SIGNALS
#define SIGNALS fixpid_pid_signals
#define LOCAL_SIGNALS (void)self
#else
#define SIGNALS (*signals)
#define LOCAL_SIGNALS                                                          \
    struct signals now;                                                        \
    struct signals *const signals = &now
#endif

// The fall of the derivative's input since the last step, saturated, or 0 in
// the first step. Where an int has 16 bits, the caller tests the flag
// ASKED_FIRST for that. With 32 bits NO_PREVIOUS as `previous` makes it 0 here:
// the upper half of the fall is then INT16_MAX, whatever the input is. The
// upper half of a fall that does not fit is 0 or -1, and that of a flipped
// `previous` any 16 bits.
// Deviation 20.9: UINT_MAX is a macro of <limits.h>.
#if UINT_MAX > 65535u
#define ASKED_FIRST 0u
FIXPID_INLINE signal_word fall_from(int32_t previous, int32_t input)
{
    const int32_t fall = fixpid_sub32(previous, input);
    int32_t fitting = (int16_t)fall;

    if (FIXPID_SELDOM(fall != fitting)) {
        fitting = INT16_MAX ^ shift_right_floor(fall, 16);
        FIXPID_OPAQUE(fitting);
    }
    return (signal_word)fitting;
}
#else
#define ASKED_FIRST FIXPID_PID_FIRST
#define fall_from sub16_sat
#endif

// ki becomes 15 bits with one of three exponents, rounded to the nearest. Each
// decision here, and everywhere in src/, has one condition, so that tests which
// cover every branch also show that every condition matters (MC/DC).
static bool accept_gains(FIXPID_DATA struct fixpid_pid *self,
                         const struct fixpid_pid_gains *gains)
{
    const uint16_t kp_q8 = gains->kp_q8;
    uint32_t ki = gains->ki_q24;
    const uint16_t kd_q8 = gains->kd_q8;
    uint8_t options = gains->derivative_filter;

    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (ki > FIXPID_PID_KI_MAX) {
        return false;
    }
    if (kd_q8 > FIXPID_PID_KD_MAX) {
        return false;
    }
    if (options > FIXPID_PID_FILTER_MAX) {
        return false;
    }
    SELF.kp = kp_q8;
    SELF.kd = kd_q8;
    if (ki <= KI_KEPT_MAX) {
        options |= KI_FINE;
    } else if (HAS_COARSE_KI ? (ki > KI_MIDDLE_MAX) : false) {
        ki = (ki + 32768u) >> 16;
        options |= KI_COARSE;
    } else {
        ki = (ki + 128u) >> 8;
    }
    SELF.ki = (uint16_t)ki;
    SELF.options = (uint8_t)((SELF.options & SPECIAL) | options);
    return true;
}

// A bool is 0 or 1: shifting three of them is shorter than testing each. The
// weight is a machine word, because gcc for an ARM would cut each result to 16
// bits. One condition tests for everything illegal, because SDCC warns of a
// condition that is never true when no feature is missing.
static bool accept_config(FIXPID_DATA struct fixpid_pid *self,
                          const struct fixpid_pid_config *config)
{
    const uint_fast16_t weight_q8 = config->setpoint_weight_q8;
    const uint8_t reverse = config->reverse;
    const uint8_t on_error = config->derivative_on_error;
    const uint8_t weightless = config->proportional_on_measurement;
    const uint16_t most = (weightless != 0u) ? 0u : WEIGHT_ONE;
    const uint8_t too_much = (weight_q8 > most) ? ONE_IF_WEIGHT : 0u;
    const uint8_t lacking =
        (uint8_t)((uint8_t)(reverse & NO_REVERSE) |
                  (uint8_t)(on_error & NO_ON_ERROR) |
                  (uint8_t)(weightless & (uint8_t)NO_WEIGHT));

    SELF.setpoint_weight = (uint8_t)weight_q8;
    if ((too_much | lacking | (weight_q8 & NO_WEIGHT)) != 0u) {
        return false;
    }
    SELF.options =
        (uint8_t)((uint8_t)((uint8_t)(reverse << 1) | on_error) << 5) & SPECIAL;
    if (HAS_WEIGHT) {
        // A weight of 0 or WEIGHT_ONE is the plain PID's.
        if ((SELF.setpoint_weight | weightless) != 0u) {
            SELF.options |= WEIGHTED;
        }
    }
    SELF.output_min = config->output_min;
    SELF.output_max = config->output_max;
    if (SELF.output_min >= SELF.output_max) {
        return false;
    }
    if (!accept_integral_limits(self, config->integral_min,
                                config->integral_max)) {
        return false;
    }
    return accept_gains(self, &config->gains);
}

// A refused controller has no gains and no options, and its integral and its
// output can only be 0.
static void refuse(FIXPID_DATA struct fixpid_pid *self)
{
    SELF.kp = 0;
    SELF.ki = 0;
    SELF.kd = 0;
    SELF.output_min = 0;
    SELF.output_max = 0;
    SELF.integral_min = 0;
    SELF.integral_max = 0;
    SELF.options = 0;
}

bool fixpid_pid_init(FIXPID_DATA struct fixpid_pid *self,
                     const struct fixpid_pid_config *config)
{
    bool accepted;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    accepted = accept_config(self, config);
    if (!accepted) {
        refuse(self);
    }
    fixpid_pid_reset(self);
    return accepted;
}

void fixpid_pid_reset(FIXPID_DATA struct fixpid_pid *self)
{
    int16_t start = 0; // the output at rest

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.output_min > 0) {
        start = SELF.output_min;
    }
    if (SELF.output_max < 0) {
        start = SELF.output_max;
    }
    if (start < SELF.integral_min) {
        start = SELF.integral_min;
    }
    if (start > SELF.integral_max) {
        start = SELF.integral_max;
    }
    SELF.integral = whole_counts(start);
    SELF.integral_fraction = 0;
    SELF.derivative = 0;
    SELF.previous = NO_PREVIOUS;
    SELF.proportional_error = 0;
    SELF.feedforward = 0;
    SELF.output = 0;
    SELF.status = FIXPID_PID_FIRST;
}

bool fixpid_pid_set_gains(FIXPID_DATA struct fixpid_pid *self,
                          const struct fixpid_pid_gains *gains)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(gains != 0);
    if (REFUSED) {
        return false;
    }
    return accept_gains(self, gains);
}

// What the parts of a step are given. Where a name is enough, it is not passed:
// a call of SDCC's takes ten cycles of a PIC18 for the two addresses.
#if !defined(NAMED_SIGNALS)
#define GIVEN FIXPID_DATA struct fixpid_pid *self, struct signals *signals
#define PASSED self, signals
#elif defined(FIXPID_PID_OBJECT)
#undef SELF
#define SELF FIXPID_PID_OBJECT
#define GIVEN void
#define PASSED
#else
#define GIVEN FIXPID_DATA struct fixpid_pid *self
#define PASSED self
#endif

// Without the feature there are none of these, because SDCC would keep a copy.
#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_WEIGHT) != 0
// Returns b * x, rounded half up.
static int16_t weighted(uint8_t weight, int16_t x)
{
    // within 255 * 32768 + 128
    return (int16_t)shift_right_floor(mul16(weight, x) + 128, 8);
}

// Starts from rest: the integral takes over P where the setpoint is the
// measurement, so that there the output is at rest.
static void take_over_rest(FIXPID_DATA struct fixpid_pid *self, int32_t p)
{
    // within 2^23 + 2^30
    int32_t integral_q8 = fixpid_sub32(shift_right_floor(SELF.integral, 8), p);
    const int32_t counts = shift_right_floor(integral_q8, 8);

    (void)self;
    if (counts >= SELF.integral_max) {
        integral_q8 = shift_left(SELF.integral_max, 8);
    } else if (counts < SELF.integral_min) {
        integral_q8 = shift_left(SELF.integral_min, 8);
    } else {
        // inside
    }
    SELF.integral = shift_left(integral_q8, 8);
    SELF.integral_fraction = 0;
}

// Returns the proportional term's error, which is that of b * setpoint, and
// starts from rest in the first step, if nothing is held. `input` is what the
// derivative sees of the measurement.
FIXPID_APART signal_word weighted_error(FIXPID_DATA struct fixpid_pid *self,
                                        int16_t setpoint, int16_t measurement,
                                        int16_t input)
{
    int16_t goal;

    (void)self;
    if ((SELF.status & (HELD | FIXPID_PID_FIRST)) == FIXPID_PID_FIRST) {
        signal_word error;

        goal = weighted(SELF.setpoint_weight, measurement);
        if ((SELF.options & REVERSE) != 0u) {
            goal = complement(goal);
        }
        error = sub16_sat(goal, input);
        take_over_rest(self, mul16(SELF.kp, error));
    }
    goal = weighted(SELF.setpoint_weight, setpoint);
    if ((SELF.options & REVERSE) != 0u) {
        goal = complement(goal);
    }
    return sub16_sat(goal, input);
}
#else
FIXPID_INLINE signal_word weighted_error(FIXPID_DATA struct fixpid_pid *self,
                                         int16_t setpoint, int16_t measurement,
                                         int16_t input)
{
    (void)self;
    (void)setpoint;
    (void)measurement;
    (void)input;
    return 0;
}
#endif

// Computes the errors in reverse, with a setpoint weight, or with the
// derivative on the error. Reverse takes the mirror images of all inputs, which
// changes the signs of their differences. Returns the proportional term's.
static signal_word special_errors(GIVEN)
{
    const int16_t setpoint = SIGNALS.setpoint;
    const int16_t measurement = (int16_t)SIGNALS.derivative_input;
    int16_t goal = setpoint;
    signal_word p_error;

    if ((SELF.options & REVERSE) != 0u) {
        goal = complement(goal);
        SIGNALS.derivative_input = complement(measurement);
    }
    SIGNALS.error = sub16_sat(goal, SIGNALS.derivative_input);
    p_error = SIGNALS.error;
    if ((SELF.options & WEIGHTED) != 0u) {
        p_error = weighted_error(&SELF, setpoint, measurement,
                                 (int16_t)SIGNALS.derivative_input);
    }
    if ((SELF.options & ON_ERROR) != 0u) {
        SIGNALS.derivative_input = complement((int16_t)SIGNALS.error);
    }
    return p_error;
}

// D = kd * (fall of the input), through the filter.
static void differentiate(GIVEN)
{
    int32_t derivative;
    signal_word fall;

    if ((SELF.status & ASKED_FIRST) != 0u) {
        SELF.previous = SIGNALS.derivative_input;
    }
    fall = fall_from(SELF.previous, SIGNALS.derivative_input);
    SELF.previous = SIGNALS.derivative_input;
    derivative = mul16(SELF.kd, fall);
    if ((SELF.options & FILTER) != 0u) {
        // Both are within 2^30 - 2^24. The shift takes the lowest three bits of
        // the options, which are the filter.
        derivative = fixpid_add32(
            derivative,
            SELF.derivative - shift_right_by(SELF.derivative, SELF.options));
        if (derivative > DERIVATIVE_MAX) {
            derivative = DERIVATIVE_MAX;
        }
        if (derivative < -DERIVATIVE_MAX) {
            derivative = -DERIVATIVE_MAX;
        }
    }
    SELF.derivative = derivative;
}

// Returns the candidate, saturated. That is safe: every value that is cut off
// here is beyond the integral's limits anyway.
static int32_t candidate_from(int32_t integral_q8)
{
    int32_t limited = integral_q8;

    if (limited > COUNTS_MAX_Q8) {
        limited = COUNTS_MAX_Q8;
    }
    if (limited < -COUNTS_MAX_Q8) {
        limited = -COUNTS_MAX_Q8;
    }
    return shift_left(limited, 8);
}

// Sets the candidate to I + ki * error. The limits of the integral are -32767
// and 32767 at most, so a sum that saturates lies beyond them. (A PIC18's
// product stays where it is, and gcc for an AVR keeps more registers.)
#if defined(FIXPID_HAS_ADD_PRODUCT)
static void integrate(GIVEN)
{
    SIGNALS.fraction = SELF.integral_fraction;
    if ((SELF.options & KI_COARSE) != 0u) {
        // within 2^23 + 2^30
        SIGNALS.integral =
            candidate_from(fixpid_add32(mul16(SELF.ki, SIGNALS.error),
                                        shift_right_floor(SELF.integral, 8)));
        SIGNALS.integral += (int32_t)(uint8_t)SELF.integral;
    } else {
        SIGNALS.integral =
            add_product(SELF.integral, &SIGNALS.fraction, SELF.ki,
                        SIGNALS.error, (SELF.options & KI_FINE) != 0u);
    }
}
#else
static void integrate(GIVEN)
{
    int32_t change = mul16(SELF.ki, SIGNALS.error);

    SIGNALS.fraction = SELF.integral_fraction;
    if ((SELF.options & KI_COARSE) != 0u) {
        // within 2^23 + 2^30
        SIGNALS.integral = candidate_from(
            fixpid_add32(shift_right_floor(SELF.integral, 8), change));
        SIGNALS.integral += (int32_t)(uint8_t)SELF.integral;
    } else {
        if ((SELF.options & KI_FINE) != 0u) {
            change += (int32_t)SIGNALS.fraction;
            SIGNALS.fraction = (uint8_t)change;
            change = shift_right_floor(change, 8);
        }
        SIGNALS.integral = add32_sat(SELF.integral, change);
    }
}
#endif

// Sets the candidate that makes the sum equal to the output held. The step
// keeps it, as if there were no error.
static void take_over(GIVEN)
{
    // within 2^31 - 2^15
    SIGNALS.integral = candidate_from(
        fixpid_sub32(shift_right_floor(SELF.integral, 8), SIGNALS.p_d_ff));
    SIGNALS.fraction = 0;
    SIGNALS.error = 0;
}

// Keeps the candidate within the integral's limits and then the sum within the
// output's. Anti-windup: a candidate that pushes a limited output further is
// forgotten.
// Deviation 40 lines: splitting it would cost 50 cycles on a PIC18.
static int16_t limit_and_remember(GIVEN)
{
    const int16_t counts = (int16_t)shift_right_floor(SIGNALS.integral, 16);
    uint_fast8_t flags = 0;
    counts_word output;

    if (FIXPID_SELDOM(reaches(SELF.integral_max, counts, SIGNALS.integral))) {
        if (!is_just(SELF.integral_max, counts, SIGNALS.integral,
                     SIGNALS.fraction)) {
            flags = FIXPID_PID_INTEGRAL_AT_LIMIT;
        }
        SIGNALS.integral = whole_counts(SELF.integral_max);
        SIGNALS.fraction = 0;
    } else if (FIXPID_SELDOM(
                   !reaches(SELF.integral_min, counts, SIGNALS.integral))) {
        flags = FIXPID_PID_INTEGRAL_AT_LIMIT;
        SIGNALS.integral = whole_counts(SELF.integral_min);
        SIGNALS.fraction = 0;
    } else {
        // inside
    }
    output = rounded_counts(SIGNALS.p_d_ff, SIGNALS.integral);
    if (FIXPID_SELDOM(output > SELF.output_max)) {
        output = SELF.output_max;
        flags |= FIXPID_PID_AT_MAX;
        if (SIGNALS.error > 0) {
            SELF.status = (uint8_t)flags;
            return (int16_t)output;
        }
    } else if (FIXPID_SELDOM(output < SELF.output_min)) {
        output = SELF.output_min;
        flags |= FIXPID_PID_AT_MIN;
        if (SIGNALS.error < 0) {
            SELF.status = (uint8_t)flags;
            return (int16_t)output;
        }
    } else {
        // inside
    }
    SELF.status = (uint8_t)flags;
    SELF.integral = SIGNALS.integral;
    SELF.integral_fraction = SIGNALS.fraction;
    return (int16_t)output;
}

// The output held by hand. set_manual and set_limits keep it within the
// output's limits, but a flipped bit may move it out. Without the feature it
// does nothing, because SDCC would keep a copy of it.
#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_MANUAL) != 0
static int16_t held_output(FIXPID_DATA const struct fixpid_pid *self)
{
    // A machine word, because gcc for an RV32EC would extend 16 bits at each
    // use.
    const int_fast16_t output =
        (int_fast16_t)shift_right_floor(SELF.integral, 16);

    (void)self;
    if (output > SELF.output_max) {
        return SELF.output_max;
    }
    if (output < SELF.output_min) {
        return SELF.output_min;
    }
    return (int16_t)output;
}
#else
FIXPID_INLINE int16_t held_output(FIXPID_DATA const struct fixpid_pid *self)
{
    (void)self;
    return 0;
}
#endif

// P + D + feed-forward is within 2^30 - 2^15 + 2^30 - 2^24 + 2^23.
int16_t fixpid_pid_step(FIXPID_DATA struct fixpid_pid *self, int16_t setpoint,
                        int16_t measurement)
{
    LOCAL_SIGNALS;
    signal_word p_error;
    int16_t output;

    FIXPID_ASSERT(VALID_SELF);
    SIGNALS.derivative_input = measurement;
    if ((SELF.options & SPECIAL) == 0u) {
        SIGNALS.error = sub16_sat(setpoint, measurement);
        p_error = SIGNALS.error;
    } else {
        SIGNALS.setpoint = setpoint;
        p_error = special_errors(PASSED);
    }
    SELF.proportional_error = (int16_t)p_error;
    SIGNALS.p_d_ff = mul16(SELF.kp, p_error);
    differentiate(PASSED);
    SIGNALS.p_d_ff =
        add32_apart(fixpid_add32(SIGNALS.p_d_ff, shift_left(FEEDFORWARD, 8)),
                    SELF.derivative);
    if ((SELF.status & HELD) == 0u) {
        integrate(PASSED);
    } else if ((SELF.status & FIXPID_PID_MANUAL) == 0u) {
        take_over(PASSED);
    } else {
        SELF.status = FIXPID_PID_MANUAL;
        output = held_output(self);
        if (HAS_TRACK) {
            SELF.output = output;
        }
        return output;
    }
    output = limit_and_remember(PASSED);
    if (HAS_TRACK) {
        SELF.output = output;
    }
    return output;
}
