// SPDX-License-Identifier: MIT
#include "plain_c_an964.h"

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

int32_t plain_c_an964_step(struct plain_c_an964 *self, int32_t error)
{
    const int32_t e = clamp(error, -1023, 1023);
    int32_t sum = self->sum + e;
    int32_t integral, change, derivative, output;

    self->flags = 0;
    if (sum > FIXPID_AN964_SUM_LIMIT) {
        sum = FIXPID_AN964_SUM_LIMIT;
        self->flags = FIXPID_AN964_SUM_LIMITED;
    } else if (sum < 1 - FIXPID_AN964_SUM_LIMIT) {
        sum = 1 - FIXPID_AN964_SUM_LIMIT;
        self->flags = FIXPID_AN964_SUM_LIMITED;
    }
    self->sum = (int16_t)sum;
    integral = sum / 256 * self->gains.ki / 16;
    self->integral = (int16_t)integral;

    change = clamp(e - self->error[2], -FIXPID_AN964_TERM_LIMIT,
                   FIXPID_AN964_TERM_LIMIT);
    // A right shift of a negative number rounds down, as compilers do it.
    derivative = clamp((change * self->gains.kd) >> 5, -FIXPID_AN964_TERM_LIMIT,
                       FIXPID_AN964_TERM_LIMIT);
    self->derivative = (int16_t)derivative;
    self->error[2] = self->error[1];
    self->error[1] = self->error[0];
    self->error[0] = (int16_t)e;

    output = (e + integral + derivative) * self->gains.kp / 1024;
    if (output > FIXPID_AN964_OUTPUT_LIMIT) {
        output = FIXPID_AN964_OUTPUT_LIMIT;
        self->flags |= FIXPID_AN964_OUTPUT_LIMITED;
    } else if (output < -FIXPID_AN964_OUTPUT_LIMIT) {
        output = -FIXPID_AN964_OUTPUT_LIMIT;
        self->flags |= FIXPID_AN964_OUTPUT_LIMITED;
    }
    return output;
}
