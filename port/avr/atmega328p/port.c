// SPDX-License-Identifier: MIT
// port.h on an ATmega328P with 16 MHz: the tick from Timer0, the drive from
// Timer1 and a direction pin. docs/ports.md has the pins, the measured period
// and the reasons.
#include "port.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

// PB0 is the direction and PB1 is OC1A, PB6 and PB7 the crystal. ADC0 to ADC2
// are PC0 to PC2. Pins without a use are inputs with pull-ups: on an Uno a PC
// may drive PD0.
#define REVERSE 0x01u
#define DRIVE_PINS 0x03u
#define PORTB_UNUSED 0x3Cu
#define PORTC_UNUSED 0x38u
#define PORTD_UNUSED 0xFFu

// A channel inside the chip, at 0 V.
#define GROUND 0x4Fu

// Timer0 counts 250 times 64 cycles.
#define TICK_TOP 249u

// Timer1 counts 1024 cycles. OC1A goes high after the count of OCR1A and low
// at the period's end, which with TOP is never: off without a spike.
#define PWM_TOP 1023u
#define TCCR1A_PWM 0xC3u // inverted, fast PWM of 10 bits
#define TCCR1B_PWM 0x09u // the same, 1:1

// The interrupt writes only the first and the loop only the second, so neither
// ever waits for the other or masks it. Their difference is the ticks to tell.
static volatile uint8_t ticks_counted;
static volatile uint8_t ticks_taken;

// Deviation 2.7: a vector, not a parameter.
ISR(TIMER0_COMPA_vect)
{
    const uint8_t next = (uint8_t)(ticks_counted + 1u);

    if (next != ticks_taken) { // 255 ahead: it stays there
        ticks_counted = next;
    }
}

// Takes effect at the end of the PWM period. No interrupt touches a register of
// 16 bits, which all share the byte that holds a high half for a while.
static void set_duty(uint16_t counts)
{
    OCR1A = (uint16_t)(PWM_TOP - counts);
}

static void wait_for_end_of_period(void)
{
    TIFR1 = (uint8_t)_BV(TOV1);
    while ((TIFR1 & (uint8_t)_BV(TOV1)) == 0u) {
    }
}

static void init_pins(void)
{
    PORTB = PORTB_UNUSED;
    PORTC = PORTC_UNUSED;
    PORTD = PORTD_UNUSED;
    DIDR0 = 0x07u; // ADC0 to ADC2 have no digital input
}

// The drive's pins become outputs last, with no duty.
static void init_drive(void)
{
    set_duty(0);
    TCCR1A = TCCR1A_PWM;
    TCCR1B = TCCR1B_PWM;
    wait_for_end_of_period();
    DDRB = DRIVE_PINS;
}

static void wait_for_conversion(void)
{
    while ((ADCSRA & (uint8_t)_BV(ADSC)) != 0u) {
    }
}

// On, with 125 kHz: 104 us a conversion. The first takes twice as long, so it
// is of no pin.
static void init_converter(void)
{
    ADMUX = GROUND;
    ADCSRA = 0xC7u;
    wait_for_conversion();
}

// The timer clears itself at the top, so no latency enters the period.
static void init_tick(void)
{
    TCCR0A = 0x02u; // clear on compare
    OCR0A = TICK_TOP;
    TCCR0B = 0x03u; // 1:64
    TIMSK0 = (uint8_t)_BV(OCIE0A);
}

void port_init(void)
{
    wdt_enable(WDTO_30MS);
    init_pins();
    init_drive();
    init_converter();
    init_tick();
    sei();
}

#define PORT_CLEAR_WATCHDOG() wdt_reset()

// Deviation 20.1: it uses what is above.
#include "port_ticks.h"

uint16_t port_read(uint8_t channel)
{
    ADMUX = channel;
    ADCSRA |= (uint8_t)_BV(ADSC);
    wait_for_conversion();
    return ADC;
}

// No duty for a whole PWM period before the direction changes.
static void turn_around(uint8_t direction)
{
    set_duty(0);
    wait_for_end_of_period();
    wait_for_end_of_period();
    PORTB = (uint8_t)(PORTB_UNUSED | direction);
}

void port_drive(int16_t duty)
{
    uint16_t magnitude = (uint16_t)duty;
    uint8_t direction = 0;

    if ((magnitude & 0x8000u) != 0u) {
        magnitude = (uint16_t)(0u - magnitude);
        direction = REVERSE;
    }
    if (magnitude > (uint16_t)PORT_DRIVE_FULL) {
        magnitude = (uint16_t)PORT_DRIVE_FULL;
    }
    if (magnitude < (uint16_t)PORT_DRIVE_LEAST) {
        set_duty(0);
        return;
    }
    if ((PORTB & REVERSE) != direction) {
        turn_around(direction);
    }
    set_duty(magnitude);
}
