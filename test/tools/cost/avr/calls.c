// SPDX-License-Identifier: MIT
// What the calls of a program of test/chips/modules cost on an AVR in simavr:
//
//   calls FIRMWARE.elf MCU DONE NAME ADDRESS [NAME ADDRESS]
//
// DONE and each ADDRESS of a function are hexadecimal. Prints a line for each:
//
//   fixpid_x_step calls 3000 least 83 most 90 total 261000
//   stack of fixpid_x_step 12
//
// in cycles, and in bytes with the return address and interrupts.
#include <stdio.h>
#include <stdlib.h>

#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

#define FUNCTIONS 2
#define CYCLES_MAX UINT64_C(4000000000) // far more than any program takes

struct function {
    const char *name;
    unsigned address;
    unsigned long calls, least, most, total;
    unsigned stack;
};

static avr_t *chip;

static void die(const char *why)
{
    (void)fprintf(stderr, "calls: %s\n", why);
    exit(2);
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

// From the function's first instruction until it has returned.
static void meter(struct function *function)
{
    const avr_cycle_count_t start = chip->cycle;
    const unsigned called = stack_pointer() + 2u;
    unsigned long cost;

    while (stack_pointer() < called) {
        if (called - stack_pointer() > function->stack) {
            function->stack = called - stack_pointer();
        }
        run_one();
    }
    cost = (unsigned long)(chip->cycle - start);
    if (function->calls == 0u || cost < function->least) {
        function->least = cost;
    }
    if (cost > function->most) {
        function->most = cost;
    }
    function->calls++;
    function->total += cost;
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

// Runs on until the function that comes next has returned.
static void advance(struct function functions[], int count)
{
    for (int at = 0; at < count; at++) {
        if (chip->pc == functions[at].address) {
            meter(&functions[at]);
            return;
        }
    }
    run_one();
}

int main(int argc, char *argv[])
{
    struct function functions[FUNCTIONS] = {{0}};
    const int count = (argc - 4) / 2;
    unsigned done;

    if (argc < 6 || argc % 2 != 0 || count > FUNCTIONS) {
        die("wrong use");
    }
    load(argv[1], argv[2]);
    done = (unsigned)strtoul(argv[3], NULL, 16) & 0xFFFFu;
    for (int at = 0; at < count; at++) {
        functions[at].name = argv[4 + 2 * at];
        functions[at].address = (unsigned)strtoul(argv[5 + 2 * at], NULL, 16);
    }
    while (chip->data[done] != 1u) {
        advance(functions, count);
        if (chip->cycle > CYCLES_MAX) {
            die("no end");
        }
    }
    for (int at = 0; at < count; at++) {
        (void)printf("%s calls %lu least %lu most %lu total %lu\n",
                     functions[at].name, functions[at].calls,
                     functions[at].least, functions[at].most,
                     functions[at].total);
        (void)printf("stack of %s %u\n", functions[at].name,
                     functions[at].stack);
    }
    return 0;
}
