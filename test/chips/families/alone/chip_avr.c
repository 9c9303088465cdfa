// SPDX-License-Identifier: MIT
// Tells avr.c when a part is over, and goes on when that has looked.
#include "program.h"

volatile uint8_t over;

int main(void)
{
    for (uint8_t number = 0; number < PROGRAM_PARTS; number++) {
        program_do(number);
        over = 1;
        while (over != 0u) {
        }
    }
    for (;;) {
    }
}
