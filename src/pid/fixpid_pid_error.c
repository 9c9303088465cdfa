// SPDX-License-Identifier: MIT The step for callers that compute the error
// themselves, in a file of its own because SDCC links whole object files. It
// calls the plain step, which does not become slower by it.
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

// Gives the step a measurement of 0 and the error as its setpoint, and sets the
// last input of the derivative to the fall: then the difference is the fall
// itself. The true last input, kept in `seen`, is the sum of all rises since
// the first step, modulo 2^16. It is the measurement if the rises are those of
// the measurement. In reverse the object holds its mirror image, which is its
// complement.
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
        seen = 0; // `previous` holds no input yet
    } else if ((options & ON_ERROR) == 0u) {
        SELF.previous = saturated(rise, (uint16_t)~mirror);
    } else {
        // D follows the error, and the rise is ignored
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
