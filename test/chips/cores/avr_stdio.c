// SPDX-License-Identifier: MIT
// What a test program prints goes out through UART0, which simavr shows; the
// end of the program, a sleep without interrupts, ends the simulation.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#include <stdio.h>
#include <stdlib.h>

static int put(char character, FILE *stream)
{
    (void)stream;
    while ((UCSR0A & _BV(UDRE0)) == 0) {
    }
    UDR0 = (uint8_t)character;
    return 0;
}

static FILE uart = FDEV_SETUP_STREAM(put, 0, _FDEV_SETUP_WRITE);

__attribute__((constructor)) static void start(void)
{
    UCSR0B = _BV(TXEN0);
    stdout = &uart;
}

__attribute__((destructor)) static void stop(void)
{
    cli();
    sleep_mode();
}

void exit(int status)
{
    (void)status;
    stop();
    for (;;) {
    }
}
