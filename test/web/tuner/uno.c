// SPDX-License-Identifier: MIT
// A simulated Arduino Uno for the test of the live card. Its UART is on
// standard input and output, which are a socket of the test's. The chip runs
// only as far as it is asked to, so that a slow page misses nothing:
//
//   uno FIRMWARE.elf
//
// A request is a line `STEPS BYTES` and so many bytes for the UART. The answer
// is a line `BYTES` and what the UART has sent meanwhile. Exit status: 0 the
// input is over, 1 the chip does not run on, 2 there is no such firmware.
#include <stdint.h>
#include <stdio.h>

#include "chip.h"

#define BYTE_CYCLES 400u // a little more than the UART takes for one
#define BYTES 1048576u

static uint8_t in[BYTES];
static size_t in_count;
static size_t in_at; // so many of them has the UART
static uint8_t out[BYTES];
static size_t out_count;
static unsigned long steps_left;

static void sent(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    if (out_count < BYTES) {
        out[out_count] = (uint8_t)value;
        out_count++;
    }
}

static void converting(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)value;
    (void)param;
    convert();
    steps_left--;
}

// Behind what the UART has not got yet. False at the end of the input.
static bool request(void)
{
    size_t bytes;

    if (in_at == in_count) {
        in_at = in_count = 0;
    }
    if (scanf("%lu %zu", &steps_left, &bytes) != 2 || getchar() != '\n' ||
        bytes > BYTES - in_count ||
        fread(&in[in_count], 1, bytes, stdin) != bytes) {
        return false;
    }
    in_count += bytes;
    return true;
}

static void answer(void)
{
    printf("%zu\n", out_count);
    (void)fwrite(out, 1, out_count, stdout);
    (void)fflush(stdout);
    out_count = 0;
}

int main(int argc, char **argv)
{
    uint64_t next = 0;

    if ((argc != 2) || !chip_start(argv[1], sent, converting)) {
        return 2;
    }
    while (request()) {
        while (steps_left != 0) {
            if (!chip_run()) {
                return 1;
            }
            if ((avr->cycle >= next) && (in_at < in_count)) {
                avr_raise_irq(uart(UART_IRQ_INPUT), in[in_at]);
                in_at++;
                next = avr->cycle + BYTE_CYCLES;
            }
        }
        answer();
    }
    return 0;
}
