// SPDX-License-Identifier: MIT
// What an example's firmware takes of its chip, with inputs that change at each
// tick:
//
//   firmware FIRMWARE.cod CONTROLLER TICKS
//
// Prints one line of figures; all in cycles, without interrupts. A pass is the
// loop's way from taking the ticks to taking them again.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "chip.hh"

namespace
{

constexpr unsigned poison = 0xA5;
constexpr unsigned wreg = 0xFE8; // of a PIC18
constexpr uint64_t tick_most =
    50000; // cycles; more than start-up and a tick have

class Firmware
{
  public:
    Firmware(const std::string &cod, const std::string &controller);
    void run(uint64_t count);

  private:
    void new_inputs();
    unsigned any_code();
    void ticks_taken();
    void ticks_wanted();
    unsigned software_stack() const;
    void poison_stack();

    Chip chip;
    unsigned vector;
    std::vector<unsigned> inputs;
    uint32_t state = 1;
    uint64_t ticks = 0;
    bool passing = false, with_tick = false;
    uint64_t start = 0, interrupted = 0;
    uint64_t tick_pass = 0, idle_pass = 0;
    Meter *interrupt, *step, *taken;
};

Firmware::Firmware(const std::string &cod, const std::string &controller)
    : chip(cod), vector(chip.is_pic18() ? 8 : 4)
{
    const std::vector<std::string> pins =
        chip.is_pic18()
            ? std::vector<std::string>{"porta0", "porta1", "porta2"}
            : std::vector<std::string>{"porta0", "porta2", "portc0", "portc1"};

    if (chip.is_pic18()) {
        chip.lenient_until("main");
        chip.set_oscillator(40e6);
        chip.on_execute(chip.code("main"), [this] { poison_stack(); });
    }
    for (const std::string &pin : pins) {
        inputs.push_back(chip.analog_input(pin));
    }
    interrupt = &chip.meter_interrupt(vector);
    step = &chip.meter("fixpid_" + controller + "_step");
    chip.on_execute(vector, [this] {
        ticks++;
        new_inputs();
    });
    chip.on_execute(chip.code("port_ticks"), [this] { ticks_wanted(); });
    taken = &chip.meter("port_ticks");
    taken->on_return = [this](uint64_t) { ticks_taken(); };
}

// The middle often, where a pendulum stands; and the ends.
unsigned Firmware::any_code()
{
    state = state * UINT32_C(1664525) + UINT32_C(1013904223);
    const unsigned number = state >> 16;

    switch (number % 8) {
    case 0:
        return 0;
    case 1:
        return 1023;
    case 2:
    case 3:
    case 4:
        return 512 - 128 + (number >> 3) % 256;
    default:
        return (number >> 3) % 1024;
    }
}

void Firmware::new_inputs()
{
    for (const unsigned input : inputs) {
        chip.set_code(input, any_code());
    }
}

void Firmware::ticks_wanted()
{
    if (!passing) {
        return;
    }
    passing = false;
    const uint64_t cycles =
        chip.cycle() - start - (chip.interrupt_cycles() - interrupted);
    uint64_t &most = with_tick ? tick_pass : idle_pass;
    most = std::max(most, cycles);
}

void Firmware::ticks_taken()
{
    passing = true;
    // What port_ticks returned; a PIC16's applications all wait for a tick.
    with_tick = !chip.is_pic18() || chip.peek(wreg) != 0;
    start = chip.cycle();
    interrupted = chip.interrupt_cycles();
}

void Firmware::poison_stack()
{
    // main is entered with a return address and nothing else on it.
    for (unsigned at = chip.data("stack"); at < chip.data("stack_end"); at++) {
        chip.poke(at, poison);
    }
}

// From the deepest byte that was written; 0 on a PIC16, which has none.
unsigned Firmware::software_stack() const
{
    if (!chip.is_pic18()) {
        return 0;
    }
    unsigned at = chip.data("stack");
    while (at < chip.data("stack_end") && chip.peek(at) == poison) {
        at++;
    }
    return chip.data("stack_end") - at + 1;
}

void Firmware::run(uint64_t count)
{
    while (ticks < count) {
        const uint64_t before = ticks;
        chip.run(tick_most);
        if (chip.stopped() != Stop::none || ticks == before) {
            throw ChipError(ticks == before ? "no ticks" : chip.reason());
        }
    }
    const std::string printed = chip.messages();
    if (!printed.empty()) {
        throw ChipError("gpsim: " + printed);
    }
    std::printf("%s tick %lu idle %lu interrupt %lu step %lu stack %u "
                "software %u\n",
                chip.processor().c_str(), tick_pass, idle_pass, interrupt->most,
                step->most, chip.stack_most(), software_stack());
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc != 4) {
            throw ChipError("usage: firmware FIRMWARE.cod CONTROLLER TICKS");
        }
        Firmware(argv[1], argv[2]).run(std::strtoul(argv[3], nullptr, 10));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "firmware: %s\n", error.what());
        return 2;
    }
}
