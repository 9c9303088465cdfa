// SPDX-License-Identifier: MIT
// Whether a PIC's RAM is 0 when main begins, with a start-up that build_pic
// made for a port without one:
//
//   cleared FIRMWARE.cod FIRST LAST [FIRST LAST]...
//
// Addresses are hexadecimal. The RAM is random when the chip starts.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "chip.hh"

namespace
{

unsigned address(const char *text)
{
    return static_cast<unsigned>(std::stoul(text, nullptr, 16));
}

void run(int argc, char *argv[])
{
    Chip chip(argv[1]);
    unsigned bytes = 0;

    chip.on_execute(chip.code("main"), [&chip] { chip.stop("main"); });
    chip.run(100000);
    if (chip.stopped() != Stop::requested) {
        throw ChipError("main is not reached: " + chip.reason());
    }
    for (int at = 2; at + 1 < argc; at += 2) {
        for (unsigned byte = address(argv[at]); byte <= address(argv[at + 1]);
             byte++) {
            if (chip.peek(byte) != 0) {
                throw ChipError("not cleared: " + std::to_string(byte));
            }
            bytes++;
        }
    }
    std::printf("%u bytes are 0 when main begins\n", bytes);
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 4) {
            throw ChipError("usage: cleared FIRMWARE.cod FIRST LAST...");
        }
        run(argc, argv);
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "cleared: %s\n", error.what());
        return 1;
    }
}
