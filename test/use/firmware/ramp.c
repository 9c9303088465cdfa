// SPDX-License-Identifier: MIT
// A program for the smallest chips: the setpoint, in limited steps, is the
// drive.
#include "fixpid_slew.h"
#include "port.h"

FIXPID_DATA struct fixpid_slew ramp;

int main(void)
{
    port_init();
    fixpid_slew_init(&ramp, 65536u, 65536u); // a count each tick
    while (port_running()) {
        (void)port_wait_tick();
        port_drive(fixpid_slew_step(&ramp, (int16_t)port_read(0u)));
    }
    return 0;
}
