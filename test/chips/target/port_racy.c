// SPDX-License-Identifier: MIT
// What a port must not do, for a test that must notice: it stands in for
// port.c beside driver_tick.c. The loop reads the interrupt's count and then
// clears it. With INTERRUPT_CALL the interrupt also calls that function.
#include "exchange.h"
#include "port.h"
#include "registers.h"

#include "configuration.h"

// Bits of INTCON on both chips.
#define ENABLED 0xA0u // GIE, TMR0IE
#define FLAG 0x04u    // TMR0IF

#ifndef INTERRUPT_CALL
#define INTERRUPT_CALL() ((void)0)
#endif

static volatile uint8_t ticks_counted;

PORT_TICK_INTERRUPT()
{
    INTCON &= (uint8_t)~FLAG;
    ticks_counted++;
    INTERRUPT_CALL();
}

void port_init(void)
{
    INTCON = ENABLED;
}

uint8_t port_ticks(void)
{
    const uint8_t ticks = ticks_counted;

    ticks_counted = 0;
    PORT_CLEAR_WATCHDOG();
    return ticks;
}
