// SPDX-License-Identifier: MIT
// The port's functions, one at a time, as a harness asks for them.
#include "port.h"

// 0 gives the turn to the harness, which sets it to 1 when it has asked.
volatile uint8_t turn;

// Which function: 'r'ead, 'd'rive, 't'icks, 'w'ait_tick or, with the number of
// them in `channel`, wait_ticks 'n'.
volatile uint8_t call;
volatile uint8_t channel;
volatile uint16_t reading;
volatile int16_t duty;
volatile uint8_t ticks_told;

int main(void)
{
    port_init();
    for (;;) {
        turn = 0;
        while (turn == 0u) {
        }
        if (call == (uint8_t)'r') {
            reading = port_read(channel);
        } else if (call == (uint8_t)'d') {
            port_drive(duty);
        } else if (call == (uint8_t)'t') {
            ticks_told = port_ticks();
        } else if (call == (uint8_t)'n') {
            ticks_told = port_wait_ticks(channel);
        } else {
            ticks_told = port_wait_tick();
        }
    }
}
