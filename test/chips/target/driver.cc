// SPDX-License-Identifier: MIT
#include "driver.hh"

#include <cstdio>
#include <cstring>

namespace
{

constexpr uint64_t cycles_of_an_answer = 100000; // far more than any takes
constexpr unsigned reported_most = 5;            // the rest is only counted
constexpr unsigned poison = 0xA5;

int32_t member_value(const answer &from, const member &what)
{
    const char *const at = reinterpret_cast<const char *>(&from) + what.offset;
    uint8_t byte;
    int16_t word;
    int32_t value;

    switch (what.size) {
    case 1:
        std::memcpy(&byte, at, sizeof(byte));
        return byte;
    case 2:
        std::memcpy(&word, at, sizeof(word));
        return word;
    default:
        std::memcpy(&value, at, sizeof(value));
        return value;
    }
}

} // namespace

Driver::Driver(const std::string &cod, const controller &which)
    : chip(cod), tested(which), turn(chip.data("turn")),
      exchange(chip.data(std::string(which.name) + "_exchange")),
      object(chip.data(std::string(which.name) + "_controller"))
{
    const std::vector<std::string> wrong = chip.lint();

    if (!wrong.empty()) {
        throw ChipError(cod + ": gpsim gets this wrong: " + wrong.front());
    }
    if (chip.is_pic18()) {
        chip.lenient_until("main");
        chip.set_oscillator(40e6);
    }
    // The start-up code clears the byte, too: that is not yet a turn.
    chip.on_execute(chip.code("main"), [this] { started = true; });
    chip.on_write(turn, [this](unsigned value) {
        if (started && value == 0) {
            take_turn();
        }
    });
}

// Main may begin with its loop.
void Driver::poison_ram()
{
    chip.on_execute(chip.code("main"), [this, done = false]() mutable {
        if (!done) {
            chip.fill_ram(poison);
        }
        done = true;
    });
}

void Driver::take_turn()
{
    question asked;

    if (!ask) {
        chip.stop("the harness's turn");
        return;
    }
    if (waiting) {
        judge(get());
    }
    std::memset(&asked, 0, sizeof(asked));
    if (!ask(asked)) {
        chip.stop("done");
        return;
    }
    put(asked);
    waiting = true;
}

// Whatever the start-up code cleared: init must set every member.
void Driver::poison_object()
{
    for (unsigned at = 0; at < tested.object_size; at++) {
        chip.poke(object + at, poison);
    }
}

void Driver::flip(unsigned byte, unsigned bits)
{
    chip.poke(object + byte, chip.peek(object + byte) ^ bits);
}

void Driver::put(const question &asked)
{
    const unsigned char *const bytes =
        reinterpret_cast<const unsigned char *>(&asked);

    if ((bytes[tested.calls_at] & CALL_INIT) != 0) {
        poison_object();
    }
    for (unsigned at = 0; at < tested.question_size; at++) {
        chip.poke(exchange + at, bytes[at]);
    }
    chip.poke(turn, 1);
}

answer Driver::get() const
{
    answer given;
    unsigned char *const bytes = reinterpret_cast<unsigned char *>(&given);

    std::memset(&given, 0, sizeof(given));
    for (unsigned at = 0; at < tested.answer_size; at++) {
        bytes[at] = static_cast<unsigned char>(chip.peek(exchange + at));
    }
    return given;
}

void Driver::check_end()
{
    const std::string printed = chip.messages();

    if (chip.stopped() == Stop::none) {
        throw ChipError("no answer");
    }
    if (chip.stopped() == Stop::fault) {
        throw ChipError(chip.reason());
    }
    if (!printed.empty()) {
        throw ChipError("gpsim: " + printed);
    }
}

void Driver::run()
{
    uint64_t turns = 0;
    uint64_t turns_before;
    const auto ask_next = ask;

    ask = [&](question &asked) {
        turns++;
        return ask_next(asked);
    };
    do {
        turns_before = turns;
        chip.run(cycles_of_an_answer);
    } while (chip.stopped() == Stop::none && turns != turns_before);
    ask = ask_next;
    check_end();
}

void Driver::run_turn()
{
    chip.run(cycles_of_an_answer);
    check_end();
}

bool same_answer(const controller &tested, const std::string &what,
                 const answer &expected, const answer &given)
{
    static unsigned reported = 0;

    if (std::memcmp(&expected, &given, tested.answer_size) == 0) {
        return true;
    }
    for (const member *at = tested.members; at->name != nullptr; at++) {
        const int32_t right = member_value(expected, *at);
        const int32_t wrong = member_value(given, *at);

        if (right != wrong && reported < reported_most) {
            std::printf("%s: %s: %s is %d on the chip, %d expected\n",
                        tested.name, what.c_str(), at->name,
                        static_cast<int>(wrong), static_cast<int>(right));
            reported++;
        }
    }
    return false;
}

const controller &find_controller(const std::string &name)
{
    const controller *const found = controller_named(name.c_str());

    if (found == nullptr) {
        throw ChipError("no controller '" + name + "'");
    }
    return *found;
}
