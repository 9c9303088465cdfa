// SPDX-License-Identifier: MIT
// Runs firmware on a simulated Arduino Uno with the room of the sketch Heater
// on A0 and pin 9, until it has sent so many lines, which it prints.
//
//   uno FIRMWARE.elf LINES
//
// Exit status: 0 they came, 1 not within a minute of the chip's time, 2 there
// is no such firmware.
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "room.h"

#define HZ 16000000u
#define SUPPLY_MV 5000
#define PORTB 0x25u
#define TCCR1A 0x80u
#define COM1A1 0x80u // the timer drives pin 9, which is PB1
#define OCR1AL 0x88u

static avr_t *avr;
static long lines;

static void silent(struct avr_t *chip, const int level, const char *format,
                   va_list ap)
{
    (void)chip;
    (void)level;
    (void)format;
    (void)ap;
}

static void sent(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    lines += value == '\n';
    putchar((int)value);
}

// 0 and 255 of analogWrite are the pin without a timer.
static int drive(void)
{
    const uint8_t *const data = avr->data;

    if ((data[TCCR1A] & COM1A1) != 0) {
        return data[OCR1AL];
    }
    return ((data[PORTB] & 2) != 0) ? 255 : 0;
}

// Before the conversion that has been started is over: the least voltage that
// gives these counts.
static void converting(struct avr_irq_t *irq, uint32_t value, void *param)
{
    const int counts = room_counts(drive());

    (void)irq;
    (void)value;
    (void)param;
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0),
                  (uint32_t)(((counts * SUPPLY_MV) + 1022) / 1023));
#ifdef KEY
    if (room_steps == KEY) {
        avr_raise_irq(
            avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT),
            'a');
    }
#endif
}

int main(int argc, char **argv)
{
    elf_firmware_t firmware = {.frequency = HZ};
    uint32_t uart_flags = 0;

    avr_global_logger_set(silent);
    if ((argc != 3) || (elf_read_firmware(argv[1], &firmware) != 0)) {
        return 2;
    }
    avr = avr_make_mcu_by_name("atmega328p");
    (void)avr_init(avr);
    avr->frequency = HZ;
    avr->vcc = avr->avcc = avr->aref = SUPPLY_MV;
    avr_load_firmware(avr, &firmware);
    // What is sent is not printed a second time, by the simulator.
    (void)avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &uart_flags);
    uart_flags &= ~(uint32_t)AVR_UART_FLAG_STDIO;
    (void)avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &uart_flags);
    avr_irq_register_notify(
        avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), sent,
        NULL);
    avr_irq_register_notify(
        avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER),
        converting, NULL);

    while (lines < atol(argv[2])) {
        const int state = avr_run(avr);
        if ((state == cpu_Done) || (state == cpu_Crashed) ||
            (avr->cycle > 60ull * HZ)) {
            return 1;
        }
    }
    return 0;
}
