// SPDX-License-Identifier: MIT
// Runs firmware on a simulated Arduino Uno with the room of the sketch Heater
// on A0 and pin 9, until it has sent so many lines, which it prints.
//
//   uno FIRMWARE.elf LINES
//
// Exit status: 0 they came, 1 not within a minute of the chip's time, 2 there
// is no such firmware.
#include <stdio.h>
#include <stdlib.h>

#include "chip.h"

static long lines;

static void sent(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    lines += value == '\n';
    putchar((int)value);
}

static void converting(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)value;
    (void)param;
    convert();
#ifdef KEY
    if (room_steps == KEY) {
        avr_raise_irq(uart(UART_IRQ_INPUT), 'a');
    }
#endif
}

int main(int argc, char **argv)
{
    if ((argc != 3) || !chip_start(argv[1], sent, converting)) {
        return 2;
    }
    while (lines < atol(argv[2])) {
        if (!chip_run() || (avr->cycle > 60ull * HZ)) {
            return 1;
        }
    }
    return 0;
}
