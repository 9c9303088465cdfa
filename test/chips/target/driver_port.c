// SPDX-License-Identifier: MIT
// The port's functions, one at a time, as a harness asks for them.
#include "port.h"

// 0 gives the turn to the harness, which sets it to 1 when it has asked.
volatile uint8_t turn;

// Which function: 'r'ead, 'd'rive, 't'icks, 'w'ait_tick or, with the number of
// them in `channel`, wait_ticks 'n'. Else `channel` counts the board's.
volatile uint8_t call;
volatile uint8_t channel;
volatile uint16_t reading;
volatile int16_t duty;
volatile uint8_t ticks_told;

// The board's channels, in the order of its pins.
#if defined(PORT_ANGLE)
static const uint8_t channels[] = {PORT_ANGLE, PORT_KP, PORT_KI, PORT_KD};
#else
static const uint8_t channels[] = {PORT_SETPOINT, PORT_TACHOMETER,
                                   PORT_TEMPERATURE};
#endif

int main(void)
{
    port_init();
    for (;;) {
        turn = 0;
        while (turn == 0u) {
        }
        if (call == (uint8_t)'r') {
            reading = port_read(channels[channel]);
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
