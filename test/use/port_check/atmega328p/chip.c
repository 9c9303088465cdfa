// SPDX-License-Identifier: MIT
// An ATmega328P as far as port/avr/atmega328p sees it: see ../fake.h. It shows
// that a port which was not written for this check can be checked so.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

#define PWM_PERIOD 7u // uses of a register
#define CONVERSION 5u // the same
#define PWM_TOP 1023
#define CLOCK 0x07u     // of a timer's TCCRB
#define ADC_ON 0xC0u    // ADEN, ADSC
#define ADC_START 0x40u // ADSC
#define CHANNEL 0x0Fu
#define UNWRITTEN 0x80u // an unused bit of TIFR1: a write of the port clears it

volatile uint8_t fake_portb, fake_portc, fake_portd, fake_ddrb;
volatile uint8_t fake_didr0, fake_tifr1, fake_tccr1a, fake_tccr1b;
volatile uint8_t fake_admux, fake_adcsra, fake_tccr0a, fake_tccr0b;
volatile uint8_t fake_ocr0a, fake_timsk0;
volatile uint8_t fake_ucsr0a, fake_ucsr0b, fake_ucsr0c;
volatile uint16_t fake_ocr1a, fake_adc, fake_ubrr0, fake_udr0;
volatile bool fake_interrupts_on;
volatile unsigned fake_feeds;

const uint32_t chip_code_most = 1023;

static int32_t duty_made;
static uint8_t flags; // TIFR1
static unsigned periods;
static unsigned conversions;

void chip_reset(void)
{
    fake_tifr1 = UNWRITTEN;
}

// OCR1A counts the part of a period without duty, and is taken at its end.
static void pwm_moves(void)
{
    static unsigned in_period = 0;

    if ((fake_tifr1 & UNWRITTEN) == 0u) {
        flags &= (uint8_t)~fake_tifr1; // written ones clear
    }
    if ((fake_tccr1b & CLOCK) != 0u) {
        in_period = (in_period + 1u) % PWM_PERIOD;
        if (in_period == 0u) {
            periods++;
            duty_made = PWM_TOP - (int32_t)fake_ocr1a;
            flags |= (uint8_t)_BV(TOV1);
        }
    }
    fake_tifr1 = flags | UNWRITTEN;
}

static void converter_moves(void)
{
    static unsigned converting = 0;
    static uint8_t channel = 0; // the chip takes ADMUX as a conversion begins

    if ((fake_adcsra & ADC_ON) != ADC_ON) {
        return;
    }
    if (converting == 0u) {
        conversions++;
        channel = fake_admux & CHANNEL;
    }
    converting = (converting + 1u) % CONVERSION;
    if (converting == 0u) {
        fake_adcsra &= (uint8_t)~ADC_START;
        fake_adc = (uint16_t)chip_inputs[channel];
    }
}

void chip_moves(void)
{
    pwm_moves();
    converter_moves();
}

unsigned chip_periods(void)
{
    return periods;
}

int32_t chip_duty(void)
{
    return duty_made;
}

bool chip_reverse(void)
{
    return (fake_portb & 0x01u) != 0u;
}

bool chip_is_output(void)
{
    return (fake_ddrb & 0x03u) == 0x03u;
}

// Nothing of the port masks interrupts, so each one comes at once.
bool chip_tick(void)
{
    if ((fake_tccr0b & CLOCK) == 0u) {
        return false;
    }
    if (fake_interrupts_on && ((fake_timsk0 & _BV(OCIE0A)) != 0u)) {
        TIMER0_COMPA_vect();
    }
    return true;
}

unsigned chip_feeds(void)
{
    return fake_feeds;
}

unsigned chip_conversions(void)
{
    return conversions;
}

unsigned chip_input_of(uint8_t channel)
{
    return channel & CHANNEL;
}

// --- the UART ---

#define UNWRITTEN_BYTE 0x100u
#define EIGHT_BITS 0x06u // UCSZ, and nothing else
#define CLOCK_HZ 16000000u

static bool uart_is(unsigned on, unsigned interrupt)
{
    const unsigned both = _BV(on) | _BV(interrupt);

    return fake_interrupts_on && ((fake_ucsr0b & both) == both) &&
           (fake_ucsr0c == EIGHT_BITS);
}

int chip_uart_sends(bool late)
{
    fake_udr0 = UNWRITTEN_BYTE;
    if (late || uart_is(TXEN0, UDRIE0)) {
        USART_UDRE_vect();
    }
    return (fake_udr0 == UNWRITTEN_BYTE) ? -1 : (int)fake_udr0;
}

void chip_uart_receives(uint8_t byte)
{
    fake_udr0 = byte;
    if (uart_is(RXEN0, RXCIE0)) {
        USART_RX_vect();
    }
}

// 16 clocks a bit without U2X.
uint32_t chip_uart_baud(void)
{
    return (fake_ucsr0a != 0u) ? 0u : CLOCK_HZ / 16u / (fake_ubrr0 + 1u);
}
