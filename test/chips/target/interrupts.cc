// SPDX-License-Identifier: MIT
// The tick's interrupt forced before every instruction of a turn of
// driver_tick.c: of taking the ticks, of every call and of the step.
//
//   interrupts FIRMWARE CONTROLLER
//
// No tick may be lost or told twice, and no answer may change: for the first
// two questions of ten random sequences, or up to the first that is wrong. With
// a third argument, `ticking`, the interrupt is one that calls
// fixpid_an937_tick itself: the step that it interrupts, or else the next one,
// uses it. So it is with a second tick, which comes while the first one waits
// or is used; a step that uses the first takes it at once, so that the second
// is the next step's. Exit status: 0 all is well, 1 it is not, 2 the run could
// not be made.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "driver.hh"

namespace
{

constexpr uint64_t turn_most = 20000; // cycles; far more than a turn has
constexpr uint32_t seeds = 10;
constexpr uint64_t taken_most = 12;    // instructions from a look to the taking
constexpr uint64_t quiet_cycles = 500; // in which an interrupt ends

struct Registers {
    unsigned vector;
    std::vector<std::pair<unsigned, unsigned>> flags;   // register, bit
    std::vector<std::pair<unsigned, unsigned>> quieten; // register, value
};

// TMR0IF, TMR1IF or CCP2IF, whichever the firmware enabled; OCF0A of an AVR.
// Quiet: the chip's own tick does not come; its timer is started again, or
// stopped on a PIC18 and an AVR.
const Registers pic16 = {
    4, {{0x0B, 0x04}, {0x0C, 0x01}}, {{0x01, 0x20}, {0x0F, 0x00}}};
const Registers pic18 = {8, {{0xFF2, 0x04}, {0xFA1, 0x01}}, {{0xFCD, 0x80}}};
const Registers avr = {14 * 4, {{0x35, 0x02}}, {{0x45, 0x00}}};

const Registers &registers_of(const Chip &chip)
{
    if (chip.processor().rfind("atmega", 0) == 0) {
        return avr;
    }
    return chip.is_pic18() ? pic18 : pic16;
}

class Interrupts
{
  public:
    Interrupts(const std::string &cod, const controller &which);
    // True if nothing was lost or changed.
    bool run();
    // True if each tick was used once, by its own step or by the next.
    bool run_ticking();

  private:
    void quieten();
    void force();
    void before_instruction();
    void turn(const question &asked);
    bool turn_is_right(const question &asked, const answer &expected);
    void force_at(uint64_t where);
    void run_seed(uint32_t seed);
    bool report() const;
    void define_ticking(uint8_t ticks, uint8_t ticks_after);
    bool is(const answer &given, const answer &expected) const;
    bool are(uint8_t ticks, uint8_t ticks_after) const;
    uint64_t force_ticking_at(const std::vector<uint64_t> &where);
    uint64_t force_ticking(const std::vector<uint64_t> &before);
    void run_ticking_seed(uint32_t seed);

    const controller &tested;
    Driver driver;
    const Registers &registers;
    unsigned ticks_told;
    question first, second;
    answer first_expected, second_expected;
    uint64_t instruction = 0;      // of this turn
    std::vector<uint64_t> targets; // when the interrupt is forced
    uint64_t entered = 0;          // interrupts, so far
    uint64_t told = 0;             // ticks, so far
    uint64_t points = 0, lost = 0, changed = 0;

    // For run_ticking: the definition's answers to the first question and the
    // second, by the ticks before each.
    question start;
    struct Answers {
        answer first, second;
    } defined[3][2];
    Answers given;
    uint64_t step_at = 0; // its first instruction, of this turn
    uint64_t used_now = 0, used_later = 0, used_second = 0;
};

Interrupts::Interrupts(const std::string &cod, const controller &which)
    : tested(which), driver(cod, which), registers(registers_of(driver.chip)),
      ticks_told(driver.chip.data("ticks_told"))
{
    for (const unsigned address : driver.chip.instructions()) {
        driver.chip.on_execute(address, [this] { before_instruction(); });
    }
    driver.chip.on_execute(registers.vector, [this] { entered++; });
}

void Interrupts::quieten()
{
    for (const auto &[address, value] : registers.quieten) {
        driver.chip.write(address, value);
    }
}

void Interrupts::force()
{
    for (const auto &[address, bit] : registers.flags) {
        driver.chip.write(address, driver.chip.peek(address) | bit);
    }
}

void Interrupts::before_instruction()
{
    if (std::find(targets.begin(), targets.end(), instruction) !=
        targets.end()) {
        force();
    }
    instruction++;
}

void Interrupts::turn(const question &asked)
{
    quieten();
    instruction = 0;
    driver.put(asked);
    driver.run_turn();
    told += driver.chip.peek(ticks_told);
}

bool Interrupts::turn_is_right(const question &asked, const answer &expected)
{
    const std::string what =
        targets.empty()
            ? "the turn after an interrupt"
            : "interrupt before instruction " + std::to_string(targets.front());

    turn(asked);
    return same_answer(tested, what, expected, driver.get());
}

// One turn with an interrupt and one without: by then its tick was told.
void Interrupts::force_at(uint64_t where)
{
    const uint64_t owed = entered - told;
    bool good;

    targets = {where};
    good = turn_is_right(first, first_expected);
    targets.clear();
    driver.chip.run(quiet_cycles); // in the loop that waits for a turn
    good &= turn_is_right(second, second_expected);
    points++;
    changed += good ? 0 : 1;
    lost += entered - told == owed ? 0 : 1;
}

bool Interrupts::report() const
{
    std::printf("%s %s interrupts %lu lost %lu changed %lu\n", tested.name,
                driver.chip.processor().c_str(), points, lost, changed);
    if (entered != points) {
        std::printf("%lu interrupts were forced and %lu were taken\n", points,
                    entered);
    }
    return lost + changed == 0 && entered == points;
}

void Interrupts::run_seed(uint32_t seed)
{
    cases_begin(seed);
    tested.ask(&first);
    tested.define(&first, &first_expected);
    tested.ask(&second);
    tested.define(&second, &second_expected);
    turn(first);
    const uint64_t instructions = instruction;
    for (uint64_t where = 0; where < instructions; where++) {
        force_at(where);
    }
}

bool Interrupts::run()
{
    driver.run_turn(); // up to the first wait
    for (uint32_t seed = 1; seed <= seeds && lost + changed == 0; seed++) {
        run_seed(seed);
    }
    return report();
}

void Interrupts::define_ticking(uint8_t ticks, uint8_t ticks_after)
{
    Answers &answers = defined[ticks][ticks_after];
    answer ignored;
    question with = first;

    tested.define(&start, &ignored);
    with.an937.ticks = ticks;
    tested.define(&with, &answers.first);
    with = second;
    with.an937.ticks = ticks_after;
    tested.define(&with, &answers.second);
}

bool Interrupts::is(const answer &one, const answer &expected) const
{
    return std::memcmp(&one, &expected, tested.answer_size) == 0;
}

bool Interrupts::are(uint8_t ticks, uint8_t ticks_after) const
{
    const Answers &answers = defined[ticks][ticks_after];

    return is(given.first, answers.first) && is(given.second, answers.second);
}

// A tick comes before the step that it interrupts, or after it. With two, the
// first of which comes at once, that is so of the second; or they are one, if
// the second comes before the interrupt has taken the first. Returns how many
// the step has used, or said that it has lost.
uint64_t Interrupts::force_ticking_at(const std::vector<uint64_t> &where)
{
    turn(start);
    const uint64_t before = entered;
    targets = where;
    turn(first);
    given.first = driver.get();
    targets.clear();
    driver.chip.run(quiet_cycles);
    const uint64_t came = entered - before;
    turn(second);
    given.second = driver.get();
    points++;
    if (came == 1 && are(1, 0)) {
        used_now++;
        return 1;
    }
    if (came == 1 && where.size() == 1 && are(0, 1)) {
        used_later++;
        return 0;
    }
    if (came == 2 && where.size() == 2 && (are(2, 0) || are(1, 1))) {
        used_second++;
        return are(2, 0) ? 2 : 1;
    }
    changed++;
    return 0;
}

// A tick before each instruction, after one at each of `before`. Returns the
// instruction of the step before which it is used by this step for the last
// time.
uint64_t Interrupts::force_ticking(const std::vector<uint64_t> &before)
{
    uint64_t last = 0;

    turn(start);
    targets = before;
    turn(first);
    targets.clear();
    const uint64_t instructions = instruction;
    const uint64_t step = step_at;
    for (uint64_t at = 0; at < instructions; at++) {
        std::vector<uint64_t> where = before;
        where.push_back(at);
        if (force_ticking_at(where) == where.size()) {
            last = at;
        }
    }
    return last < step ? 0 : last - step;
}

void Interrupts::run_ticking_seed(uint32_t seed)
{
    cases_begin(seed);
    tested.ask(&start);
    start.an937.ticks = 0;
    for (question *const asked : {&first, &second}) {
        tested.ask(asked);
        asked->an937.calls = CALL_GETTERS;
        asked->an937.ticks = 0;
    }
    define_ticking(1, 0);
    define_ticking(0, 1);
    define_ticking(2, 0);
    define_ticking(1, 1);
    const uint64_t looked = force_ticking({});
    const uint64_t taken = force_ticking({0});
    if (taken > looked + taken_most) {
        std::printf("a tick that comes while the step uses one is lost: up to "
                    "%lu instructions after the step looks\n",
                    taken - looked);
        changed++;
    }
}

bool Interrupts::run_ticking()
{
    driver.chip.on_execute(
        driver.chip.code("fixpid_" + std::string(tested.name) + "_step"),
        [this] { step_at = instruction; });
    driver.run_turn(); // up to the first wait
    for (uint32_t seed = 1; seed <= seeds && changed == 0; seed++) {
        run_ticking_seed(seed);
    }
    std::printf("%s %s interrupts %lu now %lu later %lu second %lu changed "
                "%lu\n",
                tested.name, driver.chip.processor().c_str(), points, used_now,
                used_later, used_second, changed);
    return changed == 0 && used_now != 0 && used_later != 0 && used_second != 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        const bool ticking = argc == 4 && std::strcmp(argv[3], "ticking") == 0;

        if (argc != 3 && !ticking) {
            throw ChipError("usage: interrupts FIRMWARE CONTROLLER [ticking]");
        }
        Interrupts interrupts(argv[1], find_controller(argv[2]));
        const bool good = ticking ? interrupts.run_ticking() : interrupts.run();
        return good ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "interrupts: %s\n", error.what());
        return 2;
    }
}
