// SPDX-License-Identifier: MIT
// Writes what the parts left to the simulator's file, through its
// interface: see ../ucsim_main.c.
#include "program.h"

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

    for (number = 0; number < PROGRAM_PARTS; number++) {
        program_do(number);
        for (at = 0; at < PROGRAM_SIZE; at++) {
            write(program_bytes[at]);
        }
    }
    INTERFACE = STOP;
}
