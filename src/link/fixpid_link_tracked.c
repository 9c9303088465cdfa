// SPDX-License-Identifier: MIT
// Steps that are tracked, in a file of its own because SDCC links whole object
// files.
#include "fixpid_link.h"

#undef FIXPID_BYTES_DATA
#define FIXPID_BYTES_DATA FIXPID_DATA
#include "../common/fixpid_put.h"
#include "fixpid_link_private.h"

#define TRACKED_BYTES 3u // behind a step's payload

uint8_t fixpid_link_step_tracked(FIXPID_DATA struct fixpid_link *self,
                                 FIXPID_DATA struct fixpid_pid *pid_self,
                                 int16_t setpoint, int16_t measurement,
                                 int16_t output, int16_t applied, uint8_t shift)
{
    uint8_t bytes = fixpid_link_begin(self, pid_self, setpoint);
    uint8_t at = KEY_OUTPUT_AT;

    if (bytes == 0u) {
        return 0;
    }
    if (bytes != KEY_BYTES) { // which has the state after the tracking
        at = STEP_OUTPUT_AT;
        put(&SELF.frame[bytes + 1u], (uint16_t)applied);
        SELF.frame[bytes + 3u] = shift;
        bytes = (uint8_t)(bytes + TRACKED_BYTES);
    }
    put(&SELF.frame[at - 2u], (uint16_t)measurement);
    put(&SELF.frame[at], (uint16_t)output);
    return fixpid_link_framed(SELF.frame, bytes);
}
