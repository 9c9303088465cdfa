// SPDX-License-Identifier: MIT
// Recorded experiments on a chip. player.c plays the rows that table.rb
// compiled in; the library that it calls is the one below, which asks the chip:
//
//   chip FIRMWARE.cod EVERY    of the rows each so-manieth one
//
// Prints one line of figures. Exit status: 0 no row differs, 1 some do, 2 the
// run could not be made.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "chip.hh"

extern "C" {
#include "exchange.h"
#include "table.h"
}

namespace
{

constexpr uint64_t cycles_of_an_answer = 2000000; // far more than any takes
constexpr unsigned poison = 0xA5;
constexpr unsigned object_size = 70;
constexpr unsigned answer_size =
    offsetof(struct answer, model) +
    offsetof(struct fixpid_autotune_process, hysteresis) + sizeof(uint16_t);

class Remote
{
  public:
    explicit Remote(const std::string &cod)
        : chip(cod), exchange(chip.data("exchange")), turn(chip.data("turn")),
          object(chip.data("autotune_controller"))
    {
        chip.lenient_until("main");
        chip.set_oscillator(40e6);
        chip.on_execute(chip.code("main"), [this] { started = true; });
        chip.on_write(turn, [this](unsigned value) {
            if (started && value == 0) {
                chip.stop("its turn");
            }
        });
        wait();
    }

    struct answer ask(const struct question &question)
    {
        const auto *const bytes =
            reinterpret_cast<const unsigned char *>(&question);
        struct answer answer = {};
        auto *const answered = reinterpret_cast<unsigned char *>(&answer);

        if (question.call == CALL_INIT) { // which must set every member
            for (unsigned at = 0; at < object_size; at++) {
                chip.poke(object + at, poison);
            }
        }
        for (unsigned at = 0; at < sizeof question; at++) {
            chip.poke(exchange + at, bytes[at]);
        }
        chip.poke(turn, 1);
        wait();
        for (unsigned at = 0; at < answer_size; at++) {
            answered[at] = static_cast<unsigned char>(chip.peek(exchange + at));
        }
        calls++;
        return answer;
    }

    Chip chip;
    unsigned long calls = 0;

  private:
    void wait()
    {
        chip.run(cycles_of_an_answer);
        if (chip.stopped() != Stop::requested) {
            throw ChipError("no answer: " + chip.reason());
        }
    }

    unsigned exchange, turn, object;
    bool started = false; // main has
};

std::unique_ptr<Remote> remote;
struct answer last;

bool ask(struct question question, enum call call)
{
    question.call = static_cast<uint8_t>(call);
    last = remote->ask(question);
    return last.accepted != 0;
}

void play(unsigned every)
{
    const Meter &step = remote->chip.meter("fixpid_autotune_step");
    const Meter &result = remote->chip.meter("fixpid_autotune_result");
    unsigned rows = 0, different = 0;

    for (unsigned row = 0; row < table_count; row += every) {
        uint32_t values[PLAYER_VALUES];

        player_play(&table_rows[row].row, values);
        rows++;
        if (player_digest(PLAYER_DIGEST, values) != table_rows[row].recorded) {
            std::printf("row %u differs\n", row + 1);
            different++;
        }
    }
    std::printf("autotune %s rows %u different %u calls %lu step cycles "
                "%llu..%llu result cycles %llu..%llu stack %u\n",
                remote->chip.processor().c_str(), rows, different,
                remote->calls, static_cast<unsigned long long>(step.least),
                static_cast<unsigned long long>(step.most),
                static_cast<unsigned long long>(result.least),
                static_cast<unsigned long long>(result.most),
                remote->chip.stack_most());
    if (different != 0) {
        std::exit(EXIT_FAILURE);
    }
}

} // namespace

// The library that player.c calls.
extern "C" {
bool fixpid_autotune_init(struct fixpid_autotune *,
                          const struct fixpid_autotune_config *config)
{
    struct question question = {};

    question.config = *config;
    return ask(question, CALL_INIT);
}

int16_t fixpid_autotune_step(struct fixpid_autotune *, int16_t setpoint,
                             int16_t measurement)
{
    struct question question = {};

    question.setpoint = setpoint;
    question.measurement = measurement;
    (void)ask(question, CALL_STEP);
    return last.output;
}

uint8_t fixpid_autotune_status(const struct fixpid_autotune *)
{
    return last.status;
}

bool fixpid_autotune_model(const struct fixpid_autotune *,
                           struct fixpid_autotune_process *model)
{
    const bool found = ask({}, CALL_MODEL);

    *model = last.model;
    return found;
}

// One that has no gains leaves what it was given, as the chip does.
bool fixpid_autotune_result(const struct fixpid_autotune *, uint8_t rule,
                            uint8_t robustness_q4,
                            struct fixpid_pid_config *config)
{
    struct question question = {};

    question.rule = rule;
    question.robustness_q4 = robustness_q4;
    (void)ask(question, CALL_RESULT);
    config->gains.kp_q8 = last.kp_q8;
    config->gains.ki_q24 = last.ki_q24;
    config->gains.kd_q8 = last.kd_q8;
    config->gains.derivative_filter = last.derivative_filter;
    config->setpoint_weight_q8 = last.weight_q8;
    config->proportional_on_measurement = last.weightless != 0;
    return last.accepted != 0;
}

// Of the last result: the chip has told both.
uint8_t fixpid_autotune_reason(const struct fixpid_autotune *, uint8_t, uint8_t)
{
    return last.reason;
}

void fixpid_autotune_progress(const struct fixpid_autotune *,
                              struct fixpid_autotune_stage *stage)
{
    stage->phase = last.phase;
    stage->done = last.done;
    stage->expected = last.expected;
    stage->period = last.period;
}
}

int main(int argc, char *argv[])
{
    try {
        if (argc != 3) {
            throw ChipError("usage: chip FIRMWARE.cod EVERY");
        }
        remote = std::make_unique<Remote>(argv[1]);
        play(static_cast<unsigned>(std::atoi(argv[2])));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "chip: %s\n", error.what());
        return 2;
    }
}
