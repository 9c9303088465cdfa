// SPDX-License-Identifier: MIT
// Getters. They have their own file because SDCC links whole object files:
// firmware that calls none of them does not pay for them.
#include "fixpid_an964_8bit.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AN964_8BIT_SELF
#define VALID_SELF FIXPID_AN964_8BIT_VALID_SELF

int16_t fixpid_an964_8bit_proportional(
    FIXPID_DATA const struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (int8_t)SELF.error[0];
}

int16_t fixpid_an964_8bit_integral(
    FIXPID_DATA const struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (int8_t)SELF.integral;
}

int16_t fixpid_an964_8bit_derivative(
    FIXPID_DATA const struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (int8_t)SELF.derivative;
}

uint8_t fixpid_an964_8bit_flags(
    FIXPID_DATA const struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (uint8_t)(SELF.sum_limited | SELF.output_limited);
}
