// SPDX-License-Identifier: MIT
// The Uno's board for the motor and ovens: PWM on OC1A (PB1), the direction on
// PB0.
#include "board.hh"

#include "port_board.h"

namespace
{

constexpr unsigned ddrb = 0x24, portb = 0x25, adcsra = 0x7A, admux = 0x7C;
constexpr unsigned tccr1a = 0x80, tccr1b = 0x81, ocr1al = 0x88;

constexpr unsigned timer0_compa = 14 * 4; // its vector
constexpr unsigned adsc = 0x40;
constexpr unsigned direction_pin = 0x01; // PB0; high is reverse
constexpr unsigned drive_pins = 0x03;
constexpr unsigned inverted_pwm = 0xC3, timer_on = 0x09;
constexpr int top = 1023;

} // namespace

const Board board = {
    "atmega328p",
    16e6,
    1600, // 0.1 ms
    {timer0_compa},
    {{PORT_SETPOINT, "adc0"},
     {PORT_TACHOMETER, "adc1"},
     {PORT_TEMPERATURE, "adc2"}},
    adcsra,
    adsc,
    0x4F,
    {ocr1al, tccr1a, tccr1b, ddrb, portb}, // OCR1AH waits for OCR1AL
};

unsigned board_channel(const Chip &chip, unsigned)
{
    return chip.peek(admux);
}

int board_drive_counts(const Chip &chip)
{
    const bool pwm = chip.peek(tccr1a) == inverted_pwm;
    const bool running = chip.peek(tccr1b) == timer_on;
    const bool driven = (chip.peek(ddrb) & drive_pins) == drive_pins;
    if (!pwm || !running || !driven) {
        return 0;
    }
    const int counts = top - (int)chip.peek_u16(ocr1al);
    return ((chip.peek(portb) & direction_pin) != 0) ? -counts : counts;
}
