// SPDX-License-Identifier: MIT
// What firmware can do without: SDCC links whole objects, so this is one of its
// own.
#include "fixpid_an937.h"

#include "fixpid_an937_self.h"

#define STEP_FLAGS                                                             \
    (FIXPID_AN937_SUM_SATURATED | FIXPID_AN937_ACCUMULATED_ERROR_LIMITED)
#define PERCENT_MAX 100
#define ERROR_PER_PERCENT 40
#define OUTPUT_PER_PERCENT 1600

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
    int32_t term;

    FIXPID_ASSERT(VALID(self));
    FIXPID_NUMBER_TERM(term, SELF.kp_q4, SELF.error, SELF.room);
    return term;
}

int32_t fixpid_an937_integral(FIXPID_DATA struct fixpid_an937 *self)
{
    int32_t term;

    FIXPID_ASSERT(VALID(self));
    FIXPID_NUMBER_TERM(term, SELF.ki_q4, SELF.accumulated_error, SELF.room);
    return term;
}

int32_t fixpid_an937_derivative(FIXPID_DATA struct fixpid_an937 *self)
{
    int32_t term;

    FIXPID_ASSERT(VALID(self));
    FIXPID_NUMBER_TERM(term, SELF.kd_q4, SELF.delta, SELF.room);
    return term;
}

int32_t fixpid_an937_accumulated_error(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_NUMBER_GET(SELF.accumulated_error);
}

// A macro: a function makes the status a quarter larger on a PIC18.
#define BIT_IF(condition, bit) ((condition) ? (bit) : 0u)

uint8_t fixpid_an937_status(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(BIT_IF((SELF.step_flags & FIXPID_SUM_NEGATIVE) == 0u,
                            FIXPID_AN937_PID_SIGN) |
                     BIT_IF(fixpid_an937_derivative(self) >= 0,
                            FIXPID_AN937_D_ERR_SIGN) |
                     BIT_IF(SELF.previous_level >= FIXPID_LEVEL(0),
                            FIXPID_AN937_P_ERR_SIGN) |
                     BIT_IF(fixpid_an937_accumulated_error(self) >= 0,
                            FIXPID_AN937_A_ERR_SIGN) |
                     BIT_IF(FIXPID_NUMBER_GET(SELF.error) >= 0,
                            FIXPID_AN937_ERR_SIGN) |
                     BIT_IF(fixpid_an937_accumulated_error(self) == 0,
                            FIXPID_AN937_A_ERR_ZERO) |
                     BIT_IF(FIXPID_NUMBER_GET(SELF.error) == 0,
                            FIXPID_AN937_ERR_ZERO));
}

uint8_t fixpid_an937_status2(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return BIT_IF(FIXPID_NUMBER_GET(SELF.delta) == 0, FIXPID_AN937_D_ERR_Z);
}

uint8_t fixpid_an937_flags(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (
        uint8_t)((SELF.step_flags & STEP_FLAGS) |
                 BIT_IF(SELF.tick_overrun != 0u, FIXPID_AN937_TICK_OVERRUN));
}

void fixpid_an937_clear_flags(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.step_flags &= FIXPID_SUM_NEGATIVE; // it belongs to the status
    SELF.tick_overrun = 0;
}
