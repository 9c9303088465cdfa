// SPDX-License-Identifier: MIT
// What a function of any firmware for a PIC costs in gpsim:
//
//   function FIRMWARE.cod FUNCTION CYCLES [VECTOR]...
//
// Runs the firmware for so many cycles, with nothing on its pins, and prints
//
//   p18f4520 calls 12 least 690 most 738 total 8436 levels 5
//
// in instruction cycles: the call not counted, the return counted, interrupts
// through these vectors (hexadecimal) that came in between not counted; and the
// most levels of the return stack that the firmware used.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "chip.hh"

namespace
{

void run(const std::string &cod, const std::string &name, uint64_t cycles,
         const std::vector<std::string> &vectors)
{
    Chip chip(cod);
    Meter &function = chip.meter(name);

    if (chip.is_pic18()) {
        chip.lenient_until("main");
    }
    for (const std::string &vector : vectors) {
        (void)chip.meter_interrupt(
            static_cast<unsigned>(std::stoul(vector, nullptr, 16)));
    }
    (void)chip.run(cycles);
    if (chip.stopped() == Stop::fault) {
        throw ChipError(chip.reason());
    }
    std::printf("%s calls %lu least %lu most %lu total %lu levels %u\n",
                chip.processor().c_str(), function.calls,
                function.calls == 0 ? 0 : function.least, function.most,
                function.total, chip.stack_most());
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 4) {
            throw ChipError(
                "usage: function FIRMWARE.cod FUNCTION CYCLES [VECTOR]...");
        }
        run(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10),
            {argv + 4, argv + argc});
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
