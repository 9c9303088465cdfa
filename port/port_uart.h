// SPDX-License-Identifier: MIT
// Bytes over a UART, where a chip has one: PORT_UART_BAUD of port_board.h,
// eight bits, no parity, one stop bit. Not every port has it, so it is no part
// of port.h: port_uart.c, beside the chip's port.c or in what its family
// shares, is a source for those applications that call it. On a PIC18 port.c is
// compiled with -DPORT_UART then, as one interrupt serves the tick and the
// UART.
//
// An interrupt moves the bytes while the loop does something else: out of a
// ring of PORT_UART_OUT bytes, and into one of PORT_UART_IN. Nothing here
// waits.
#ifndef PORT_UART_H
#define PORT_UART_H
#include <stdint.h>

#define PORT_UART_OUT 63u
#define PORT_UART_IN 63u

// Starts the UART with empty rings; call it after port_init.
void port_uart_init(void);

// How many bytes port_uart_put takes now.
uint8_t port_uart_room(void);

// Sends a byte, behind those before it. Without room, it is lost.
void port_uart_put(uint8_t byte);

// How many bytes have come that port_uart_get has not returned. What comes
// while PORT_UART_IN bytes wait is lost.
uint8_t port_uart_waiting(void);

// The oldest of these. Without one, any byte.
uint8_t port_uart_get(void);

#endif
