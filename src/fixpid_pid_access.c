// SPDX-License-Identifier: MIT
// What not every program needs; SDCC links whole objects.
#include "fixpid_pid.h"
#include "fixpid_pid_self.h"

static void limit_integral(FIXPID_DATA struct fixpid_pid *self)
{
    const int16_t counts = (int16_t)FIXPID_FLOOR(SELF.integral, 16);

    FIXPID_ASSERT(VALID(self));
    if (counts >= SELF.integral_max) {
        SELF.integral = FIXPID_RAISED(SELF.integral_max, 16);
        SELF.integral_fraction = 0;
    }
    if (counts < SELF.integral_min) {
        SELF.integral = FIXPID_RAISED(SELF.integral_min, 16);
        SELF.integral_fraction = 0;
    }
}

// What does not fit lies beyond every limit, too.
static void set_integral(FIXPID_DATA struct fixpid_pid *self, int32_t value_q8)
{
    int32_t limited = value_q8;

    FIXPID_ASSERT(VALID(self));
    FIXPID_CLAMP(limited, -COUNTS_MAX_Q8, COUNTS_MAX_Q8);
    SELF.integral = FIXPID_RAISED(limited, 8);
    SELF.integral_fraction = 0;
    limit_integral(self);
}

static void hold(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    int16_t held = output;

    FIXPID_ASSERT(VALID(self));
    FIXPID_CLAMP(held, SELF.output_min, SELF.output_max);
    SELF.integral = FIXPID_RAISED(held, 16);
}

// What the integral holds beyond the output limits is wind-up, unless the other
// terms take it away again.
static void drop_windup(FIXPID_DATA struct fixpid_pid *self)
{
    int32_t terms; // within 2^31 - 2^15 - 2^24, so a limit is within 2^31
    int32_t limit;

    FIXPID_ASSERT(VALID(self));
    FIXPID_SIGNED_PRODUCT(terms, SELF.kp, SELF.proportional_error);
    terms += SELF.derivative;
    limit = (int32_t)SELF.output_max - SELF.feedforward;
    limit = FIXPID_RAISED(limit, 8);
    if (terms < 0) {
        limit -= terms;
    }
    if (FIXPID_FLOOR(SELF.integral, 8) >= limit) {
        set_integral(self, limit);
    }
    limit = (int32_t)SELF.output_min - SELF.feedforward;
    limit = FIXPID_RAISED(limit, 8);
    if (terms > 0) {
        limit -= terms;
    }
    if (FIXPID_FLOOR(SELF.integral, 8) < limit) {
        set_integral(self, limit);
    }
}

bool fixpid_pid_set_limits(FIXPID_DATA struct fixpid_pid *self,
                           int16_t output_min, int16_t output_max)
{
    FIXPID_ASSERT(VALID(self));
    if (REFUSED) {
        return false;
    }
    if (output_min >= output_max) {
        return false;
    }
    SELF.output_min = output_min;
    SELF.output_max = output_max;
    if ((SELF.status & HELD) != 0u) {
        hold(self, (int16_t)FIXPID_FLOOR(SELF.integral, 16));
    } else {
        drop_windup(self);
    }
    return true;
}

bool fixpid_pid_set_integral_limits(FIXPID_DATA struct fixpid_pid *self,
                                    int16_t integral_min, int16_t integral_max)
{
    FIXPID_ASSERT(VALID(self));
    if (REFUSED) {
        return false;
    }
    if (integral_min < -INT16_MAX) {
        return false;
    }
    if (integral_min > integral_max) {
        return false;
    }
    SELF.integral_min = integral_min;
    SELF.integral_max = integral_max;
    if ((SELF.status & HELD) == 0u) {
        limit_integral(self);
    }
    return true;
}

void fixpid_pid_set_feedforward(FIXPID_DATA struct fixpid_pid *self,
                                int16_t feedforward)
{
    FIXPID_ASSERT(VALID(self));
    if (!REFUSED) {
        SELF.feedforward = feedforward;
    }
}

void fixpid_pid_set_manual(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    FIXPID_ASSERT(VALID(self));
    hold(self, output);
    SELF.status = (uint8_t)((SELF.status & (uint8_t)~HELD) | FIXPID_PID_MANUAL);
}

void fixpid_pid_set_auto(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID(self));
    if ((SELF.status & FIXPID_PID_MANUAL) != 0u) {
        SELF.status =
            (uint8_t)((SELF.status & (uint8_t)~HELD) | FIXPID_PID_SEEDED);
    }
}

void fixpid_pid_seed(FIXPID_DATA struct fixpid_pid *self, int16_t output)
{
    FIXPID_ASSERT(VALID(self));
    hold(self, output);
    if ((SELF.status & FIXPID_PID_MANUAL) == 0u) {
        SELF.status |= FIXPID_PID_SEEDED;
    }
}

int32_t fixpid_pid_proportional(FIXPID_DATA struct fixpid_pid *self)
{
    int32_t proportional;

    FIXPID_ASSERT(VALID(self));
    FIXPID_SIGNED_PRODUCT(proportional, SELF.kp, SELF.proportional_error);
    return proportional;
}

int32_t fixpid_pid_integral(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.integral;
}

int32_t fixpid_pid_derivative(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.derivative;
}

uint8_t fixpid_pid_status(FIXPID_DATA struct fixpid_pid *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.status;
}
