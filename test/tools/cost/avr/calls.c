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
#include "chip.h"

#define FUNCTIONS 2
#define CYCLES_MAX UINT64_C(4000000000) // far more than any program takes

struct function {
    const char *name;
    unsigned address;
    unsigned long calls, least, most, total;
    unsigned stack;
};

static void meter(struct function *function)
{
    const unsigned long cost = run_function(&function->stack);

    if (function->calls == 0u || cost < function->least) {
        function->least = cost;
    }
    if (cost > function->most) {
        function->most = cost;
    }
    function->calls++;
    function->total += cost;
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
