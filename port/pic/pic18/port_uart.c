// SPDX-License-Identifier: MIT
// The (E)USART on RC6 (TX) and RC7 (RX). Its interrupt is the tick's, in
// port_pic18.h, which calls port_uart_interrupt if port.c is compiled with
// -DPORT_UART.
#include "port_uart.h"

#include "port.h"
#include "registers_pic18.h"

// Sixteen clocks a bit: BRGH without BRG16.
#define CLOCKS_A_BIT 16u
#define SPBRG_BOARD ((40000000u / CLOCKS_A_BIT / PORT_UART_BAUD) - 1u)

#define TRISC_UART 0xC0u // inputs: the UART drives TX itself
#define TXSTA_ON 0x24u   // TXEN, BRGH
#define RCSTA_ON 0x90u   // SPEN, CREN
#define RCSTA_CREN 0x10u
#define RCSTA_OERR 0x02u
#define TX 0x10u // of PIR1, PIE1 and IPR1
#define RC 0x20u // likewise

#define PORT_UART_SEND() (PIE1 |= (uint8_t)TX)
#define PORT_UART_QUIET() (PIE1 &= (uint8_t)~TX)
#define PORT_UART_WRITE(byte) (TXREG = (byte))

// Deviation 20.1: it uses what is above.
#include "port_rings.h"

// A receiver that was overrun stands still until it is switched off.
PORT_UART_INTERRUPT()
{
    if ((PIR1 & RC) != 0u) {
        keep_received(RCREG);
    }
    if ((RCSTA & RCSTA_OERR) != 0u) {
        RCSTA &= (uint8_t)~RCSTA_CREN;
        RCSTA |= RCSTA_CREN;
    }
    if ((uint8_t)(PIE1 & PIR1 & TX) != 0u) {
        send_next();
    }
}

void port_uart_init(void)
{
    PIE1 = 0u;
    empty_rings();
    TRISC |= TRISC_UART;
    SPBRG = SPBRG_BOARD;
    TXSTA = TXSTA_ON;
    RCSTA = RCSTA_ON;
    IPR1 |= (uint8_t)(TX | RC);
    PIE1 = RC;
}
