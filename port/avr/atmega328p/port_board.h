// SPDX-License-Identifier: MIT
// The board of the motor and the ovens: ATmega328P at 16 MHz, an Arduino Uno.
#ifndef PORT_BOARD_H
#define PORT_BOARD_H

#define PORT_TICKS_PER_SECOND 1000u

// PWM at 15.6 kHz of 1024 counts on PB1 (D9 of an Uno), and the direction on
// PB0 (D8): 1 is negative.
#define PORT_DRIVE_FULL 1023

// Shorter pulses are not made: 1 to 3 counts are 63 to 188 ns, too short for a
// bridge to follow.
#define PORT_DRIVE_LEAST 4

// Analog inputs ADC0, ADC1 and ADC2 (A0 to A2), as ADMUX has them; the
// reference is AVCC. A thermostat has its selector where a motor has its
// tachometer.
#define PORT_SETPOINT 0x40u
#define PORT_TACHOMETER 0x41u
#define PORT_SELECTOR PORT_TACHOMETER
#define PORT_TEMPERATURE 0x42u

// Of port_uart.h, on PD0 (RX) and PD1 (TX), an Uno's USB: the clock divides by
// it exactly, and 115200 would be 3.5 % off.
#define PORT_UART_BAUD 250000u

// The loop never ends, and as a constant that costs nothing.
#define port_running() true

#endif
