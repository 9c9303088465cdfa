// SPDX-License-Identifier: MIT
// Runs the parts of chip_avr.c in simavr, and writes what they left:
//
//   avr FIRMWARE.elf MCU OVER BYTES RESULTS
//
// The addresses are hexadecimal. Prints
//
//   stack 40
//
// the most bytes of the stack.
#include "chip.h"

#include "program.h"

#define CYCLES_MAX UINT64_C(4000000000) // far more than any part takes

static unsigned address(const char *text)
{
    return (unsigned)strtoul(text, NULL, 16) & 0xFFFFu;
}

int main(int argc, char *argv[])
{
    FILE *results = (argc == 6) ? fopen(argv[5], "wb") : NULL;
    unsigned top = 0;
    unsigned least = 0xFFFF;
    unsigned over;

    if (results == NULL) {
        die("wrong use");
    }
    load(argv[1], argv[2]);
    over = address(argv[3]);
    for (int number = 0; number < PROGRAM_PARTS; number++) {
        while (chip->data[over] != 1u) {
            run_one();
            if (stack_pointer() > top) {
                top = stack_pointer(); // the start-up sets it
            }
            if (stack_pointer() < least) {
                least = stack_pointer();
            }
            if (chip->cycle > CYCLES_MAX) {
                die("no end");
            }
        }
        (void)fwrite(&chip->data[address(argv[4])], 1, PROGRAM_SIZE, results);
        chip->data[over] = 0;
    }
    (void)printf("stack %u\n", top - least);
    return (fclose(results) == 0) ? 0 : 2;
}
