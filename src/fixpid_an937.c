// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

#include "fixpid_an937_self.h"

bool fixpid_an937_init(FIXPID_DATA struct fixpid_an937 *self,
                       const struct fixpid_an937_config *config)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(config != 0);
    fixpid_an937_reset(&SELF);
    SELF.kp_q4 = config->kp_q4;
    SELF.ki_q4 = config->ki_q4;
    SELF.kd_q4 = config->kd_q4;
    SELF.accumulated_error_limit = config->accumulated_error_limit;
    SELF.derivative_period_ticks = config->derivative_period_ticks;
    if (SELF.derivative_period_ticks == 0u) {
        SELF.accumulated_error_limit = 0;
    }
    if (SELF.accumulated_error_limit != 0u) {
        return true;
    }
    SELF.kp_q4 = 0;
    SELF.ki_q4 = 0;
    SELF.kd_q4 = 0;
    return false;
}

void fixpid_an937_reset(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.tick_pending = 0;
    SELF.derivative_countdown = 1;
    SELF.tick_overrun = 0;
    SELF.step_flags = 0;
    FIXPID_NUMBER_CLEAR(SELF.error);
    FIXPID_NUMBER_CLEAR(SELF.accumulated_error);
    FIXPID_NUMBER_CLEAR(SELF.delta);
    SELF.previous_level = FIXPID_LEVEL(0);
    FIXPID_CLEAR_ROOM(SELF.room);
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

void fixpid_an937_tick(FIXPID_DATA struct fixpid_an937 *self)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.tick_pending != 0u) {
        SELF.tick_overrun = 1;
    }
    SELF.tick_pending = 1;
}

int32_t fixpid_an937_step(FIXPID_DATA struct fixpid_an937 *self, int16_t error)
{
    int32_t sum;
    uint8_t flags = 0;

    FIXPID_ASSERT(VALID(self));
    FIXPID_NUMBER_SET(SELF.error, error);
    if (SELF.tick_pending != 0u) {
        SELF.tick_pending = 0;
        if (SELF.derivative_countdown > 1u) {
            SELF.derivative_countdown--;
        } else {
            const uint16_t level = FIXPID_LEVEL(error);

            // Equation 3: delta = error - previous error, within +-65535
            SELF.derivative_countdown = SELF.derivative_period_ticks;
            FIXPID_NUMBER_DIFFERENCE(SELF.delta, level, SELF.previous_level);
            SELF.previous_level = level;
        }
        // Equation 2: accumulated = clamp(accumulated + error, -limit, limit)
        FIXPID_NUMBER_ADD(SELF.accumulated_error, SELF.error,
                          SELF.accumulated_error_limit, flags,
                          FIXPID_AN937_ACCUMULATED_ERROR_LIMITED);
    }

    // Equation 4; |sum| <= 255 * (32768 + 65535 + 65535) < 2^26
    FIXPID_SUM_OF_PRODUCTS(sum, SELF.kp_q4, SELF.error, SELF.ki_q4,
                           SELF.accumulated_error, SELF.kd_q4, SELF.delta,
                           SELF.room);
    FIXPID_SUM_SIXTEENTH(sum, flags);
    SELF.step_flags = flags;
    return FIXPID_SUM_RESULT(sum);
}
