// SPDX-License-Identifier: MIT
// The loop of a driver on a chip: it answers whenever the harness has asked.
// Build with -DREPLY=an964_reply or another driver's function.
#include "arith.h"
#include "compiler.h"
#include "configuration.h"
#include "exchange.h"

// 0 gives the turn to the harness, which sets it to 1 when it has asked.
volatile uint8_t turn;

void main(void)
{
    for (;;) {
        turn = 0;
        while (turn == 0u) {
        }
        PORT_CLEAR_WATCHDOG();
        REPLY();
    }
}
