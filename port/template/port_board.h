// SPDX-License-Identifier: MIT
// What the board fixes. Copy this folder, write your chip's numbers in place of
// these, and name the channels after what is wired to them: the examples use
// PORT_ANGLE, PORT_KP, PORT_KI, PORT_KD (the pendulum), PORT_SETPOINT and
// PORT_TACHOMETER (the motor), PORT_SETPOINT, PORT_SELECTOR and
// PORT_TEMPERATURE (the ovens).
#ifndef PORT_BOARD_H
#define PORT_BOARD_H

// The nominal tick rate, an integer without a cast, for #if: 1 to 65535. AN964
// wants 256, the ovens 1000.
#define PORT_TICKS_PER_SECOND 1000u

// The duty count of full drive, 4 to 32767.
#define PORT_DRIVE_FULL 1023

// The least duty count that is more than off, 1 to PORT_DRIVE_FULL: a bridge
// does not follow shorter pulses. With 1 every count is made.
#define PORT_DRIVE_LEAST 4

// A/D channels, bytes that port_read understands: the value of the channel
// register, if that has room in a byte.
#define PORT_SETPOINT 0x00u
#define PORT_TACHOMETER 0x01u
#define PORT_TEMPERATURE 0x02u
#define PORT_ANGLE 0x03u
#define PORT_KP 0x04u
#define PORT_KI 0x05u
#define PORT_KD 0x06u

// Of port_uart.h, if there is a port_uart.c: a rate that the clock divides
// well.
#define PORT_UART_BAUD 250000u

// On a chip the loop never ends. As a constant it costs nothing; without this
// line port.c defines the function.
#define port_running() true

#endif
