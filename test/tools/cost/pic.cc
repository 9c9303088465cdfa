// SPDX-License-Identifier: MIT
// What a step costs on a PIC in gpsim, in instruction cycles:
//
//   pic FIRMWARE.cod CONTROLLER STEP ROW RANDOM DIRECTED RUNS SEED
//       OUTPUTS_ONLY QUESTIONS
//
// The firmware is test/chips/target/driver_main.c with the controller's driver.
// Prints the lines of search.h and
//
//   stack 6
//
// bytes of the software stack of a PIC18 that the step takes, its arguments
// not counted.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "driver.hh"

extern "C" {
#include "search.h"
}

namespace
{

// Not the byte that all RAM begins with: the step saves what it finds.
constexpr unsigned poison = 0x5A;
constexpr unsigned stack_pointer = 0xFE1; // FSR1 of a PIC18
constexpr unsigned watched_calls = 2000;  // the rows

class Steps
{
  public:
    Steps(const std::string &cod, const controller &which,
          const std::string &name);

    uint32_t cost_of(const question &asked, answer &given);

    unsigned stack_most = 0;

  private:
    void poison_stack();
    void measure_stack();

    Driver driver;
    Meter &step;
};

Steps::Steps(const std::string &cod, const controller &which,
             const std::string &name)
    : driver(cod, which), step(driver.chip.meter(name))
{
    if (driver.chip.is_pic18()) {
        step.on_call = [this] { poison_stack(); };
        step.on_return = [this](uint64_t) { measure_stack(); };
    }
    driver.poison_ram();
    driver.run_turn(); // up to the first wait
}

uint32_t Steps::cost_of(const question &asked, answer &given)
{
    const uint64_t before = step.calls;

    driver.put(asked);
    driver.run_turn();
    given = driver.get();
    return step.calls == before ? 0 : static_cast<uint32_t>(step.last);
}

// Below the stack pointer, which points to the next free byte and falls.
void Steps::poison_stack()
{
    if (step.calls >= watched_calls) {
        return;
    }
    for (unsigned at = driver.chip.data("stack");
         at <= driver.chip.peek_u16(stack_pointer); at++) {
        driver.chip.poke(at, poison);
    }
}

void Steps::measure_stack()
{
    if (step.calls > watched_calls) {
        return;
    }
    const unsigned top = driver.chip.peek_u16(stack_pointer);
    unsigned at = driver.chip.data("stack");

    while (at <= top && driver.chip.peek(at) == poison) {
        at++;
    }
    stack_most = std::max(stack_most, top + 1 - at);
}

Steps *steps;

extern "C" uint32_t cost_of(const union question *asked, union answer *given)
{
    return steps->cost_of(*asked, *given);
}

uint32_t number(const char *text)
{
    return static_cast<uint32_t>(std::strtoul(text, nullptr, 10));
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc != 11) {
            throw ChipError("usage: pic FIRMWARE.cod CONTROLLER STEP ROW "
                            "RANDOM DIRECTED RUNS SEED OUTPUTS_ONLY QUESTIONS");
        }
        const controller &which = find_controller(argv[2]);
        Steps all(argv[1], which, argv[3]);
        steps = &all;
        const search_plan plan = {&which,
                                  cost_of,
                                  argv[4],
                                  number(argv[5]),
                                  number(argv[6]),
                                  number(argv[7]),
                                  number(argv[8]),
                                  static_cast<uint8_t>(number(argv[9])),
                                  static_cast<uint8_t>(number(argv[10]))};
        const uint32_t different = search_run(&plan);
        std::printf("stack %u\n", all.stack_most);
        return different == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pic: %s\n", error.what());
        return 2;
    }
}
