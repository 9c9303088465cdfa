// SPDX-License-Identifier: MIT
// USART0 on PD0 and PD1, which are D0 and D1 of an Uno: its USB.
#include "port_uart.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "port.h"

// 16 clocks a bit: no U2X, whose 8 would be no nearer to a divisor of 1 MHz.
#define CLOCKS_A_BIT 16u
#define UBRR_BOARD ((16000000u / CLOCKS_A_BIT / PORT_UART_BAUD) - 1u)

// The interrupt of an empty UDR0.
#define PORT_UART_SEND() (UCSR0B |= (uint8_t)_BV(UDRIE0))
#define PORT_UART_QUIET() (UCSR0B &= (uint8_t)~_BV(UDRIE0))
#define PORT_UART_WRITE(byte) (UDR0 = (byte))

// Deviation 20.1: it uses what is above.
#include "port_rings.h"

// Deviation 2.7: a vector, not a parameter.
ISR(USART_UDRE_vect)
{
    send_next();
}

// Deviation 2.7: as above.
ISR(USART_RX_vect)
{
    keep_received(UDR0);
}

void port_uart_init(void)
{
    UCSR0B = 0u;
    empty_rings();
    UBRR0 = UBRR_BOARD;
    UCSR0A = 0u;
    UCSR0C = 0x06u; // asynchronous, 8 bits, no parity, one stop bit
    UCSR0B = (uint8_t)(_BV(RXCIE0) | _BV(RXEN0) | _BV(TXEN0));
}
