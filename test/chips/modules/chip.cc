// SPDX-License-Identifier: MIT
// Runs a program of main.c on a PIC in gpsim:
//
//   chip FIRMWARE.cod FUNCTION...
//
// Prints the digests like the program where it has a terminal, then a line for
// each function with the cycles of its calls.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "chip.hh"

namespace
{

constexpr uint64_t cycles_most = 2000000000; // far more than any program takes

void run(int argc, char *argv[])
{
    Chip chip(argv[1]);
    std::vector<const Meter *> meters;

    // Among them are words of the tables of rows, which are never executed.
    for (const std::string &finding : chip.lint()) {
        const auto address =
            static_cast<unsigned>(std::stoul(finding, nullptr, 16));

        chip.on_execute(address, [&chip, finding] {
            chip.fail("gpsim gets this wrong: " + finding);
        });
    }
    for (int at = 2; at < argc; at++) {
        meters.push_back(&chip.meter(argv[at]));
    }
    chip.lenient_until("main");
    chip.set_oscillator(40e6);
    chip.on_write(chip.data("done"), [&chip](unsigned value) {
        if (value == 1) {
            chip.stop("done");
        }
    });
    chip.run(cycles_most);
    if (chip.stopped() != Stop::requested ||
        chip.peek(chip.data("done")) != 1) {
        throw ChipError("no end: " + chip.reason());
    }
    std::printf(
        "rows %08x random %08x\n",
        static_cast<unsigned>(chip.peek_u32(chip.data("rows_digest"))),
        static_cast<unsigned>(chip.peek_u32(chip.data("random_digest"))));
    for (const Meter *meter : meters) {
        std::printf("%s calls %llu least %llu most %llu total %llu\n",
                    meter->name.c_str(),
                    static_cast<unsigned long long>(meter->calls),
                    static_cast<unsigned long long>(meter->least),
                    static_cast<unsigned long long>(meter->most),
                    static_cast<unsigned long long>(meter->total));
    }
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 2) {
            throw ChipError("usage: chip FIRMWARE.cod FUNCTION...");
        }
        run(argc, argv);
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "chip: %s\n", error.what());
        return 2;
    }
}
