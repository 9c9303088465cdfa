// SPDX-License-Identifier: MIT
// What a step costs on an AVR in simavr, in cycles:
//
//   meter FIRMWARE.elf MCU CONTROLLER MAIN STEP TURN EXCHANGE ROW RANDOM
//         DIRECTED RUNS SEED OUTPUTS_ONLY QUESTIONS
//
// The firmware is test/chips/target/driver_main.c with the controller's driver;
// MAIN, STEP, TURN and EXCHANGE are the addresses of its symbols, in
// hexadecimal. Prints the lines of search.h and
//
//   stack 12
//
// bytes that a call takes: the return address and all that is pushed.
#include <string.h>

#include "chip.h"
#include "search.h"

#define TURN_CYCLES_MAX 200000u // far more than any takes

static const struct controller *controller;
static unsigned main_address, step_address, turn, exchange;
static unsigned stack_most;

// Until the firmware waits for a question.
static uint32_t run_turn(void)
{
    const avr_cycle_count_t start = chip->cycle;
    uint32_t cost = 0;

    chip->data[turn] = 1;
    while (chip->data[turn] != 0u) {
        if (chip->pc == step_address) {
            cost = (uint32_t)run_function(&stack_most);
        } else {
            run_one();
        }
        if (chip->cycle - start > TURN_CYCLES_MAX) {
            die("no answer");
        }
    }
    return cost;
}

static uint32_t step(const union question *question, union answer *answer)
{
    uint32_t cost;

    memcpy(&chip->data[exchange], question, controller->question_size);
    cost = run_turn();
    memcpy(answer, &chip->data[exchange], controller->answer_size);
    return cost;
}

static unsigned number(const char *text, int base)
{
    return (unsigned)strtoul(text, NULL, base);
}

int main(int argc, char *argv[])
{
    uint32_t different;

    if (argc != 15) {
        die("wrong use");
    }
    load(argv[1], argv[2]);
    controller = controller_named(argv[3]);
    if (controller == NULL) {
        die("no such controller");
    }
    main_address = number(argv[4], 16);
    step_address = number(argv[5], 16);
    turn = number(argv[6], 16) & 0xFFFFu;
    exchange = number(argv[7], 16) & 0xFFFFu;
    while (chip->pc != main_address) {
        run_one();
    }
    (void)run_turn(); // up to the first wait
    const struct search_plan plan = {controller,
                                     step,
                                     argv[8],
                                     number(argv[9], 10),
                                     number(argv[10], 10),
                                     number(argv[11], 10),
                                     number(argv[12], 10),
                                     (uint8_t)number(argv[13], 10),
                                     (uint8_t)number(argv[14], 10)};
    different = search_run(&plan);
    (void)printf("stack %u\n", stack_most);
    return different == 0u ? 0 : 1;
}
