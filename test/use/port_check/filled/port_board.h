// SPDX-License-Identifier: MIT
// The board of an imaginary chip with 16 MHz: a motor, as in port.h.
#ifndef PORT_BOARD_H
#define PORT_BOARD_H

#define PORT_TICKS_PER_SECOND 1000u

// PWM of 800 counts: 20 kHz.
#define PORT_DRIVE_FULL 800

// Shorter pulses are not made: 1 to 3 counts are 63 to 188 ns.
#define PORT_DRIVE_LEAST 4

#define PORT_SETPOINT 0x00u
#define PORT_TACHOMETER 0x03u

#define PORT_UART_BAUD 125000u

#define port_running() true

#endif
