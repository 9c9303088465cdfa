// SPDX-License-Identifier: MIT
#include "chip.h"
#include "fixpid_an964.h"

FIXPID_DATA struct fixpid_an964 controller;

void main(void)
{
    static const struct fixpid_an964_gains gains = {512, 16, 64};

    (void)fixpid_an964_init(&controller, &gains);
    while (1) {
        const int16_t output = fixpid_an964_step(&controller, PORTA);
        PORTC = (uint8_t)output;
    }
}
