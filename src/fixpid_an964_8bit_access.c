// SPDX-License-Identifier: MIT
// What reads a controller: a file of its own, because SDCC's linker takes whole
// files, and a firmware that reads nothing leaves it out.
#include "fixpid_an964_8bit.h"

#include "fixpid_an964_8bit_self.h"
#include "fixpid_arith.h"

int16_t fixpid_an964_8bit_proportional(
    FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED_BYTE(SELF.error[0]);
}

int16_t fixpid_an964_8bit_integral(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED_BYTE(SELF.integral);
}

int16_t fixpid_an964_8bit_derivative(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return FIXPID_SIGNED_BYTE(SELF.derivative);
}

uint8_t fixpid_an964_8bit_flags(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return (uint8_t)(SELF.sum_limited | SELF.output_limited);
}
