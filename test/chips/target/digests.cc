// SPDX-License-Identifier: MIT
// A controller's arithmetic on a chip against the host's, row by row:
//
//   digests FIRMWARE.cod CONTROLLER [STRIDE [short]]
//
// with a firmware of the controller's arith_CONTROLLER.c; every STRIDEth row,
// and the last, and then, unless short, those that take longer, of which a
// STRIDE above 1 leaves the last. It ends where five differ, and prints how
// many did, and unless short the first result of the first such row that does,
// with its expression and operands.
// Exit status: 0 no digest differs, 1 some do, 2 the run could not be made.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "chip.hh"

extern "C" {
#include "arith.h"
}

namespace
{

// Far more than any takes, and than any of those that take longer.
constexpr uint64_t cycles_of_a_row = 20000000;
constexpr uint64_t cycles_of_a_long_row = 1000000000;
constexpr unsigned different_most = 5; // it ends

struct Arithmetic {
    std::string controller;
    void (*digest)();
    unsigned rows;
    std::vector<unsigned> also; // rows beyond, which take longer
};

const std::vector<Arithmetic> all = {
    {"an937", an937_arith, 256, {256 + 85, 256 + 255}},
    {"an964", an964_arith, 1024, {}},
    {"an964_8bit", an964_8bit_arith, 128, {}},
    {"pid", pid_arith, 256, {}},
};

const Arithmetic &of(const std::string &controller)
{
    for (const Arithmetic &one : all) {
        if (one.controller == controller) {
            return one;
        }
    }
    throw ChipError("no controller '" + controller + "'");
}

// The chip's turn starts when the harness has set its row, and ends with the
// digest.
class Digests
{
  public:
    Digests(const std::string &cod, unsigned ordinary_rows);
    uint32_t of_row(unsigned row);

    // The digests after each result of a row; the first one is 0.
    std::vector<uint32_t> within_row(unsigned row);

  private:
    Chip chip;
    bool watching = false;
    std::vector<uint32_t> watched;
    const unsigned rows;  // the others take longer
    bool started = false; // main has
};

Digests::Digests(const std::string &cod, unsigned ordinary_rows)
    : chip(cod), rows(ordinary_rows)
{
    if (chip.is_pic18()) {
        chip.lenient_until("main");
        chip.set_oscillator(40e6);
    }
    chip.on_execute(chip.code("main"), [this] { started = true; });
    chip.on_write(chip.data("turn"), [this](unsigned value) {
        if (started && value == 0) {
            chip.stop("the harness's turn");
        }
    });
    chip.run(cycles_of_a_row);
}

uint32_t Digests::of_row(unsigned row)
{
    chip.poke_u16(chip.data("arith_row"), static_cast<uint16_t>(row));
    chip.poke(chip.data("turn"), 1);
    chip.run(row < rows ? cycles_of_a_row : cycles_of_a_long_row);
    if (chip.stopped() != Stop::requested) {
        throw ChipError("no answer: " + chip.reason());
    }
    return chip.peek_u32(chip.data("arith_digest"));
}

std::vector<uint32_t> Digests::within_row(unsigned row)
{
    const unsigned digest = chip.data("arith_digest");

    if (watched.empty()) {
        chip.on_write(digest + 3, [this, digest](unsigned) {
            if (watching) {
                watched.push_back(chip.peek_u32(digest));
            }
        });
    }
    watched.clear();
    watching = true;
    of_row(row);
    watching = false;
    return watched;
}

std::vector<uint32_t> digests_here;

// What the results are of, without the first digest, which is 0.
std::vector<std::string> sources_here;

void keep_result()
{
    digests_here.push_back(arith_digest);
    sources_here.push_back(std::string(arith_text) + " of " +
                           std::to_string(arith_operands[0]) + " and " +
                           std::to_string(arith_operands[1]));
}

// What was added to a digest's sum, from the digests around it.
uint32_t result_at(const std::vector<uint32_t> &digests, size_t at)
{
    const uint32_t sum = digests[at] - digests[at - 1];
    const uint32_t before = at < 2 ? 0 : digests[at - 1] - digests[at - 2];

    return sum - ((before << 1) | (before >> 31));
}

void explain(Digests &digests, const Arithmetic &tested, unsigned row)
{
    digests_here = {0};
    sources_here.clear();
    arith_told = keep_result;
    tested.digest();
    arith_told = nullptr;
    const std::vector<uint32_t> there = digests.within_row(row);
    size_t at = 1;
    while (at < there.size() && at < digests_here.size() &&
           there[at] == digests_here[at]) {
        at++;
    }
    if (at < there.size() && at < digests_here.size()) {
        std::printf("row %u: result %zu of arith_%s.c, %s, is 0x%08x on the "
                    "chip, 0x%08x expected\n",
                    row, at, tested.controller.c_str(),
                    sources_here[at - 1].c_str(), result_at(there, at),
                    result_at(digests_here, at));
    } else {
        std::printf("row %u: %zu results, %zu expected\n", row,
                    there.size() - 1, digests_here.size() - 1);
    }
}

bool run(const std::string &cod, const Arithmetic &tested, unsigned stride,
         bool brief)
{
    Digests digests(cod, tested.rows);
    std::vector<unsigned> rows;
    unsigned different = 0;

    for (unsigned row = 0; row < tested.rows; row += stride) {
        rows.push_back(row);
    }
    rows.push_back(tested.rows - 1);
    if (!brief) {
        rows.insert(rows.end(),
                    stride > 1 && !tested.also.empty() ? tested.also.end() - 1
                                                       : tested.also.begin(),
                    tested.also.end());
    }
    for (const unsigned row : rows) {
        arith_row = static_cast<uint16_t>(row);
        tested.digest();
        if (digests.of_row(row) != arith_digest) {
            different++;
            std::printf("row %u: another digest\n", row);
            if (!brief && different == 1) {
                explain(digests, tested, row);
            }
        }
        if (different == different_most) {
            break;
        }
    }
    std::printf("%s digests %zu different %u\n", tested.controller.c_str(),
                rows.size(), different);
    return different == 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 3 || argc > 5) {
            throw ChipError("usage: digests FIRMWARE.cod CONTROLLER "
                            "[STRIDE [short]]");
        }
        const int stride = argc > 3 ? std::atoi(argv[3]) : 1;
        if (stride < 1) {
            throw ChipError("no such stride");
        }
        return run(argv[1], of(argv[2]), static_cast<unsigned>(stride),
                   argc > 4)
                   ? EXIT_SUCCESS
                   : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "digests: %s\n", error.what());
        return 2;
    }
}
