// SPDX-License-Identifier: MIT
// The firmware of examples/watched, with a program of a PC at its UART: see
// test/support/link_session.h.
//
//   link FIRMWARE CLEAN NOISY AGAIN [FLIP]
//
// the .cod of a PIC18 or the .elf of an ATmega328P, which the linker has chosen
// the simulator for, and the steps of each part. Before step FLIP the lowest
// bit of the controller's integral is another. Exit status: 0 all is as it
// should be, 1 something is not, 2 the run could not be made.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "chip.hh"

extern "C" {
#include "link_session.h"
}

namespace
{

constexpr unsigned bits = 11; // of a byte, and simavr 1.6 has one more
constexpr unsigned setpoint_apart = 997; // steps from one set point to the next
constexpr uint64_t burst = 20000;        // cycles

// Where a chip has what.
struct Places {
    const char *setpoint;
    const char *tachometer;
    unsigned duty; // CCPR1L, OCR1AL
    unsigned direction;
    double clock;
    unsigned cycles_a_bit;
};
constexpr Places pic18 = {"porta0", "porta1", 0xFBE, 0xF8B, 40e6, 40};
constexpr Places avr = {"adc0", "adc1", 0x88, 0x25, 16e6, 64};

class Bench
{
  public:
    Bench(const std::string &firmware, link_session &session,
          unsigned long flip);
    void run();

  private:
    int drive() const;
    void step();
    void send();
    void edge();

    Chip chip;
    const Places &at;
    link_session &session;
    unsigned setpoint;
    unsigned tachometer;
    unsigned long flip;
    double speed = 0;
    unsigned noise = 0xACE1;
    uint64_t last_edge = 0;
    uint64_t shortest = UINT64_MAX; // cycles from edge to edge of TX
};

Bench::Bench(const std::string &firmware, link_session &of, unsigned long when)
    : chip(firmware), at(chip.is_pic18() ? pic18 : avr), session(of),
      setpoint(chip.analog_input(at.setpoint)),
      tachometer(chip.analog_input(at.tachometer)), flip(when)
{
    chip.set_oscillator(at.clock);
    if (chip.is_pic18()) {
        chip.lenient_until("main"); // SDCC's start-up clears all that could be
        chip.on_edge(chip.probe("portc6"), [this](unsigned) { edge(); });
    }
    chip.on_send(
        [this](unsigned byte) { link_session_take(&session, (uint8_t)byte); });
    chip.on_execute(chip.code("port_wait_ticks"), [this] { step(); });
    chip.every(at.cycles_a_bit * bits, [this] { send(); });
}

// Of the UART's output: no bit is shorter than it should be.
void Bench::edge()
{
    shortest = std::min(shortest, chip.cycle() - last_edge);
    last_edge = chip.cycle();
}

int Bench::drive() const
{
    if (!chip.is_pic18()) {
        const int counts = 1023 - chip.peek_u16(at.duty);
        return (chip.peek(at.direction) & 1) != 0 ? -counts : counts;
    }
    const int counts =
        (int)(chip.peek(at.duty) << 2 | (chip.peek(at.duty - 1) >> 4 & 3u));
    return (chip.peek(at.direction) & 1) != 0 ? -counts : counts;
}

// A motor that turns forward: a lag of 40 steps, and a sensor with noise.
void Bench::step()
{
    const unsigned long now = session.steps;

    speed += (std::max(drive(), 0) * 0.9 - speed) / 40.0;
    noise = (noise >> 1) ^ ((noise & 1u) != 0 ? 0xB400u : 0u);
    chip.set_code(tachometer, std::min(1023u, (unsigned)speed + (noise & 7u)));
    chip.set_code(setpoint,
                  200u + 100u * (unsigned)(now / setpoint_apart % 5u));
    if (now == flip) {
        const unsigned integral = chip.data("motor");
        chip.poke(integral, chip.peek(integral) ^ 1u);
    }
    link_session_step(&session);
}

void Bench::send()
{
    uint8_t byte;

    if (link_session_give(&session, &byte)) {
        chip.receive(byte, at.cycles_a_bit);
    }
}

void Bench::run()
{
    while (!link_session_over(&session)) {
        chip.run(burst);
        if (chip.stopped() == Stop::fault &&
            chip.reason() != "restarted at the reset vector") {
            throw ChipError("the chip does not run on: " + chip.reason());
        }
    }
    if (shortest != UINT64_MAX) {
        std::printf("link wire: %lu cycles a bit\n", (unsigned long)shortest);
        session.wrong += shortest == at.cycles_a_bit ? 0 : 1;
    }
}

unsigned long number(const char *word)
{
    return std::strtoul(word, nullptr, 10);
}

} // namespace

int main(int argc, char *argv[])
{
    static link_session session;

    try {
        if (argc != 5 && argc != 6) {
            throw ChipError("usage: link FIRMWARE CLEAN NOISY AGAIN [FLIP]");
        }
        link_session_init(&session, 0, number(argv[2]), number(argv[3]),
                          number(argv[4]));
        Bench bench(argv[1], session, argc == 6 ? number(argv[5]) : 0);
        bench.run();
        return link_session_good(&session, stdout) ? EXIT_SUCCESS
                                                   : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
