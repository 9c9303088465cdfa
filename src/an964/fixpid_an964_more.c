// SPDX-License-Identifier: MIT
// Getters. They have their own file because SDCC links whole object files:
// firmware that calls none of them does not pay for them.
#include "fixpid_an964.h"

#undef OBJECT
#ifdef FIXPID_AN964_OBJECT
#define OBJECT FIXPID_AN964_OBJECT
#endif
#include "../common/fixpid_self.h"

int16_t fixpid_an964_proportional(FIXPID_DATA const struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (int16_t)SELF.error[0];
}

int16_t fixpid_an964_integral(FIXPID_DATA const struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (int16_t)SELF.integral;
}

int16_t fixpid_an964_derivative(FIXPID_DATA const struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (int16_t)SELF.derivative;
}

uint8_t fixpid_an964_flags(FIXPID_DATA const struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(SELF.sum_limited | SELF.output_limited);
}
