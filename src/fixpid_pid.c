// SPDX-License-Identifier: MIT
#include "fixpid_pid.h"

#include "fixpid_pid_self.h"

// Private bits of `options`; the lowest three are the derivative filter.
#define FILTER 0x07u
#define KI_FINE 0x08u   // ki has 24 fractional bits; neither bit: 16
#define KI_COARSE 0x10u // ki has 8
#define WEIGHTED 0x20u  // the setpoint weight is below 1
#define PUBLIC_OPTIONS (FIXPID_PID_REVERSE | FIXPID_PID_DERIVATIVE_ON_ERROR)
#define SPECIAL (PUBLIC_OPTIONS | WEIGHTED) // a plain PID has none of them

#define WEIGHT_ONE 256u
#define KI_KEPT_MAX 32767u
#define KI_MIDDLE_MAX UINT32_C(8388479)    // rounds to 32767 * 256
#define DERIVATIVE_MAX INT32_C(0x3F000000) // 2^30 - 2^24

// The signals of one step. A compiler that inlines keeps them in registers;
// SDCC reaches an object by name much faster than a local one.
struct signals {
    int32_t others;   // P + D + feed-forward, Q24.8
    int32_t integral; // the candidate, Q16.16
    int16_t error;
    int16_t input;    // what the derivative sees: it falls with the error
    uint8_t fraction; // the candidate's next eight bits
};

#if defined(__SDCC_pic14) || defined(__SDCC_pic16) || defined(__SDCC_mcs51)
FIXPID_DATA struct signals FIXPID_PID_SIGNALS_PLACE fixpid_pid_signals;
#define NOW fixpid_pid_signals
#define LOCAL_SIGNALS FIXPID_DATA struct signals *const now = &NOW
#else
#define NOW (*now)
#define LOCAL_SIGNALS                                                          \
    struct signals signals;                                                    \
    struct signals *const now = &signals
#endif

// ki becomes 15 bits with one of three exponents, rounded to the nearest.
static bool take_gains(FIXPID_DATA struct fixpid_pid *self,
                       const struct fixpid_pid_gains *gains)
{
    uint32_t ki = gains->ki_q24;
    const uint16_t kp_q8 = gains->kp_q8;
    const uint16_t kd_q8 = gains->kd_q8;
    const uint8_t filter = gains->derivative_filter;

    FIXPID_ASSERT(VALID(self));
    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (ki > FIXPID_PID_KI_MAX) {
        return false;
    }
    if (kd_q8 > FIXPID_PID_KD_MAX) {
        return false;
    }
    if (filter > FIXPID_PID_FILTER_MAX) {
        return false;
    }
    SELF.options = (uint8_t)((SELF.options & SPECIAL) | filter);
    SELF.kp = kp_q8;
    SELF.kd = kd_q8;
    if (ki <= KI_KEPT_MAX) {
        SELF.options |= KI_FINE;
    } else if (ki <= KI_MIDDLE_MAX) {
        ki = (ki + 128u) >> 8;
    } else {
        ki = (ki + 32768u) >> 16;
        SELF.options |= KI_COARSE;
    }
    SELF.ki = (uint16_t)ki;
    return true;
}

static bool take_config(FIXPID_DATA struct fixpid_pid *self,
                        const struct fixpid_pid_config *config)
{
    const uint16_t weight_q8 = config->setpoint_weight_q8;

    FIXPID_ASSERT(VALID(self));
    SELF.options = config->options;
    SELF.setpoint_weight = (uint8_t)weight_q8;
    SELF.integral_min = config->integral_min;
    SELF.integral_max = config->integral_max;
    if (SELF.integral_min < -INT16_MAX) {
        return false;
    }
    if (SELF.integral_min > SELF.integral_max) {
        return false;
    }
    if ((SELF.options & (uint8_t)~PUBLIC_OPTIONS) != 0u) {
        return false;
    }
    if (weight_q8 > WEIGHT_ONE) {
        return false;
    }
    if (weight_q8 < WEIGHT_ONE) {
        SELF.options |= WEIGHTED;
    }
    SELF.output_min = config->output_min;
    SELF.output_max = config->output_max;
    if (SELF.output_min >= SELF.output_max) {
        return false;
    }
    return take_gains(self, &config->gains);
}

// No gains, and no room for an integral or an output.
static void refuse(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.options = 0;
    SELF.kp = 0;
    SELF.ki = 0;
    SELF.kd = 0;
    SELF.output_min = 0;
    SELF.output_max = 0;
    SELF.integral_min = 0;
    SELF.integral_max = 0;
}

bool fixpid_pid_init(FIXPID_DATA struct fixpid_pid *self,
                     const struct fixpid_pid_config *config)
{
    bool legal;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(config != 0);
    legal = take_config(self, config);
    if (!legal) {
        refuse(self);
    }
    fixpid_pid_reset(self);
    return legal;
}

void fixpid_pid_reset(FIXPID_DATA struct fixpid_pid *self)
{
    int16_t rest = 0;

    FIXPID_ASSERT(VALID(self));
    FIXPID_CLAMP(rest, SELF.integral_min, SELF.integral_max);
    SELF.integral = FIXPID_RAISED(rest, 16);
    SELF.integral_fraction = 0;
    SELF.derivative = 0;
    SELF.previous = 0;
    SELF.proportional_error = 0;
    SELF.feedforward = 0;
    SELF.status = FIXPID_PID_FIRST;
}

bool fixpid_pid_set_gains(FIXPID_DATA struct fixpid_pid *self,
                          const struct fixpid_pid_gains *gains)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    if (REFUSED) {
        return false;
    }
    return take_gains(self, gains);
}

// The proportional term's own error: of b * setpoint, rounded half up.
static void weigh(FIXPID_DATA struct fixpid_pid *self,
                  FIXPID_DATA struct signals *now, int16_t setpoint)
{
    int32_t product; // within 255 * 32768
    int16_t weighted;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    FIXPID_SIGNED_PRODUCT(product, SELF.setpoint_weight, setpoint);
    product += 128;
    weighted = (int16_t)FIXPID_FLOOR(product, 8);
    if ((SELF.options & FIXPID_PID_REVERSE) != 0u) {
        weighted = FIXPID_MIRRORED(weighted);
    }
    FIXPID_SATURATED_DIFFERENCE(SELF.proportional_error, weighted, NOW.input);
}

// The errors in reverse, with a setpoint weight, or with the derivative on the
// error. Reverse takes the mirror images of all inputs, which turns their
// differences round.
static void compare_specially(FIXPID_DATA struct fixpid_pid *self,
                              FIXPID_DATA struct signals *now, int16_t setpoint,
                              int16_t measurement)
{
    int16_t goal = setpoint;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    NOW.input = measurement;
    if ((SELF.options & FIXPID_PID_REVERSE) != 0u) {
        goal = FIXPID_MIRRORED(setpoint);
        NOW.input = FIXPID_MIRRORED(measurement);
    }
    FIXPID_SATURATED_DIFFERENCE(NOW.error, goal, NOW.input);
    SELF.proportional_error = NOW.error;
    if ((SELF.options & WEIGHTED) != 0u) {
        weigh(self, now, setpoint);
    }
    if ((SELF.options & FIXPID_PID_DERIVATIVE_ON_ERROR) != 0u) {
        NOW.input = FIXPID_MIRRORED(NOW.error);
    }
}

// D = kd * (fall of the input), through the filter.
static void differentiate(FIXPID_DATA struct fixpid_pid *self,
                          FIXPID_DATA struct signals *now)
{
    int32_t derivative;
    int16_t fall;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    if ((SELF.status & FIXPID_PID_FIRST) != 0u) {
        SELF.previous = NOW.input;
    }
    FIXPID_SATURATED_DIFFERENCE(fall, SELF.previous, NOW.input);
    SELF.previous = NOW.input;
    FIXPID_SIGNED_PRODUCT(derivative, SELF.kd, fall);
    if ((SELF.options & FILTER) != 0u) {
        int32_t leak;

        FIXPID_FLOOR_BY(leak, SELF.derivative, SELF.options);
        // Both are within 2^30 - 2^24.
        derivative += SELF.derivative - leak;
        FIXPID_CLAMP(derivative, -DERIVATIVE_MAX, DERIVATIVE_MAX);
    }
    SELF.derivative = derivative;
}

// The candidate, saturated: what does not fit lies beyond every limit, too.
static void propose(FIXPID_DATA struct signals *now, int32_t integral_q8)
{
    int32_t limited = integral_q8;

    FIXPID_ASSERT(now == &NOW);
    FIXPID_CLAMP(limited, -COUNTS_MAX_Q8, COUNTS_MAX_Q8);
    NOW.integral = FIXPID_RAISED(limited, 8);
}

// The candidate I + ki * error. The limits of the integral are -32767 and 32767
// at most, so a sum that saturates lies beyond them.
static void integrate(FIXPID_DATA struct fixpid_pid *self,
                      FIXPID_DATA struct signals *now)
{
    int32_t change;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    FIXPID_SIGNED_PRODUCT(change, SELF.ki, NOW.error);
    NOW.fraction = SELF.integral_fraction;
    if ((SELF.options & KI_COARSE) != 0u) {
        // within 2^23 + 2^30
        propose(now, FIXPID_FLOOR(SELF.integral, 8) + change);
        NOW.integral += (int32_t)(uint8_t)SELF.integral;
        return;
    }
    if ((SELF.options & KI_FINE) != 0u) {
        change += (int32_t)NOW.fraction;
        NOW.fraction = (uint8_t)change;
        change = FIXPID_FLOOR(change, 8);
    }
    FIXPID_SATURATED_SUM(NOW.integral, SELF.integral, change);
}

// The candidate that makes the sum equal to the output held. It is kept, as if
// there were no error.
static void take_over(FIXPID_DATA struct fixpid_pid *self,
                      FIXPID_DATA struct signals *now)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    // within 2^31 - 2^15
    propose(now, FIXPID_FLOOR(SELF.integral, 8) - NOW.others);
    NOW.fraction = 0;
    NOW.error = 0;
}

// The candidate within the integral's limits, then the sum within the output's.
// Anti-windup: the candidate is forgotten where it pushes a limited output
// further.
static int16_t limit_and_remember(FIXPID_DATA struct fixpid_pid *self,
                                  FIXPID_DATA struct signals *now)
{
    const int16_t counts = (int16_t)FIXPID_FLOOR(NOW.integral, 16);
    int32_t output;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(now == &NOW);
    if (counts >= SELF.integral_max) {
        NOW.integral = FIXPID_RAISED(SELF.integral_max, 16);
        NOW.fraction = 0;
    } else if (counts < SELF.integral_min) {
        NOW.integral = FIXPID_RAISED(SELF.integral_min, 16);
        NOW.fraction = 0;
    } else {
        // inside
    }
    // within 2^31 - 2^15 + 128
    output = NOW.others + FIXPID_FLOOR(NOW.integral, 8) + 128;
    output = FIXPID_FLOOR(output, 8);
    if (output > SELF.output_max) {
        output = SELF.output_max;
        SELF.status = FIXPID_PID_AT_MAX;
        if (NOW.error > 0) {
            return (int16_t)output;
        }
    } else if (output < SELF.output_min) {
        output = SELF.output_min;
        SELF.status = FIXPID_PID_AT_MIN;
        if (NOW.error < 0) {
            return (int16_t)output;
        }
    } else {
        SELF.status = 0;
    }
    SELF.integral = NOW.integral;
    SELF.integral_fraction = NOW.fraction;
    return (int16_t)output;
}

int16_t fixpid_pid_step(FIXPID_DATA struct fixpid_pid *self, int16_t setpoint,
                        int16_t measurement)
{
    LOCAL_SIGNALS;

    FIXPID_ASSERT(VALID(self));
    if ((SELF.options & SPECIAL) == 0u) {
        FIXPID_SATURATED_DIFFERENCE(NOW.error, setpoint, measurement);
        SELF.proportional_error = NOW.error;
        NOW.input = measurement;
    } else {
        compare_specially(self, now, setpoint, measurement);
    }
    FIXPID_SIGNED_PRODUCT(NOW.others, SELF.kp, SELF.proportional_error);
    differentiate(self, now);
    // within 2^30 - 2^15 + 2^30 - 2^24 + 2^23
    NOW.others += SELF.derivative + FIXPID_RAISED(SELF.feedforward, 8);
    if ((SELF.status & HELD) == 0u) {
        integrate(self, now);
    } else if ((SELF.status & FIXPID_PID_MANUAL) == 0u) {
        take_over(self, now);
    } else {
        SELF.status = FIXPID_PID_MANUAL;
        return (int16_t)FIXPID_FLOOR(SELF.integral, 16);
    }
    return limit_and_remember(self, now);
}
