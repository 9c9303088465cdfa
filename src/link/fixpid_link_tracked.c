// SPDX-License-Identifier: MIT
// Steps that are tracked, in a file of its own because SDCC links whole object
// files.
#include "fixpid_link.h"

#include "fixpid_link_private.h"

uint8_t fixpid_link_step_tracked(FIXPID_DATA struct fixpid_link *self,
                                 FIXPID_DATA struct fixpid_pid *pid,
                                 int16_t setpoint, int16_t measurement,
                                 int16_t output, int16_t applied, uint8_t shift)
{
    uint8_t bytes =
        fixpid_link_payload(self, pid, setpoint, measurement, output);

    // A key frame has the state after the tracking, and no payload no frame.
    if ((uint8_t)(bytes - 1u) < (KEY_BYTES - 1u)) {
        SELF.frame[bytes + 1u] = (uint8_t)((uint16_t)applied & 0xFFu);
        SELF.frame[bytes + 2u] = (uint8_t)((uint16_t)applied >> 8);
        SELF.frame[bytes + 3u] = shift;
        bytes = (uint8_t)(bytes + 3u);
    }
    return fixpid_link_framed(SELF.frame, bytes);
}
