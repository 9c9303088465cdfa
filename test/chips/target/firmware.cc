// SPDX-License-Identifier: MIT
// What an example's firmware takes of its chip, with inputs that change at each
// tick:
//
//   firmware FIRMWARE CONTROLLER TICKS
//
// with the .cod of a PIC or the .elf of an AVR; the linker chooses the
// simulator. Prints one line of figures; all in cycles, without interrupts. A
// pass is the loop's way from taking the ticks to taking them again. On a
// PIC16F684, where the firmware is compiled as one file, each drive must be
// what the controller's definition answers to the potentiometers and the error.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "driver.hh"

namespace
{

constexpr unsigned poison = 0xA5;
constexpr unsigned wreg = 0xFE8;                  // of a PIC18
constexpr unsigned r24 = 24;                      // of an AVR
constexpr unsigned ccpr1l = 0x13, ccp1con = 0x15; // of a PIC16
constexpr int full = 256, least = 4;              // PORT_DRIVE_FULL, _LEAST
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
    void watch_drives(const controller &tested);
    void define_drive(const controller &tested);
    void check_drive();

    Chip chip;
    bool avr, pic16;
    unsigned vector;
    std::vector<unsigned> inputs;
    uint32_t state = 1;
    uint64_t ticks = 0;
    bool passing = false, with_tick = false;
    uint64_t start = 0, interrupted = 0;
    uint64_t tick_pass = 0, idle_pass = 0;
    Meter *interrupt, *step, *taken;

    std::vector<unsigned> codes; // of the inputs
    uint8_t calls = CALL_INIT;   // since the last step
    int drive = 0;
    uint64_t drives = 0, different = 0;
};

Firmware::Firmware(const std::string &cod, const std::string &controller)
    : chip(cod), avr(chip.processor() == "atmega328p"),
      pic16(!avr && !chip.is_pic18()), vector(avr ? 14 * 4 : (pic16 ? 4 : 8))
{
    std::vector<std::string> pins = {"porta0", "porta1", "porta2"};

    if (avr) {
        pins = {"adc0", "adc1", "adc2"};
    } else if (pic16) {
        pins = {"porta0", "porta2", "portc0", "portc1"};
    }
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
    for (const char *const name : {"port_ticks", "port_wait_tick"}) {
        if (chip.has_symbol(name)) { // an AVR's firmware has what it calls
            chip.on_execute(chip.code(name), [this] { ticks_wanted(); });
        }
    }
    taken = &chip.meter("port_ticks");
    taken->on_return = [this](uint64_t) { ticks_taken(); };
    if (pic16) {
        watch_drives(find_controller(controller));
    }
}

void Firmware::watch_drives(const struct controller &tested)
{
    chip.meter("fixpid_" + std::string(tested.name) + "_reset").on_call =
        [this] { calls |= CALL_RESET; };
    step->on_call = [this, &tested] { define_drive(tested); };
    chip.on_execute(chip.code("port_drive"), [this] { drives++; });
}

// The error is the step's last argument; the first is the controller's address.
void Firmware::define_drive(const controller &tested)
{
    question asked = {};
    answer defined = {};

    if (std::string(tested.name) == "an964") {
        asked.an964.gains = {static_cast<uint16_t>(codes[1]),
                             static_cast<uint16_t>(codes[2]),
                             static_cast<uint16_t>(codes[3])};
        asked.an964.error =
            static_cast<int16_t>((chip.peek(chip.data("STK01")) << 8) |
                                 chip.peek(chip.data("STK02")));
        asked.an964.calls = calls | CALL_SET_GAINS;
    } else {
        asked.an964_8bit.gains = {static_cast<uint8_t>(codes[1] >> 3),
                                  static_cast<uint8_t>(codes[2] >> 3),
                                  static_cast<uint8_t>(codes[3] >> 3)};
        asked.an964_8bit.error =
            static_cast<int8_t>(chip.peek(chip.data("STK01")));
        asked.an964_8bit.calls = calls | CALL_SET_GAINS;
    }
    calls = 0;
    tested.define(&asked, &defined);
    drive = defined.an964.output;
}

// At the end of a pass: a drive that was not a step's is 0.
void Firmware::check_drive()
{
    const int magnitude = std::min(std::abs(drive), full);
    const int made = magnitude < least ? 0 : magnitude;
    const unsigned control = chip.peek(ccp1con);
    const int counts =
        static_cast<int>((chip.peek(ccpr1l) << 2) | ((control >> 4) & 3u));

    if (counts != made ||
        (made != 0 && ((control & 0x80) != 0) != (drive < 0))) {
        different++;
    }
    drive = 0;
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
    codes.clear();
    for (const unsigned input : inputs) {
        codes.push_back(any_code());
        chip.set_code(input, codes.back());
    }
}

void Firmware::ticks_wanted()
{
    if (!passing) {
        return;
    }
    passing = false;
    if (pic16) {
        check_drive();
    }
    const uint64_t cycles =
        chip.cycle() - start - (chip.interrupt_cycles() - interrupted);
    uint64_t &most = with_tick ? tick_pass : idle_pass;
    most = std::max(most, cycles);
}

void Firmware::ticks_taken()
{
    passing = true;
    // What port_ticks returned; a PIC16's applications all wait for a tick.
    with_tick = pic16 || chip.peek(avr ? r24 : wreg) != 0;
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

// From the deepest byte that was written; 0 where there is only one stack.
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
        throw ChipError("the simulator: " + printed);
    }
    if (pic16) {
        std::printf("drives %lu different %lu\n", drives, different);
    }
    if (different != 0 || (drives == 0 && pic16)) {
        throw ChipError("wrong drives");
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
            throw ChipError("usage: firmware FIRMWARE CONTROLLER TICKS");
        }
        Firmware(argv[1], argv[2]).run(std::strtoul(argv[3], nullptr, 10));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "firmware: %s\n", error.what());
        return 2;
    }
}
