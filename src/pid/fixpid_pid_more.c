// SPDX-License-Identifier: MIT
// Setters and getters that not every program calls. They have their own file
// because SDCC links whole object files: firmware that calls none of them does
// not pay for them.
#include "fixpid_pid.h"

#include "fixpid_pid_accept.h"
#include "fixpid_pid_limit.h"
#include "fixpid_pid_private.h"

// Sets the integral, saturated. That is safe: every value that is cut off here
// is beyond the integral's limits anyway.
static void set_integral(FIXPID_DATA struct fixpid_pid *self, int32_t value_q8)
{
    SELF.integral =
        shift_left(clamp32(value_q8, -COUNTS_MAX_Q8, COUNTS_MAX_Q8), 8);
    SELF.integral_fraction = 0;
    limit_integral(self);
}

static void hold(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    SELF.integral =
        shift_left(clamp32(output, SELF.output_min, SELF.output_max), 16);
}

// The part of the integral beyond the output limits is wind-up, unless the
// other terms balance it.
static void drop_windup(FIXPID_DATA struct fixpid_pid *self)
{
    // within 2^31 - 2^15 - 2^24, so that a limit is within 2^31
    const int32_t terms =
        fixpid_add32(mul16(SELF.kp, SELF.proportional_error), SELF.derivative);
    int32_t limit = (int32_t)SELF.output_max - SELF.feedforward;
    limit = shift_left(limit, 8);
    if (terms < 0) {
        limit = fixpid_sub32(limit, terms);
    }
    if (shift_right_floor(SELF.integral, 8) >= limit) {
        set_integral(self, limit);
    }
    limit = (int32_t)SELF.output_min - SELF.feedforward;
    limit = shift_left(limit, 8);
    if (terms > 0) {
        limit = fixpid_sub32(limit, terms);
    }
    if (shift_right_floor(SELF.integral, 8) < limit) {
        set_integral(self, limit);
    }
}

// Before the first step, where P and D are 0, the integral is the distance from
// the feed-forward to the output's range.
static void rest_or_drop_windup(FIXPID_DATA struct fixpid_pid *self)
{
    if ((SELF.status & FIXPID_PID_FIRST) != 0u) {
        set_integral(self, 0);
    }
    drop_windup(self);
}

bool fixpid_pid_set_limits(FIXPID_DATA struct fixpid_pid *self,
                           int16_t output_min, int16_t output_max)
{
    FIXPID_ASSERT(VALID_SELF);
    if (REFUSED) {
        return false;
    }
    if (output_min >= output_max) {
        return false;
    }
    SELF.output_min = output_min;
    SELF.output_max = output_max;
    if ((SELF.status & HELD) != 0u) {
        hold(self, (int16_t)shift_right_floor(SELF.integral, 16));
    } else {
        rest_or_drop_windup(self);
    }
    return true;
}

bool fixpid_pid_set_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                    int16_t integral_min, int16_t integral_max)
{
    FIXPID_ASSERT(VALID_SELF);
    if (REFUSED) {
        return false;
    }
    if (!accept_integral_limits(self, integral_min, integral_max)) {
        return false;
    }
    if ((SELF.status & HELD) == 0u) {
        limit_integral(self);
    }
    return true;
}

#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_FEEDFORWARD) != 0
void fixpid_pid_set_feedforward(FIXPID_DATA struct fixpid_pid *self,
                                int16_t feedforward)
{
    FIXPID_ASSERT(VALID_SELF);
    if (!REFUSED) {
        SELF.feedforward = feedforward;
        if ((SELF.status & (HELD | FIXPID_PID_FIRST)) == FIXPID_PID_FIRST) {
            rest_or_drop_windup(self);
        }
    }
}
#endif

#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_MANUAL) != 0
void fixpid_pid_set_manual(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    FIXPID_ASSERT(VALID_SELF);
    hold(self, output);
    SELF.status = (uint8_t)((SELF.status & (uint8_t)~HELD) | FIXPID_PID_MANUAL);
}

void fixpid_pid_set_auto(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    if ((SELF.status & FIXPID_PID_MANUAL) != 0u) {
        SELF.status =
            (uint8_t)((SELF.status & (uint8_t)~HELD) | FIXPID_PID_SEEDED);
    }
}

void fixpid_pid_seed(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    FIXPID_ASSERT(VALID_SELF);
    hold(self, output);
    if ((SELF.status & FIXPID_PID_MANUAL) == 0u) {
        SELF.status |= FIXPID_PID_SEEDED;
    }
}
#endif

int32_t fixpid_pid_proportional(FIXPID_DATA const struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return mul16(SELF.kp, SELF.proportional_error);
}

int32_t fixpid_pid_integral(FIXPID_DATA const struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return SELF.integral;
}

int32_t fixpid_pid_derivative(FIXPID_DATA const struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return SELF.derivative;
}

uint8_t fixpid_pid_flags(FIXPID_DATA const struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    if (REFUSED) {
        return SELF.status | FIXPID_PID_REFUSED;
    }
    return SELF.status;
}

#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_TRACK) != 0
int16_t fixpid_pid_output(FIXPID_DATA const struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return SELF.output;
}
#endif
