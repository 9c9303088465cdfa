// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"

#include "fixpid_an937_arith.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AN937_SELF
#define VALID_SELF FIXPID_AN937_VALID_SELF

bool fixpid_an937_init(FIXPID_DATA struct fixpid_an937 *self,
                       const struct fixpid_an937_config *config)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    fixpid_an937_reset(self);
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
    FIXPID_ASSERT(VALID_SELF);
    SELF.tick_pending = 0;
    SELF.derivative_countdown = 1;
    SELF.tick_overrun = 0;
    SELF.step_flags = 0;
    SELF.error.value = 0; // in sign-magnitude, too
    SELF.accumulated_error.value = 0;
    SELF.delta.value = 0;
    SELF.previous_error = FIXPID_AN937_NO_ERROR;
}

bool fixpid_an937_set_gains(FIXPID_DATA struct fixpid_an937 *self,
                            uint8_t kp_q4, uint8_t ki_q4, uint8_t kd_q4)
{
    FIXPID_ASSERT(VALID_SELF);
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
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.tick_pending != 0u) {
        SELF.tick_overrun = 1;
    }
    SELF.tick_pending = 1;
}

int32_t fixpid_an937_step(FIXPID_DATA struct fixpid_an937 *self, int16_t error)
{
    uint8_t flags = 0;
    int32_t output;

    FIXPID_ASSERT(VALID_SELF);
    fixpid_number_set(&SELF.error, error);
    if (SELF.tick_pending != 0u) {
        SELF.tick_pending = 0;
        if (SELF.derivative_countdown > 1u) {
            SELF.derivative_countdown--;
        } else {
            const uint16_t now =
                (uint16_t)((uint16_t)error ^ FIXPID_AN937_NO_ERROR);

            // Equation 3: delta = error - previous error, within +-65535
            SELF.derivative_countdown = SELF.derivative_period_ticks;
            fixpid_number_difference(&SELF.delta, now, SELF.previous_error);
            SELF.previous_error = now;
        }
        // Equation 2: accumulated = clamp(accumulated + error, -limit, limit)
        fixpid_number_add(&SELF.accumulated_error, &SELF.error,
                          SELF.accumulated_error_limit, &flags);
    }
    output = fixpid_an937_output(&SELF, &flags); // Equation 4
    SELF.step_flags = flags;
    return output;
}
