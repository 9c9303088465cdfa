// SPDX-License-Identifier: MIT
// The registers that port/avr/atmega328p uses, for ../chip.c.
#ifndef FAKE_AVR_IO_H
#define FAKE_AVR_IO_H
#include "fake.h"

extern volatile uint8_t fake_portb, fake_portc, fake_portd, fake_ddrb;
extern volatile uint8_t fake_didr0, fake_tifr1, fake_tccr1a, fake_tccr1b;
extern volatile uint8_t fake_admux, fake_adcsra, fake_tccr0a, fake_tccr0b;
extern volatile uint8_t fake_ocr0a, fake_timsk0;
extern volatile uint8_t fake_ucsr0a, fake_ucsr0b, fake_ucsr0c;
extern volatile uint16_t fake_ocr1a, fake_adc, fake_ubrr0, fake_udr0;

#define PORTB (*fake_byte(&fake_portb))
#define PORTC (*fake_byte(&fake_portc))
#define PORTD (*fake_byte(&fake_portd))
#define DDRB (*fake_byte(&fake_ddrb))
#define DIDR0 (*fake_byte(&fake_didr0))
#define TIFR1 (*fake_byte(&fake_tifr1))
#define TCCR1A (*fake_byte(&fake_tccr1a))
#define TCCR1B (*fake_byte(&fake_tccr1b))
#define ADMUX (*fake_byte(&fake_admux))
#define ADCSRA (*fake_byte(&fake_adcsra))
#define TCCR0A (*fake_byte(&fake_tccr0a))
#define TCCR0B (*fake_byte(&fake_tccr0b))
#define OCR0A (*fake_byte(&fake_ocr0a))
#define TIMSK0 (*fake_byte(&fake_timsk0))
#define UCSR0A (*fake_byte(&fake_ucsr0a))
#define UCSR0B (*fake_byte(&fake_ucsr0b))
#define UCSR0C (*fake_byte(&fake_ucsr0c))
#define UBRR0 (*fake_word(&fake_ubrr0))
#define UDR0 (*fake_word(&fake_udr0)) // beyond a byte: not written
#define OCR1A (*fake_word(&fake_ocr1a))
#define ADC (*fake_word(&fake_adc))

#define _BV(bit) (1u << (bit))
#define TOV1 0
#define ADSC 6
#define OCIE0A 1
#define TXEN0 3
#define RXEN0 4
#define UDRIE0 5
#define RXCIE0 7

#endif
