// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

#include "fixpid_arith.h"

#ifdef FIXPID_AN937_OBJECT
#define SELF FIXPID_AN937_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

#define SUM_MAGNITUDE_MAX INT32_C(0xFFFFFF)
#define PERCENT_MAX 100
#define ERROR_PER_PERCENT 40
#define OUTPUT_PER_PERCENT 1600

bool fixpid_an937_init(FIXPID_DATA struct fixpid_an937 *self,
                       const struct fixpid_an937_config *config)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(config != 0);
    SELF.kp_q4 = 0;
    SELF.ki_q4 = 0;
    SELF.kd_q4 = 0;
    SELF.accumulated_error_limit = 0;
    SELF.derivative_period_ticks = config->derivative_period_ticks;
    fixpid_an937_reset(self);
    if (config->derivative_period_ticks == 0u) {
        return false;
    }
    SELF.accumulated_error_limit =
        config->accumulated_error_limit; // 0: refused
    return fixpid_an937_set_gains(self, config->kp_q4, config->ki_q4,
                                  config->kd_q4);
}

void fixpid_an937_reset(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.tick_pending = 0;
    SELF.derivative_countdown = 1;
    SELF.error_magnitude = 0;
    SELF.accumulated_magnitude = 0;
    SELF.delta_magnitude = 0;
    SELF.previous_error = 0;
    SELF.error_negative = 0;
    SELF.accumulated_negative = 0;
    SELF.delta_negative = 0;
    SELF.sum_negative = 0;
    fixpid_an937_clear_flags(self);
}

bool fixpid_an937_set_gains(FIXPID_DATA struct fixpid_an937 *self,
                            uint8_t kp_q4, uint8_t ki_q4, uint8_t kd_q4)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.accumulated_error_limit == 0u) {
        return false;
    }
    SELF.kp_q4 = kp_q4;
    SELF.ki_q4 = ki_q4;
    SELF.kd_q4 = kd_q4;
    return true;
}

bool fixpid_an937_set_accumulated_error_limit(
    FIXPID_DATA struct fixpid_an937 *self, uint16_t limit)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.accumulated_error_limit == 0u) {
        return false;
    }
    if (limit == 0u) {
        return false;
    }
    SELF.accumulated_error_limit = limit;
    return true;
}

bool fixpid_an937_set_derivative_period(FIXPID_DATA struct fixpid_an937 *self,
                                        uint8_t ticks)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.accumulated_error_limit == 0u) {
        return false;
    }
    if (ticks == 0u) {
        return false;
    }
    SELF.derivative_period_ticks = ticks;
    return true;
}

void fixpid_an937_tick(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.tick_pending != 0u) {
        SELF.tick_overrun = 1;
    }
    SELF.tick_pending = 1;
}

// Equation 2: accumulated = clamp(accumulated + error, -limit, limit). Unlike
// signs subtract the smaller magnitude from the larger, whose sign stays.
static void accumulate(FIXPID_DATA struct fixpid_an937 *self)
{
    const uint16_t error = SELF.error_magnitude;
    uint16_t accumulated = SELF.accumulated_magnitude;
    bool beyond = false;

    FIXPID_ASSERT(VALID(self));
    if (SELF.accumulated_negative == SELF.error_negative) {
        accumulated = (uint16_t)(accumulated + error);
        beyond = accumulated < error; // carried out of 16 bits
    } else if (accumulated >= error) {
        accumulated = (uint16_t)(accumulated - error);
    } else {
        accumulated = (uint16_t)(error - accumulated);
        SELF.accumulated_negative = SELF.error_negative;
    }
    if (accumulated > SELF.accumulated_error_limit) {
        beyond = true;
    }
    if (beyond) {
        accumulated = SELF.accumulated_error_limit;
        SELF.step_flags = FIXPID_AN937_ACCUMULATED_ERROR_LIMITED;
    }
    SELF.accumulated_magnitude = accumulated;
}

// Equation 3: delta = error - previous error, within +-65535.
static void differentiate(FIXPID_DATA struct fixpid_an937 *self, int16_t error)
{
    const int16_t previous = SELF.previous_error;

    FIXPID_ASSERT(VALID(self));
    SELF.delta_negative = 0;
    SELF.delta_magnitude = (uint16_t)((uint16_t)error - (uint16_t)previous);
    if (error < previous) {
        SELF.delta_negative = 1;
        SELF.delta_magnitude = FIXPID_NEGATED(SELF.delta_magnitude);
    }
    SELF.previous_error = error;
}

// gain * magnitude with its sign: |term| <= 255 * 65535 < 2^24.
static int32_t term(uint8_t gain, uint16_t magnitude, uint8_t negative)
{
    uint32_t product;

    FIXPID_GAIN_PRODUCT(product, gain, magnitude);
    return (negative != 0u) ? -(int32_t)product : (int32_t)product;
}

int32_t fixpid_an937_step(FIXPID_DATA struct fixpid_an937 *self, int16_t error)
{
    int32_t sum;

    FIXPID_ASSERT(VALID(self));
    SELF.step_flags = 0;
    SELF.error_negative = 0;
    SELF.error_magnitude = (uint16_t)error;
    if (error < 0) {
        SELF.error_negative = 1;
        SELF.error_magnitude = FIXPID_NEGATED(error);
    }
    if (SELF.tick_pending != 0u) {
        SELF.tick_pending = 0;
        accumulate(self);
        if (SELF.derivative_countdown > 1u) {
            SELF.derivative_countdown--;
        } else {
            SELF.derivative_countdown = SELF.derivative_period_ticks;
            differentiate(self, error);
        }
    }

    // Equation 4; |sum| <= 255 * (32768 + 65535 + 65535) < 2^26
    sum = fixpid_an937_proportional(self) + fixpid_an937_integral(self) +
          fixpid_an937_derivative(self);
    SELF.sum_negative = 0;
    if (sum < 0) {
        SELF.sum_negative = 1;
        sum = -sum;
    }
    if (sum > SUM_MAGNITUDE_MAX) {
        sum = SUM_MAGNITUDE_MAX;
        SELF.step_flags |= FIXPID_AN937_SUM_SATURATED;
    }
    sum >>= 4;
    return (SELF.sum_negative != 0u) ? -sum : sum;
}

int8_t fixpid_an937_step_percent(FIXPID_DATA struct fixpid_an937 *self,
                                 int8_t error_percent)
{
    int32_t percent = error_percent;

    if (percent > PERCENT_MAX) {
        percent = PERCENT_MAX;
    }
    if (percent < -PERCENT_MAX) {
        percent = -PERCENT_MAX;
    }
    percent = fixpid_an937_step(self, (int16_t)(percent * ERROR_PER_PERCENT)) /
              OUTPUT_PER_PERCENT;
    if (percent > PERCENT_MAX) {
        percent = PERCENT_MAX;
    }
    if (percent < -PERCENT_MAX) {
        percent = -PERCENT_MAX;
    }
    return (int8_t)percent;
}

int32_t fixpid_an937_proportional(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return term(SELF.kp_q4, SELF.error_magnitude, SELF.error_negative);
}

int32_t fixpid_an937_integral(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return term(SELF.ki_q4, SELF.accumulated_magnitude,
                SELF.accumulated_negative);
}

int32_t fixpid_an937_derivative(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return term(SELF.kd_q4, SELF.delta_magnitude, SELF.delta_negative);
}

int32_t fixpid_an937_accumulated_error(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return term(1u, SELF.accumulated_magnitude, SELF.accumulated_negative);
}

static uint8_t bit_if(bool condition, uint8_t bit)
{
    return condition ? bit : (uint8_t)0;
}

uint8_t fixpid_an937_status(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(bit_if(SELF.sum_negative == 0u, FIXPID_AN937_PID_SIGN) |
                     bit_if(fixpid_an937_derivative(self) >= 0,
                            FIXPID_AN937_D_ERR_SIGN) |
                     bit_if(SELF.previous_error >= 0, FIXPID_AN937_P_ERR_SIGN) |
                     bit_if(fixpid_an937_accumulated_error(self) >= 0,
                            FIXPID_AN937_A_ERR_SIGN) |
                     bit_if(SELF.error_negative == 0u, FIXPID_AN937_ERR_SIGN) |
                     bit_if(SELF.accumulated_magnitude == 0u,
                            FIXPID_AN937_A_ERR_ZERO) |
                     bit_if(SELF.error_magnitude == 0u, FIXPID_AN937_ERR_ZERO));
}

uint8_t fixpid_an937_status2(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return bit_if(SELF.delta_magnitude == 0u, FIXPID_AN937_D_ERR_Z);
}

uint8_t fixpid_an937_flags(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(SELF.step_flags | bit_if(SELF.tick_overrun != 0u,
                                              FIXPID_AN937_TICK_OVERRUN));
}

void fixpid_an937_clear_flags(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.step_flags = 0;
    SELF.tick_overrun = 0;
}
