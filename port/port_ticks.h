// SPDX-License-Identifier: MIT
// The two functions of port.h that tell ticks, the same for every port whose
// interrupt only counts. For port.c, which includes it once, after
//   ticks_counted          a volatile byte that only the interrupt writes
//   ticks_taken            a byte that only these write
//   PORT_CLEAR_WATCHDOG()  restarts the watchdog
#ifndef PORT_TICKS_H
#define PORT_TICKS_H
#include "port.h"

uint8_t port_ticks(void)
{
    const uint8_t ticks = (uint8_t)(ticks_counted - ticks_taken);

    ticks_taken = (uint8_t)(ticks_taken + ticks);
    if (ticks != 0u) {
        PORT_CLEAR_WATCHDOG();
    }
    return ticks;
}

uint8_t port_wait_tick(void)
{
    while (ticks_counted == ticks_taken) {
    }
    return port_ticks();
}

#endif
