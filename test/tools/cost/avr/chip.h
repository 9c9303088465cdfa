// SPDX-License-Identifier: MIT
// What both meters of an AVR in simavr share: the chip, and how it runs. To be
// included once.
#ifndef AVR_CHIP_H
#define AVR_CHIP_H
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

static avr_t *chip;

static void die(const char *why)
{
    (void)fprintf(stderr, "avr: %s\n", why);
    exit(2);
}

static void load(const char *path, const char *mcu)
{
    static elf_firmware_t firmware;

    if (elf_read_firmware(path, &firmware) != 0) {
        die("no firmware");
    }
    chip = avr_make_mcu_by_name(mcu);
    if (chip == NULL) {
        die("no such chip in simavr");
    }
    chip->log = 0;
    (void)avr_init(chip);
    chip->frequency = 16000000;
    avr_load_firmware(chip, &firmware);
}

static unsigned stack_pointer(void)
{
    return chip->data[R_SPL] | ((unsigned)chip->data[R_SPH] << 8);
}

static void run_one(void)
{
    const int state = avr_run(chip);

    if (state == cpu_Done || state == cpu_Crashed || state == cpu_Sleeping) {
        die("the firmware has ended");
    }
}

// Runs a function from its first instruction until it has returned, and gives
// its cycles. `stack` becomes its bytes of the stack, with the return address,
// if they are more.
static inline unsigned long run_function(unsigned *stack)
{
    const avr_cycle_count_t start = chip->cycle;
    const unsigned called = stack_pointer() + 2u;

    while (stack_pointer() < called) {
        if (called - stack_pointer() > *stack) {
            *stack = called - stack_pointer();
        }
        run_one();
    }
    return (unsigned long)(chip->cycle - start);
}

#endif
