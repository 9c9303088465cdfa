// SPDX-License-Identifier: MIT
// Runs the sketch Live on a simulated Arduino Uno, with a program of a PC at
// its UART: see link_session.h.
//
//   live FIRMWARE.elf CLEAN NOISY AGAIN
//
// the steps of each part. Exit status: 0 all is as it should be, 1 something is
// not, 2 there is no such firmware.
#include <stdio.h>
#include <stdlib.h>

#include "chip.h"
#include "link_session.h"

#define BYTE_CYCLES 400u // a little more than the UART takes for one

static struct link_session session;

static void sent(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    link_session_take(&session, (uint8_t)value);
}

static void converting(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)value;
    (void)param;
    convert();
    link_session_step(&session);
}

static unsigned long steps(const char *word)
{
    return strtoul(word, NULL, 10);
}

int main(int argc, char **argv)
{
    uint64_t next = 0;

    if ((argc != 5) || !chip_start(argv[1], sent, converting)) {
        return 2;
    }
    link_session_init(
        &session, FIXPID_LINK_SETPOINT | FIXPID_LINK_GAINS | FIXPID_LINK_MANUAL,
        steps(argv[2]), steps(argv[3]), steps(argv[4]));
    while (!link_session_over(&session) && chip_run()) {
        uint8_t byte;

        if ((avr->cycle >= next) && link_session_give(&session, &byte)) {
            avr_raise_irq(uart(UART_IRQ_INPUT), byte);
            next = avr->cycle + BYTE_CYCLES;
        }
    }
    return link_session_good(&session, stdout) ? 0 : 1;
}
