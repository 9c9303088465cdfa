// SPDX-License-Identifier: MIT
// port_racy.c on an AVR.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

#include "exchange.h"
#include "port.h"

#ifndef INTERRUPT_CALL
#define INTERRUPT_CALL() ((void)0)
#endif

static volatile uint8_t ticks_counted;

// Deviation 2.7: a vector, not a parameter.
ISR(TIMER0_COMPA_vect)
{
    ticks_counted++;
    INTERRUPT_CALL();
}

void port_init(void)
{
    TIMSK0 = (uint8_t)_BV(OCIE0A);
    sei();
}

uint8_t port_ticks(void)
{
    const uint8_t ticks = ticks_counted;

    ticks_counted = 0;
    wdt_reset();
    return ticks;
}
