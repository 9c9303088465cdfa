// SPDX-License-Identifier: MIT
// AN937's leaves on a chip against plain arithmetic:
//
//   sums FIRMWARE.cod [all]
//
// with a firmware of driver_sums.c. Every gain with each byte as both bytes of
// a magnitude, so each of the two products is seen with all its operands, and
// four gains with every magnitude; `all`: every gain with every magnitude.
// Prints one line. Exit status: 0 no digest differs, 1 some do, 2 the run could
// not be made.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "chip.hh"

namespace
{

constexpr uint64_t cycles_of_a_gain = 200000000; // far more than any takes
constexpr int64_t sum_most = 0xFFFFFF;
constexpr unsigned reported_most = 5;  // the rest is only counted
constexpr unsigned same_bytes = 0x101; // stride between such magnitudes

struct Digests {
    uint32_t digest = 0;
    uint32_t of_digests = 0;

    void add(int64_t value)
    {
        digest += static_cast<uint32_t>(value);
        of_digests += digest;
    }
    void add_sum(int64_t sum)
    {
        const int64_t limited = std::clamp(sum, -sum_most, sum_most);

        add(sum);
        add(limited / 16);
        add((sum < 0 ? 0x80 : 0) + (sum != limited ? 1 : 0));
    }
    bool operator==(const Digests &other) const
    {
        return digest == other.digest && of_digests == other.of_digests;
    }
};

Digests defined(int64_t gain, unsigned stride)
{
    Digests digests;

    for (int64_t magnitude = 0; magnitude <= 0xFFFF; magnitude += stride) {
        for (const int64_t sign : {1, -1}) {
            const int64_t product = sign * gain * magnitude;
            const int64_t opposite = -sign * gain * (0xFFFF - magnitude);

            digests.add_sum(3 * product);
            digests.add_sum(2 * product + opposite);
        }
    }
    return digests;
}

class Sums
{
  public:
    explicit Sums(const std::string &cod);
    // How many digests are not as defined: 0 or 1.
    unsigned different(unsigned gain, unsigned stride);

  private:
    Chip chip;
    bool started = false; // main has
    unsigned reported = 0;
};

Sums::Sums(const std::string &cod) : chip(cod)
{
    chip.lenient_until("main");
    chip.set_oscillator(40e6);
    chip.on_execute(chip.code("main"), [this] { started = true; });
    chip.on_write(chip.data("turn"), [this](unsigned value) {
        if (started && value == 0) {
            chip.stop("the harness's turn");
        }
    });
    chip.run(cycles_of_a_gain);
}

unsigned Sums::different(unsigned gain, unsigned stride)
{
    Digests given;

    chip.poke(chip.data("sums_gain"), gain);
    chip.poke_u16(chip.data("sums_stride"), static_cast<uint16_t>(stride));
    chip.poke(chip.data("turn"), 1);
    chip.run(cycles_of_a_gain);
    if (chip.stopped() != Stop::requested) {
        throw ChipError("no answer: " + chip.reason());
    }
    given.digest = chip.peek_u32(chip.data("sums_digest"));
    given.of_digests = chip.peek_u32(chip.data("sums_digest_of_digests"));
    if (given == defined(gain, stride)) {
        return 0;
    }
    if (reported < reported_most) {
        std::printf("gain %u, stride %u: another digest\n", gain, stride);
        reported++;
    }
    return 1;
}

bool run(const std::string &cod, bool all)
{
    Sums sums(cod);
    unsigned different = 0;

    for (unsigned gain = 0; gain <= 255; gain++) {
        different += sums.different(gain, all ? 1 : same_bytes);
    }
    for (const unsigned gain : {1, 85, 128, 255}) {
        different += all ? 0 : sums.different(gain, 1);
    }
    std::printf("sums of 256 gains: different %u\n", different);
    return different == 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 2 || (argc > 2 && std::string(argv[2]) != "all")) {
            throw ChipError("usage: sums FIRMWARE.cod [all]");
        }
        return run(argv[1], argc > 2) ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "sums: %s\n", error.what());
        return 2;
    }
}
