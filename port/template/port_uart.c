// SPDX-License-Identifier: MIT
// A UART to fill in, for a chip that has one: see port_uart.h, which says what
// it promises. It compiles as it is, and then does nothing.
// test/use/port_check/filled/port_uart.c is one for an imaginary chip. On a PC
//     test/use/port_check/run FOLDER
// checks it beside port.c, once FOLDER/fake has the UART, too. A chip without
// one has no such file, and PORT_UART_BAUD does not stand in its port_board.h.
#include "port_uart.h"

#include "port.h"

// The interrupt of a UART that can take a byte: enabled, and not. Clearing it
// may meet the interrupt itself, which then comes once more: that is harmless.
#define PORT_UART_SEND() ((void)0)
#define PORT_UART_QUIET() ((void)0)

// The register with the next byte.
#define PORT_UART_WRITE(byte) ((void)(byte))

// Deviation 20.1: it uses what is above.
#include "port_rings.h"

// The UART can take a byte. Give it the head and the name of your compiler and
// vector; where one interrupt is for both, ask the flags, and do the other
// first.
void uart_is_empty(void);
void uart_is_empty(void)
{
    send_next();
}

// A byte has come.
//   * Read the register, even where the byte is of no use: that clears the
//   flag.
//   * Where an overrun stops the receiver, start it again.
void uart_has_come(void);
void uart_has_come(void)
{
    keep_received(0);
}

// Starts the UART: PORT_UART_BAUD, eight bits, no parity, one stop bit.
//   * A rate within 2 % of it, better nearer.
//   * The rings first, then the UART, its receiver's interrupt last.
void port_uart_init(void)
{
    empty_rings();
}
