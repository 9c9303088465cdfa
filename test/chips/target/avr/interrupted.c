// SPDX-License-Identifier: MIT
// Timer1 of an AVR, whose count is a cycle.
#include "../interrupted.h"

#include <avr/interrupt.h>
#include <avr/io.h>

void interrupt_after(uint16_t delay)
{
    TCCR1B = _BV(CS10); // simavr takes a count only while the timer runs
    TCNT1 = (uint16_t)~delay;
    TIFR1 = _BV(TOV1);
    TIMSK1 = _BV(TOIE1);
    sei();
}

void interrupt_never(void)
{
    TCCR1B = 0;
    TIMSK1 = 0;
}

// The compiler's own word for where it returns to, which counts instructions.
ISR(TIMER1_OVF_vect)
{
    interrupt_came(2u * (uintptr_t)__builtin_return_address(0));
}
