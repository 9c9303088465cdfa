// SPDX-License-Identifier: MIT
// A simulated Arduino Uno with the room of room.h on A0 and pin 9, for a
// program that runs a sketch on it.
#ifndef CHIP_H
#define CHIP_H
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <stdarg.h>
#include <stdbool.h>

#include "room.h"

#define HZ 16000000u
#define SUPPLY_MV 5000
#define PORTB 0x25u
#define TCCR1A 0x80u
#define COM1A1 0x80u // the timer drives pin 9, which is PB1
#define OCR1AL 0x88u

static avr_t *avr;

static void silent(struct avr_t *chip, const int level, const char *format,
                   va_list ap)
{
    (void)chip;
    (void)level;
    (void)format;
    (void)ap;
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

// To be called before the conversion that has been started is over: the least
// voltage that gives the room's counts.
static void convert(void)
{
    const int counts = room_counts(drive());

    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0),
                  (uint32_t)(((counts * SUPPLY_MV) + 1022) / 1023));
}

static avr_irq_t *uart(int which)
{
    return avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), which);
}

// The actions are called with each byte that the chip sends, and when it starts
// a conversion. False if there is no such firmware.
static bool chip_start(const char *elf, avr_irq_notify_t sent,
                       avr_irq_notify_t converting)
{
    elf_firmware_t firmware = {.frequency = HZ};
    uint32_t uart_flags = 0;

    avr_global_logger_set(silent);
    if (elf_read_firmware(elf, &firmware) != 0) {
        return false;
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
    avr_irq_register_notify(uart(UART_IRQ_OUTPUT), sent, NULL);
    avr_irq_register_notify(
        avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER),
        converting, NULL);
    return true;
}

// One instruction; false if the chip does not run on.
static bool chip_run(void)
{
    const int state = avr_run(avr);

    return (state != cpu_Done) && (state != cpu_Crashed);
}

#endif
