// SPDX-License-Identifier: MIT
// A trace, which the model has agreed to, call by call through the autotuner on
// a chip:
//
//   chip FIRMWARE.cod TRACE.txt
//
// Prints one line of figures. Exit status: 0 no answer differs, 1 some do, 2
// the run could not be made.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <sstream>

#include "chip.hh"

extern "C" {
#include "exchange.h"
}

namespace
{

constexpr uint64_t cycles_of_an_answer = 100000; // far more than any takes
constexpr unsigned reported_most = 5;            // the rest is only counted
constexpr unsigned poison = 0xA5;
constexpr unsigned object_size = offsetof(struct fixpid_relay, averaged) + 1;

struct Call {
    std::string line;
    struct question question;
    struct answer expected;
};

// False at the end of the trace.
bool next_call(std::istream &trace, Call &call)
{
    char kind = 0;
    long at[10] = {0};
    unsigned count = 0;

    if (!std::getline(trace, call.line)) {
        return false;
    }
    std::istringstream words(call.line);
    words >> kind;
    while (count < 10 && words >> at[count]) {
        count++;
    }
    call.question = {};
    call.question.call = static_cast<uint8_t>(kind);
    switch (kind) {
    case CALL_INIT:
        call.question.config = {
            static_cast<int16_t>(at[0]),  static_cast<int16_t>(at[1]),
            static_cast<int16_t>(at[2]),  static_cast<int16_t>(at[3]),
            static_cast<int16_t>(at[4]),  static_cast<uint16_t>(at[5]),
            static_cast<uint16_t>(at[6]), static_cast<uint8_t>(at[7]),
            static_cast<uint8_t>(at[8])};
        call.expected = {};
        call.expected.accepted = static_cast<uint8_t>(at[9]);
        call.expected.status =
            at[9] != 0 ? FIXPID_RELAY_RUNNING : FIXPID_RELAY_REFUSED;
        return count == 10;
    case CALL_RESET:
        call.expected = {};
        call.expected.status = static_cast<uint8_t>(at[0]);
        return count == 1;
    case CALL_STEP:
        call.question.setpoint = static_cast<int16_t>(at[0]);
        call.question.measurement = static_cast<int16_t>(at[1]);
        call.expected = {};
        call.expected.output = static_cast<int16_t>(at[2]);
        call.expected.status = static_cast<uint8_t>(at[3]);
        return count == 4;
    case CALL_RESULT: {
        const uint8_t status = call.expected.status; // as after the last step
        call.question.rule = static_cast<uint8_t>(at[0]);
        call.expected = {static_cast<uint32_t>(at[3]),
                         static_cast<uint16_t>(at[2]),
                         static_cast<uint16_t>(at[4]),
                         0,
                         static_cast<uint8_t>(at[5]),
                         static_cast<uint8_t>(at[1]),
                         status};
        return count == 6;
    }
    default:
        throw ChipError("not a line of a trace: " + call.line);
    }
}

class Replay
{
  public:
    Replay(const std::string &cod, const std::string &path)
        : chip(cod), trace(path), exchange(chip.data("exchange")),
          turn(chip.data("turn")), object(chip.data("relay_controller"))
    {
        if (!chip.lint().empty()) {
            throw ChipError(cod +
                            ": gpsim gets this wrong: " + chip.lint().front());
        }
        chip.lenient_until("main");
        chip.set_oscillator(40e6);
        chip.on_execute(chip.code("main"), [this] { started = true; });
        chip.on_write(turn, [this](unsigned value) {
            if (started && value == 0) {
                take_turn();
            }
        });
    }

    bool run();

  private:
    void take_turn();
    void judge();

    Chip chip;
    std::ifstream trace;
    unsigned exchange, turn, object;
    Call call = {};
    bool started = false; // main has
    bool done = false;
    unsigned long asked = 0, different = 0;
};

void Replay::judge()
{
    const unsigned char *const expected =
        reinterpret_cast<const unsigned char *>(&call.expected);
    bool same = true;

    for (unsigned at = 0; at <= offsetof(struct answer, status); at++) {
        same = same && chip.peek(exchange + at) == expected[at];
    }
    if (!same) {
        different++;
        if (different <= reported_most) {
            std::printf("call %lu differs: %s\n", asked, call.line.c_str());
        }
    }
}

void Replay::take_turn()
{
    const unsigned char *const bytes =
        reinterpret_cast<const unsigned char *>(&call.question);

    if (asked != 0) {
        judge();
    }
    if (!next_call(trace, call)) {
        done = true;
        chip.stop("done");
        return;
    }
    if (call.question.call == CALL_INIT) { // which must set every member
        for (unsigned at = 0; at < object_size; at++) {
            chip.poke(object + at, poison);
        }
    }
    for (unsigned at = 0; at < sizeof call.question; at++) {
        chip.poke(exchange + at, bytes[at]);
    }
    asked++;
    chip.poke(turn, 1);
}

bool Replay::run()
{
    const Meter &step = chip.meter("fixpid_relay_step");
    const Meter &result = chip.meter("fixpid_relay_result");
    unsigned long before;

    do {
        before = asked;
        chip.run(cycles_of_an_answer);
    } while (chip.stopped() == Stop::none && asked != before);
    if (!done) {
        throw ChipError(chip.stopped() == Stop::none ? "no answer"
                                                     : chip.reason());
    }
    const std::string printed = chip.messages();
    if (!printed.empty()) {
        throw ChipError("gpsim: " + printed);
    }
    std::printf("autotune %s calls %lu different %lu step cycles %lu..%lu "
                "result cycles %lu..%lu stack %u\n",
                chip.processor().c_str(), asked, different, step.least,
                step.most, result.least, result.most, chip.stack_most());
    return different == 0 && asked != 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc != 3) {
            throw ChipError("usage: chip FIRMWARE.cod TRACE.txt");
        }
        Replay replay(argv[1], argv[2]);
        return replay.run() ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "chip: %s\n", error.what());
        return 2;
    }
}
