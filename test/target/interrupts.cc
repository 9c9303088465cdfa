// SPDX-License-Identifier: MIT
// The tick's interrupt forced before every instruction of a turn of
// driver_tick.c: of taking the ticks, of every call and of the step.
//
//   interrupts FIRMWARE.cod CONTROLLER
//
// No tick may be lost or told twice, and no answer may change. With a third
// argument, `ticking`, the interrupt is one that calls fixpid_an937_tick
// itself: the step that it interrupts, or else the next one, uses it. Exit
// status: 0 all is well, 1 it is not, 2 the run could not be made.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "driver.hh"

namespace
{

constexpr uint64_t turn_most = 20000; // cycles; far more than a turn has
constexpr uint64_t never = UINT64_MAX;
constexpr uint64_t quiet_cycles = 500; // in which an interrupt ends

struct Registers {
    unsigned vector;
    std::vector<std::pair<unsigned, unsigned>> flags;   // register, bit
    std::vector<std::pair<unsigned, unsigned>> quieten; // register, value
};

// TMR0IF, TMR1IF or CCP2IF, whichever the firmware enabled. Quiet: the chip's
// own tick does not come; its timer is started again, or stopped on a PIC18.
const Registers pic16 = {
    4, {{0x0B, 0x04}, {0x0C, 0x01}}, {{0x01, 0x20}, {0x0F, 0x00}}};
const Registers pic18 = {8, {{0xFF2, 0x04}, {0xFA1, 0x01}}, {{0xFCD, 0x80}}};

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
    bool report() const;
    void define_ticking(uint8_t ticks, uint8_t ticks_after, answer &during,
                        answer &after);
    void force_ticking_at(uint64_t where);
    bool is(const answer &given, const answer &expected) const;

    const controller &tested;
    Driver driver;
    const Registers &registers;
    unsigned ticks_told;
    question first, second;
    answer first_expected, second_expected;
    uint64_t instruction = 0; // of this turn
    uint64_t target = never;  // when the interrupt is forced
    uint64_t entered = 0;     // interrupts, so far
    uint64_t told = 0;        // ticks, so far
    uint64_t points = 0, lost = 0, changed = 0;

    question start;                            // for run_ticking
    answer now, after_now, later, after_later; // of first and second
    uint64_t used_now = 0, used_later = 0;
};

Interrupts::Interrupts(const std::string &cod, const controller &which)
    : tested(which), driver(cod, which),
      registers(driver.chip.is_pic18() ? pic18 : pic16),
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
    if (instruction == target) {
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
    const std::string what = target == never ? "the turn after an interrupt"
                                             : "interrupt before instruction " +
                                                   std::to_string(target);

    turn(asked);
    return same_answer(tested, what, expected, driver.get());
}

// One turn with an interrupt and one without: by then its tick was told.
void Interrupts::force_at(uint64_t where)
{
    const uint64_t owed = entered - told;
    bool good;

    target = where;
    good = turn_is_right(first, first_expected);
    target = never;
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

bool Interrupts::run()
{
    cases_begin(1);
    tested.ask(&first);
    tested.define(&first, &first_expected);
    tested.ask(&second);
    tested.define(&second, &second_expected);
    driver.run_turn(); // up to the first wait
    turn(first);
    const uint64_t instructions = instruction;
    for (uint64_t where = 0; where < instructions; where++) {
        force_at(where);
    }
    return report();
}

// The definition's answers if the interrupt's tick comes before the first
// question's step, or after it.
void Interrupts::define_ticking(uint8_t ticks, uint8_t ticks_after,
                                answer &during, answer &after)
{
    answer ignored;
    question with = first;

    tested.define(&start, &ignored);
    with.an937.ticks = ticks;
    tested.define(&with, &during);
    with = second;
    with.an937.ticks = ticks_after;
    tested.define(&with, &after);
}

bool Interrupts::is(const answer &given, const answer &expected) const
{
    return std::memcmp(&given, &expected, tested.answer_size) == 0;
}

void Interrupts::force_ticking_at(uint64_t where)
{
    turn(start);
    target = where;
    turn(first);
    const answer given = driver.get();
    target = never;
    driver.chip.run(quiet_cycles);
    turn(second);
    const answer given_after = driver.get();
    points++;
    if (is(given, now) && is(given_after, after_now)) {
        used_now++;
    } else if (is(given, later) && is(given_after, after_later)) {
        used_later++;
    } else {
        changed++;
    }
}

bool Interrupts::run_ticking()
{
    cases_begin(1);
    tested.ask(&start);
    start.an937.ticks = 0;
    for (question *const asked : {&first, &second}) {
        tested.ask(asked);
        asked->an937.calls = CALL_GETTERS;
        asked->an937.ticks = 0;
    }
    define_ticking(1, 0, now, after_now);
    define_ticking(0, 1, later, after_later);
    driver.run_turn(); // up to the first wait
    turn(first);
    const uint64_t instructions = instruction;
    for (uint64_t where = 0; where < instructions; where++) {
        force_ticking_at(where);
    }
    std::printf("%s %s interrupts %lu now %lu later %lu changed %lu\n",
                tested.name, driver.chip.processor().c_str(), points, used_now,
                used_later, changed);
    return changed == 0 && entered == points && used_now != 0 &&
           used_later != 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        const bool ticking = argc == 4 && std::strcmp(argv[3], "ticking") == 0;

        if (argc != 3 && !ticking) {
            throw ChipError(
                "usage: interrupts FIRMWARE.cod CONTROLLER [ticking]");
        }
        Interrupts interrupts(argv[1], find_controller(argv[2]));
        const bool good = ticking ? interrupts.run_ticking() : interrupts.run();
        return good ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "interrupts: %s\n", error.what());
        return 2;
    }
}
