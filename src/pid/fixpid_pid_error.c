// SPDX-License-Identifier: MIT
// The step of those who form the error themselves, in a file of its own because
// SDCC links whole object files. It calls the plain step, which costs nobody a
// cycle more for it.
#include "fixpid_pid.h"

#include "fixpid_pid_private.h"

// sat16(x), or with a mirror sat16(-x). Not every x has a -x, but every one
// within these limits does.
static int16_t saturated(int32_t x, uint16_t mirror)
{
    if (mirror != 0u) {
        return (int16_t)-clamp32(x, -INT16_MAX, INT32_C(32768));
    }
    return (int16_t)clamp32(x, INT16_MIN, INT16_MAX);
}

// Gives the step a measurement of 0 and the error as its setpoint, and lets it
// believe that the derivative saw the fall before: the difference is the fall
// itself. What the derivative saw really is the sum of all rises since the
// first step, modulo 2^16, which is the measurement where the rises are its
// own. In reverse the object holds its mirror image, which is its complement.
int16_t fixpid_pid_step_error(FIXPID_DATA struct fixpid_pid *self,
                              int32_t error, int32_t rise)
{
    uint8_t options;
    uint16_t mirror;
    uint16_t seen;
    int16_t output;

    FIXPID_ASSERT(VALID_SELF);
    options = SELF.options;
    mirror = ((options & REVERSE) != 0u) ? 0xFFFFu : 0u;
    seen = (uint16_t)SELF.previous ^ mirror;
    if ((SELF.status & FIXPID_PID_FIRST) != 0u) {
        seen = 0; // and `previous` says that there is none
    } else if ((options & ON_ERROR) == 0u) {
        SELF.previous = saturated(rise, (uint16_t)~mirror);
    } else {
        // the error's own
    }
    SELF.options = (uint8_t)(options & (uint8_t) ~(REVERSE | WEIGHTED));
    output = fixpid_pid_step(self, saturated(error, mirror), 0);
    SELF.options = options;
    if ((options & ON_ERROR) == 0u) {
        seen = (uint16_t)(seen + (uint16_t)rise) ^ mirror;
        // Deviation 10.8: a pattern of two's complement
        SELF.previous = (int16_t)seen;
    }
    return output;
}
