// SPDX-License-Identifier: MIT
#include "plain_c_an964_8bit.h"

static int32_t clamp(int32_t value, int32_t low, int32_t high)
{
    if (value < low) {
        return low;
    }
    if (value > high) {
        return high;
    }
    return value;
}

int32_t plain_c_an964_8bit_step(struct plain_c_an964_8bit *self, int32_t error)
{
    int32_t sum = self->sum + error;
    int32_t integral, change, derivative, total;

    self->flags = 0;
    if (sum > FIXPID_AN964_8BIT_SUM_LIMIT) {
        sum = FIXPID_AN964_8BIT_SUM_LIMIT;
        self->flags = FIXPID_AN964_8BIT_SUM_LIMITED;
    } else if (sum < -FIXPID_AN964_8BIT_SUM_LIMIT) {
        sum = -FIXPID_AN964_8BIT_SUM_LIMIT;
        self->flags = FIXPID_AN964_8BIT_SUM_LIMITED;
    }
    self->sum = (int16_t)sum;
    integral = clamp(sum / 64 * self->gains.ki / 8, -127, 127);
    self->integral = (int8_t)integral;

    change = clamp(error - self->error[2], -FIXPID_AN964_8BIT_TERM_LIMIT,
                   FIXPID_AN964_8BIT_TERM_LIMIT);
    // A right shift of a negative number rounds down, as compilers do it.
    derivative =
        clamp((change * self->gains.kd) >> 2, -FIXPID_AN964_8BIT_TERM_LIMIT,
              FIXPID_AN964_8BIT_TERM_LIMIT);
    self->derivative = (int8_t)derivative;
    self->error[2] = self->error[1];
    self->error[1] = self->error[0];
    self->error[0] = (int8_t)error;

    total = error + integral + derivative;
    if (total > 127) {
        total = 127;
        self->flags |= FIXPID_AN964_8BIT_OUTPUT_LIMITED;
    } else if (total < -127) {
        total = -127;
        self->flags |= FIXPID_AN964_8BIT_OUTPUT_LIMITED;
    }
    return total * self->gains.kp / 32;
}
