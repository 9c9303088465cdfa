// SPDX-License-Identifier: MIT
// The board of the motor and the ovens: PIC18F4520 at 40 MHz.
#ifndef PORT_BOARD_H
#define PORT_BOARD_H

#define PORT_TICKS_PER_SECOND 1000u

// PWM at 39 kHz (PR2 = 0xFF) on RC2, and the direction on RC0: 1 is negative.
#define PORT_DRIVE_FULL 1023

// Shorter pulses are not made: 1 to 3 counts are 25 to 75 ns, too short for a
// bridge to follow.
#define PORT_DRIVE_LEAST 4

// Analog inputs AN0, AN1 and AN2, as ADCON0 has them from bit 2; with the
// converter on. A thermostat has its selector where a motor has its tachometer.
#define PORT_SETPOINT 0x01u
#define PORT_TACHOMETER 0x05u
#define PORT_SELECTOR PORT_TACHOMETER
#define PORT_TEMPERATURE 0x09u

// Of port_uart.h, on RC6 (TX) and RC7 (RX): the clock divides by it exactly.
#define PORT_UART_BAUD 250000u

#endif
