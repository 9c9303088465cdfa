// SPDX-License-Identifier: MIT
// Every recorded row, then random steps, through a driver's firmware:
//
//   replay FIRMWARE.cod CONTROLLER STEPS SEED RECORDING.csv...
//
// Before each random step a bit that AN937 has beside a sign flips, which must
// make no difference. Prints one line of figures. Exit status: 0 no answer
// differs, 1 some do, 2 the run could not be made.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "driver.hh"

extern "C" {
#include "vectors.h"
}

namespace
{

// Where AN937's object has the signs of its numbers.
constexpr unsigned signs[] = {2, 6, 10};

// A row and what makes a question of it.
struct Row {
    const recording *from;
    std::vector<int32_t> columns;
};

// All rows of a controller's recordings, whose files are in their order.
std::vector<Row> rows_of(const controller &which,
                         const std::vector<std::string> &paths)
{
    std::vector<Row> rows;
    const recording *from = which.recordings;

    for (const std::string &path : paths) {
        if (from->name == nullptr) {
            throw ChipError(path + " is no recording of it");
        }
        const size_t before = rows.size();
        std::vector<int32_t> row(VECTORS_COLUMNS_MAX);
        vectors_open_file(path.c_str());
        while (vectors_next(row.data())) {
            rows.push_back({from, row});
        }
        if (rows.size() - before != from->rows) {
            throw ChipError(path + " has not " + std::to_string(from->rows) +
                            " rows");
        }
        from++;
    }
    if (from->name != nullptr) {
        throw ChipError(std::string(from->name) + " is missing");
    }
    return rows;
}

struct Result {
    unsigned long asked = 0;
    unsigned long different = 0;
};

class Replay
{
  public:
    Replay(const std::string &cod, const controller &which,
           const std::vector<std::string> &paths, unsigned long steps)
        : tested(which), rows(rows_of(which, paths)), random_steps(steps),
          driver(cod, which)
    {
        driver.poison_ram();
        driver.ask = [this](question &asked) { return ask(asked); };
        driver.judge = [this](const answer &given) { judge(given); };
    }

    Result recorded, random;

    // The figures of one pass over all questions with one seed.
    bool run(unsigned seed);

  private:
    bool ask(question &asked);
    void flip_beside_sign();
    void judge(const answer &given);

    const controller &tested;
    const std::vector<Row> rows;
    const unsigned long random_steps;
    Driver driver;
    answer expected;
};

bool Replay::ask(question &asked)
{
    if (recorded.asked < rows.size()) {
        const Row &row = rows[recorded.asked];
        row.from->row(row.columns.data(), &asked, &expected);
        recorded.asked++;
        return true;
    }
    if (random.asked == random_steps) {
        return false;
    }
    tested.ask(&asked);
    tested.define(&asked, &expected);
    flip_beside_sign();
    random.asked++;
    return true;
}

// Each of AN937's numbers has a byte on a PIC18 of which one bit is the sign.
void Replay::flip_beside_sign()
{
    if (std::strcmp(tested.name, "an937") == 0) {
        driver.flip(signs[random.asked % 3], 2u << (random.asked / 3 % 7));
    }
}

void Replay::judge(const answer &given)
{
    const bool row = random.asked == 0;
    Result &result = row ? recorded : random;
    const std::string what =
        (row ? "row " : "random step ") + std::to_string(result.asked);

    if (!same_answer(tested, what, expected, given)) {
        result.different++;
    }
}

bool Replay::run(unsigned seed)
{
    const std::string name = std::string("fixpid_") + tested.name + "_step";
    const Meter &step = driver.chip.meter(name);
    const auto start = std::chrono::steady_clock::now();

    cases_begin(seed);
    driver.run();
    const std::chrono::duration<double> took =
        std::chrono::steady_clock::now() - start;
    const double all = static_cast<double>(recorded.asked + random.asked);
    std::printf(
        "%s %s rows %lu different %lu random %lu different %lu "
        "cycles %lu..%lu stack %u; %.0f steps/s, %.0f million cycles/s\n",
        tested.name, driver.chip.processor().c_str(), recorded.asked,
        recorded.different, random.asked, random.different, step.least,
        step.most, driver.chip.stack_most(), all / took.count(),
        static_cast<double>(driver.chip.cycle()) / 1e6 / took.count());
    return recorded.different + random.different == 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 6) {
            throw ChipError("usage: replay FIRMWARE.cod CONTROLLER STEPS SEED "
                            "RECORDING.csv...");
        }
        Replay replay(argv[1], find_controller(argv[2]),
                      {argv + 5, argv + argc},
                      std::strtoul(argv[3], nullptr, 10));
        const unsigned long seed = std::strtoul(argv[4], nullptr, 10);
        return replay.run(static_cast<unsigned>(seed)) ? EXIT_SUCCESS
                                                       : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "replay: %s\n", error.what());
        return 2;
    }
}
