// SPDX-License-Identifier: MIT
// Writes what the experiments left to the simulator's file, through its
// interface: see ../ucsim_main.c.
#include "alone.h"

#define INTERFACE (*(volatile uint8_t *)0x57FF)
#define WRITE 'w'
#define STOP 's'

static void write(uint8_t byte)
{
    INTERFACE = WRITE;
    INTERFACE = byte;
}

void main(void)
{
    uint8_t number;
    uint8_t at;

    for (number = 0; number < ALONE_EXPERIMENTS; number++) {
        alone_do(number);
        for (at = 0; at < ALONE_SIZE; at++) {
            write(alone_bytes[at]);
        }
    }
    INTERFACE = STOP;
}
