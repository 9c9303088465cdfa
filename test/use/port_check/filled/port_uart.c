// SPDX-License-Identifier: MIT
// The template filled in for the imaginary chip: one interrupt for both ways.
#include "port_uart.h"

#include "port.h"

#include <chip.h>

#define CLOCK_HZ 16000000u

#define PORT_UART_SEND() (UART_INTERRUPTS |= UART_EMPTY)
#define PORT_UART_QUIET() (UART_INTERRUPTS &= (uint8_t)~UART_EMPTY)
#define PORT_UART_WRITE(byte) (UART_BYTE = (byte))

#include "port_rings.h"

void uart_vector(void)
{
    if ((UART_FLAGS & UART_CAME) != 0u) {
        keep_received((uint8_t)UART_BYTE);
        UART_FLAGS &= (uint8_t)~UART_CAME;
    }
    if ((UART_FLAGS & UART_EMPTY) != 0u) {
        send_next();
    }
}

void port_uart_init(void)
{
    UART_INTERRUPTS = 0;
    empty_rings();
    UART_CLOCKS = CLOCK_HZ / PORT_UART_BAUD;
    UART_INTERRUPTS = UART_CAME;
}
