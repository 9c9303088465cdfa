// SPDX-License-Identifier: MIT
// What a port_uart.c with an interrupt has in common with the others: a ring of
// bytes each way. port_uart.c includes it once, calls send_next and
// keep_received in its interrupt, and defines before
//
// - PORT_UART_SEND(): from now on the interrupt comes when a byte can be sent;
// - PORT_UART_QUIET(): from now on it does not;
// - PORT_UART_WRITE(byte): sends it.
//
// Of each ring the interrupt writes one index and the loop the other, so
// neither waits for the other or masks it. Indices are single bytes, which
// every chip reads and writes at once; a ring that is full has one byte free.
#ifndef PORT_RINGS_H
#define PORT_RINGS_H
#include "port_uart.h"

#define RING 64u // a power of two, one more than its ring holds
#define RING_LAST (RING - 1u)

#if (PORT_UART_OUT != RING_LAST) || (PORT_UART_IN != RING_LAST)
#error "the rings hold RING_LAST bytes"
#endif

static volatile uint8_t out_bytes[RING];
static volatile uint8_t out_head; // the loop's
static volatile uint8_t out_tail; // the interrupt's
static volatile uint8_t in_bytes[RING];
static volatile uint8_t in_head; // the interrupt's
static volatile uint8_t in_tail; // the loop's

static void empty_rings(void)
{
    out_head = 0;
    out_tail = 0;
    in_head = 0;
    in_tail = 0;
}

uint8_t port_uart_room(void)
{
    return (uint8_t)(RING_LAST - ((uint8_t)(out_head - out_tail) & RING_LAST));
}

void port_uart_put(uint8_t byte)
{
    const uint8_t at = out_head;
    const uint8_t next = (uint8_t)((at + 1u) & RING_LAST);

    if (next != out_tail) {
        out_bytes[at] = byte;
        out_head = next;
        PORT_UART_SEND();
    }
}

// A byte can be sent. There may be none: where PORT_UART_SEND reads a register
// and writes it, this may come in between.
static void send_next(void)
{
    const uint8_t at = out_tail;

    if (at == out_head) {
        PORT_UART_QUIET();
        return;
    }
    out_tail = (uint8_t)((at + 1u) & RING_LAST);
    PORT_UART_WRITE(out_bytes[at]);
}

static void keep_received(uint8_t byte)
{
    const uint8_t at = in_head;
    const uint8_t next = (uint8_t)((at + 1u) & RING_LAST);

    if (next != in_tail) {
        in_bytes[at] = byte;
        in_head = next;
    }
}

uint8_t port_uart_waiting(void)
{
    return (uint8_t)((uint8_t)(in_head - in_tail) & RING_LAST);
}

uint8_t port_uart_get(void)
{
    const uint8_t at = in_tail;
    const uint8_t byte = in_bytes[at];

    if (at != in_head) {
        in_tail = (uint8_t)((at + 1u) & RING_LAST);
    }
    return byte;
}

#endif
