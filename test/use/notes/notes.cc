// SPDX-License-Identifier: MIT
// Runs one of the programs here on its simulated chip, with the measurements of
// one experiment, and prints a line for each output that it takes:
//
//   notes FIRMWARE.cod motor
//   notes FIRMWARE.cod pendulum ANGLE_MOST GAIN_MOST
//
// The pendulum's angles are within +-ANGLE_MOST counts of upright and its gains
// within GAIN_MOST. The programs do not know of it: where they measure, they
// find their variables set, and where they drive, their outputs are read.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "chip.hh"

namespace
{

constexpr unsigned ticks_most = 400;
constexpr uint64_t cycles_most = 10000 * (ticks_most + 10);

// Numbers that look random, the same ones for each program.
class Numbers
{
  public:
    unsigned below(unsigned most)
    {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % most;
    }

  private:
    uint32_t state = 937;
};

// The note's numbers have their most significant byte first.
void put_high_first(Chip &chip, const std::string &name, unsigned value)
{
    chip.poke(chip.data(name + "0"), value >> 8);
    chip.poke(chip.data(name + "1"), value & 0xFF);
}

int32_t output_of_the_note(const Chip &chip)
{
    int32_t magnitude = 0;

    for (const char *byte : {"pid_out0", "pid_out1", "pid_out2"}) {
        magnitude =
            (magnitude << 8) | static_cast<int32_t>(chip.peek(chip.data(byte)));
    }
    return (chip.peek(chip.data("pid_stat1")) & 0x80) != 0 ? magnitude
                                                           : -magnitude;
}

// The interrupt and the loop are not in step, and the programs not as fast as
// each other. So a measurement changes between two ticks, three steps after the
// first, and each is looked at when it has reached the output.
void motor(Chip &chip)
{
    const bool note = chip.has_symbol("measured0");
    unsigned ticks = 0, steps = 0, measured = 2000;
    Numbers numbers;

    chip.on_execute(8, [&] {
        if (ticks != 0 && steps < 6) {
            chip.fail("fewer than 6 steps between two ticks");
        }
        ticks++;
        steps = 0;
    });
    chip.on_execute(chip.code("measure"), [&] {
        if (note) {
            put_high_first(chip, "measured", measured);
        } else {
            chip.poke_u16(chip.data("measured"),
                          static_cast<uint16_t>(measured));
        }
    });
    chip.on_execute(chip.code("drive"), [&] {
        steps++;
        if (steps != 3 && steps != 6) {
            return;
        }
        std::printf("tick %u measured %u output %d status %02x\n", ticks,
                    measured,
                    note ? output_of_the_note(chip)
                         : chip.peek_s32(chip.data("pid_out")),
                    chip.peek(chip.data("pid_stat1")) & 0xDF); // without mag
        if (steps == 3) {
            // Near the setpoint and at it, and sometimes far away.
            const unsigned far = numbers.below(4) == 0 ? 4001 : 41;

            measured = 2000 - far / 2 + numbers.below(far);
        } else if (ticks == ticks_most) {
            chip.stop("done");
        }
    });
    chip.run(cycles_most);
}

void pendulum(Chip &chip, unsigned angle_most, unsigned gain_most)
{
    unsigned steps = 0, gains[3] = {0, 0, 0};
    int angle = 0;
    Numbers numbers;

    chip.on_execute(chip.code("measure"), [&] {
        unsigned which = 0;

        angle = static_cast<int>(numbers.below(2 * angle_most + 1)) -
                static_cast<int>(angle_most);
        if (steps % 20 == 0) { // somebody turns the potentiometers
            for (unsigned &gain : gains) {
                gain = numbers.below(gain_most + 1);
            }
        }
        for (const char *name : {"kp", "ki", "kd"}) {
            chip.poke_u16(chip.data(name),
                          static_cast<uint16_t>(gains[which++]));
        }
        chip.poke_u16(chip.data("angle"), static_cast<uint16_t>(512 + angle));
    });
    chip.on_execute(chip.code("drive"), [&] {
        std::printf("step %u error %d gains %u %u %u output %d\n", ++steps,
                    angle, gains[0], gains[1], gains[2],
                    chip.peek_s16(chip.data("pwm")));
        if (steps == ticks_most) {
            chip.stop("done");
        }
    });
    chip.run(cycles_most);
}

void run(int argc, char *argv[])
{
    const std::string what = argc > 2 ? argv[2] : "";

    if (!(what == "motor" && argc == 3) && !(what == "pendulum" && argc == 5)) {
        throw ChipError("usage: notes FIRMWARE.cod motor | pendulum "
                        "ANGLE_MOST GAIN_MOST");
    }
    Chip chip(argv[1]);
    if (chip.is_pic18()) {
        chip.lenient_until("main");
        motor(chip);
    } else {
        pendulum(chip, static_cast<unsigned>(std::atoi(argv[3])),
                 static_cast<unsigned>(std::atoi(argv[4])));
    }
    if (chip.stopped() != Stop::requested) {
        throw ChipError("no end: " + chip.reason());
    }
    const std::string messages = chip.messages();
    if (!messages.empty()) {
        throw ChipError("gpsim: " + messages);
    }
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        run(argc, argv);
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "notes: %s\n", error.what());
        return 2;
    }
}
