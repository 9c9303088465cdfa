// SPDX-License-Identifier: MIT
// Setters and getters that not every program calls. They have their own file
// because SDCC links whole object files: firmware that calls none of them does
// not pay for them.
#include "fixpid_an937.h"

#include "fixpid_an937_arith.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AN937_SELF
#define VALID_SELF FIXPID_AN937_VALID_SELF

#define STEP_FLAGS                                                             \
    (FIXPID_AN937_SUM_SATURATED | FIXPID_AN937_ACCUMULATED_ERROR_LIMITED)
#define PERCENT_MAX 100
#define ERROR_PER_PERCENT 40
#define OUTPUT_PER_PERCENT 1600

bool fixpid_an937_set_accumulated_error_limit(
    FIXPID_DATA struct fixpid_an937 *self, uint16_t limit)
{
    FIXPID_ASSERT(VALID_SELF);
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
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.accumulated_error_limit == 0u) {
        return false;
    }
    if (ticks == 0u) {
        return false;
    }
    SELF.derivative_period_ticks = ticks;
    return true;
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

int32_t fixpid_an937_proportional(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return fixpid_number_term(SELF.kp_q4, &SELF.error);
}

int32_t fixpid_an937_integral(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return fixpid_number_term(SELF.ki_q4, &SELF.accumulated_error);
}

int32_t fixpid_an937_derivative(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return fixpid_number_term(SELF.kd_q4, &SELF.delta);
}

int32_t fixpid_an937_accumulated_error(
    FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return fixpid_number_value(&SELF.accumulated_error);
}

uint8_t fixpid_an937_stat1(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (uint8_t)((((SELF.step_flags & FIXPID_AN937_SUM_NEGATIVE) == 0u)
                          ? FIXPID_AN937_PID_SIGN
                          : 0u) |
                     ((fixpid_an937_derivative(self) >= 0)
                          ? FIXPID_AN937_D_ERR_SIGN
                          : 0u) |
                     ((SELF.previous_error >= FIXPID_AN937_NO_ERROR)
                          ? FIXPID_AN937_P_ERR_SIGN
                          : 0u) |
                     ((fixpid_an937_accumulated_error(self) >= 0)
                          ? FIXPID_AN937_A_ERR_SIGN
                          : 0u) |
                     ((fixpid_number_value(&SELF.error) >= 0)
                          ? FIXPID_AN937_ERR_SIGN
                          : 0u) |
                     ((fixpid_an937_accumulated_error(self) == 0)
                          ? FIXPID_AN937_A_ERR_ZERO
                          : 0u) |
                     ((fixpid_number_value(&SELF.error) == 0)
                          ? FIXPID_AN937_ERR_ZERO
                          : 0u));
}

uint8_t fixpid_an937_stat2(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (fixpid_number_value(&SELF.delta) == 0) ? FIXPID_AN937_D_ERR_Z : 0u;
}

uint8_t fixpid_an937_flags(FIXPID_DATA const struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (
        uint8_t)((SELF.step_flags & STEP_FLAGS) |
                 ((SELF.tick_overrun != 0u) ? FIXPID_AN937_TICK_OVERRUN : 0u));
}

void fixpid_an937_clear_flags(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.step_flags &= FIXPID_AN937_SUM_NEGATIVE; // for stat1
    SELF.tick_overrun = 0;
}
