// SPDX-License-Identifier: MIT
// As driver_main.c, with a port and its tick: before each reply the ticks are
// taken from the interrupt.
#include "exchange.h"
#include "port.h"

volatile uint8_t turn;

// What port_ticks returned in this turn.
volatile uint8_t TICKS_TOLD_PLACE ticks_told;

int main(void)
{
    port_init();
    for (;;) {
        turn = 0;
        while (turn == 0u) {
        }
        ticks_told = port_ticks();
        REPLY();
    }
}
