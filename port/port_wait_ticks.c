// SPDX-License-Identifier: MIT
// A file of its own, because SDCC links whole object files: firmware that waits
// for single ticks does not pay for it.
#include "port.h"

uint8_t port_wait_ticks(uint8_t n)
{
    uint8_t ticks = port_wait_tick();

    while (ticks < n) {
        const uint8_t room = (uint8_t)(255u - ticks);
        const uint8_t more = port_wait_tick();
        ticks = (more < room) ? (uint8_t)(ticks + more) : 255u;
    }
    return ticks;
}
