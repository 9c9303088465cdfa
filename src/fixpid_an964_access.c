// SPDX-License-Identifier: MIT
// What reads a controller: a file of its own, because SDCC's linker takes whole
// files, and a firmware that reads nothing leaves it out.
#include "fixpid_an964.h"

#include "fixpid_an964_self.h"
#include "fixpid_arith.h"

int16_t fixpid_an964_proportional(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED(SELF.error[0]);
}

int16_t fixpid_an964_integral(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED(SELF.integral);
}

int16_t fixpid_an964_derivative(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED(SELF.derivative);
}

uint8_t fixpid_an964_flags(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(SELF.sum_limited | SELF.output_limited);
}
