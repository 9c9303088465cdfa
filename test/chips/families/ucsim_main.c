// SPDX-License-Identifier: MIT
// Reads questions and writes answers through the simulator interface of ucsim:
// a byte of memory with a simulator's files behind it. Each access is a command
// or its data.
#include "asked.h"

#if defined(__SDCC_mcs51)
#define INTERFACE (*(volatile __xdata uint8_t *)0xFFFF)
#elif defined(__SDCC_z80)
#define INTERFACE (*(volatile uint8_t *)0x7FFF)
#elif defined(__SDCC_stm8)
#define INTERFACE (*(volatile uint8_t *)0x57FF)
#elif defined(__SDCC_pdk15)
volatile uint8_t __at(0xFF) interface_byte;
#define INTERFACE interface_byte
#elif defined(__SDCC_pdk14)
volatile uint8_t __at(0x7F) interface_byte;
#define INTERFACE interface_byte
#else
#error "where is ucsim's interface?"
#endif

#define MORE_TO_READ 'f'
#define READ 'r'
#define WRITE 'w'
#define STOP 's'

// (A pointer to them would take more of the RAM of a Padauk than there is.)
#define BYTES ((uint8_t *)&EXCHANGE)

void main(void)
{
    uint8_t at;

    for (;;) {
        INTERFACE = MORE_TO_READ;
        if (INTERFACE == 0) {
            INTERFACE = STOP;
        }
        for (at = 0; at != QUESTION_SIZE; at++) {
            INTERFACE = READ;
            BYTES[at] = INTERFACE;
        }
        REPLY();
        for (at = 0; at != ANSWER_SIZE; at++) {
            INTERFACE = WRITE;
            INTERFACE = BYTES[at];
        }
    }
}
