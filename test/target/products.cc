// SPDX-License-Identifier: MIT
// Runs a firmware that compares products by itself, driver_products.c:
//
//   products FIRMWARE.cod
//
// Exit status: 0 none differs, 1 some do, 2 the run could not be made.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "chip.hh"

namespace
{

constexpr uint64_t cycles_most = 1000000000; // far more than it takes

void run(Chip &chip)
{
    chip.on_write(chip.data("finished"), [&chip](unsigned value) {
        if (value == 1) {
            chip.stop("finished");
        }
    });
    chip.run(cycles_most);
    if (chip.stopped() != Stop::requested) {
        throw ChipError("not finished: " + chip.reason());
    }
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc != 2) {
            throw ChipError("usage: products FIRMWARE.cod");
        }
        Chip chip(argv[1]);
        run(chip);
        const unsigned long compared = chip.peek_u32(chip.data("compared"));
        const unsigned different = chip.peek_u16(chip.data("different"));
        std::printf("%s compared %lu different %u\n", chip.processor().c_str(),
                    compared, different);
        return compared != 0 && different == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "products: %s\n", error.what());
        return 2;
    }
}
