// SPDX-License-Identifier: MIT
// The firmware of examples/kept with good and with spoilt records in its chip's
// EEPROM, after each power-on:
//
//   kept FIRMWARE
//
// the .cod of a PIC18F4520 or the .elf of an ATmega328P; the linker chooses the
// simulator. Exit status: 0 all is well, 1 something is not, 2 the run could
// not be made.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iterator>
#include <vector>

#include "chip.hh"

extern "C" {
#include "kept_host.h"
}

namespace
{

constexpr unsigned record_bytes = 23;
constexpr uint64_t pass_most = 4000000;   // cycles; more than 200 ms
constexpr unsigned switch_at_brisk = 900; // of 1023
constexpr unsigned passes_to_keep = record_bytes + 4;
constexpr unsigned gie = 0x80; // of INTCON, I of SREG

class Bench
{
  public:
    explicit Bench(const std::string &firmware);

    void power_on(); // up to its first wait, with the host's EEPROM
    void passes(unsigned count);
    void turn_switch(unsigned code);
    void take_eeprom(); // of the chip to the host
    // From now on the application masks the interrupt before it writes a byte
    // and enables it afterwards.
    void mask_writes();
    unsigned writes_unmasked() const; // that were masked, and ended unmasked
    bool is_expected() const;
    bool keeps_expected() const;

  private:
    void to_wait();
    bool enabled() const;
    void enable(bool on);

    Chip chip;
    unsigned object;
    unsigned selector;
    unsigned intcon; // or SREG
    unsigned unmasked = 0;
    bool masks = false;
    bool masked = false;
};

Bench::Bench(const std::string &firmware)
    : chip(firmware), object(chip.data("oven")),
      selector(chip.analog_input(chip.is_pic18() ? "porta1" : "adc1")),
      intcon(chip.is_pic18() ? 0xFF2 : 0x5F)
{
    if (chip.is_pic18()) {
        chip.set_oscillator(40e6);
    }
    chip.set_code(chip.analog_input(chip.is_pic18() ? "porta0" : "adc0"), 500);
    chip.set_code(chip.analog_input(chip.is_pic18() ? "porta2" : "adc2"), 480);
    turn_switch(0);
    chip.on_execute(chip.code("port_wait_ticks"),
                    [this] { chip.stop("it waits"); });
    chip.on_execute(chip.code("port_eeprom_write"), [this] {
        masked = masks;
        enable(!masks);
    });
}

bool Bench::enabled() const
{
    return (chip.peek(intcon) & gie) != 0;
}

void Bench::enable(bool on)
{
    chip.write(intcon, on ? chip.peek(intcon) | gie : chip.peek(intcon) & ~gie);
}

void Bench::mask_writes()
{
    masks = true;
}

unsigned Bench::writes_unmasked() const
{
    return unmasked;
}

void Bench::to_wait()
{
    do { // a PIC says that it was at the reset vector
        chip.run(pass_most);
    } while (chip.reason() == "restarted at the reset vector");
    if (chip.reason() != "it waits") {
        throw ChipError("the loop does not come round: " + chip.reason());
    }
    if (masked) {
        unmasked += enabled() ? 1 : 0;
        enable(true);
        masked = false;
    }
}

void Bench::power_on()
{
    for (unsigned i = 0; i < KEPT_EEPROM; i++) {
        chip.poke_eeprom(i, kept_eeprom[i]);
    }
    chip.fill_ram(0xA5);
    chip.reset();
    if (chip.is_pic18()) {
        chip.lenient_until("main"); // SDCC's start-up clears all that could be
    }
    to_wait();
}

void Bench::passes(unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        to_wait();
    }
}

void Bench::turn_switch(unsigned code)
{
    chip.set_code(selector, code);
}

void Bench::take_eeprom()
{
    for (unsigned i = 0; i < KEPT_EEPROM; i++) {
        kept_eeprom[i] = (uint8_t)chip.peek_eeprom(i);
    }
}

// The chip's controller is the host's.
bool Bench::is_expected() const
{
    for (unsigned i = 0; i < kept_object_size; i++) {
        if (chip.peek(object + i) != kept_byte(i)) {
            return false;
        }
    }
    return true;
}

bool Bench::keeps_expected() const
{
    for (unsigned i = 0; i < KEPT_EEPROM; i++) {
        if (chip.peek_eeprom(i) != kept_eeprom[i]) {
            return false;
        }
    }
    return true;
}

unsigned checked = 0;
unsigned wrong = 0;

void check(bool good, const std::string &what)
{
    checked++;
    if (!good) {
        wrong++;
        std::printf("kept: %s\n", what.c_str());
    }
}

void starts_with(Bench &bench, unsigned which, const std::string &what)
{
    bench.power_on();
    kept_expect(which);
    check(bench.is_expected(), what);
}

void check_starts(Bench &bench)
{
    std::memset(kept_eeprom, 0xFF, sizeof(kept_eeprom));
    starts_with(bench, KEPT_GENTLE, "a new chip does not start gently");
    std::memset(kept_eeprom, 0, sizeof(kept_eeprom));
    starts_with(bench, KEPT_GENTLE, "of zeros it does not start gently");
    for (const unsigned which : {KEPT_GENTLE, KEPT_BRISK, KEPT_OTHER}) {
        kept_store(which);
        starts_with(bench, which,
                    "good record " + std::to_string(which) + " is not taken");
    }
    kept_store(KEPT_REFUSED);
    starts_with(bench, KEPT_GENTLE, "a record without limits is taken");
}

// Each bit of a good record.
void check_spoilt(Bench &bench)
{
    for (unsigned bit = 0; bit < 8 * record_bytes; bit++) {
        kept_store(KEPT_BRISK);
        kept_eeprom[KEPT_RECORD_AT + bit / 8] ^= (uint8_t)(1u << (bit % 8));
        starts_with(bench, KEPT_GENTLE,
                    "spoilt bit " + std::to_string(bit) + " is not noticed");
    }
}

// The switch chooses a tuning, which is there after the next power-on.
void check_switch(Bench &bench)
{
    kept_store(KEPT_GENTLE);
    bench.power_on();
    bench.turn_switch(switch_at_brisk);
    bench.passes(passes_to_keep);
    bench.turn_switch(0);
    kept_store(KEPT_BRISK);
    check(bench.keeps_expected(), "the switch's tuning is not in the EEPROM");
    bench.take_eeprom();
    starts_with(bench, KEPT_BRISK, "the switch's tuning is not taken");
}

// The supply goes after each pass: what was written is the record before it, a
// part, which is refused, or the new one.
void check_halves(Bench &bench)
{
    std::vector<std::array<uint8_t, KEPT_EEPROM>> left(passes_to_keep);

    kept_store(KEPT_GENTLE);
    bench.power_on();
    bench.turn_switch(switch_at_brisk);
    for (auto &eeprom : left) {
        bench.passes(1);
        bench.take_eeprom();
        std::copy(std::begin(kept_eeprom), std::end(kept_eeprom),
                  eeprom.begin());
    }
    bench.turn_switch(0);
    check(left.front() != left.back(), "no pass writes");
    for (size_t i = 0; i < left.size(); i++) {
        std::copy(left[i].begin(), left[i].end(), std::begin(kept_eeprom));
        bench.power_on();
        kept_start();
        check(bench.is_expected(),
              "half a record, " + std::to_string(i + 1) + " passes");
    }
}

void check_masked(Bench &bench)
{
    kept_store(KEPT_GENTLE);
    bench.power_on();
    bench.mask_writes();
    bench.turn_switch(switch_at_brisk);
    bench.passes(passes_to_keep);
    kept_store(KEPT_BRISK);
    check(bench.keeps_expected(),
          "with the interrupt masked the tuning is not in the EEPROM");
    check(bench.writes_unmasked() == 0,
          std::to_string(bench.writes_unmasked()) +
              " writes of the EEPROM enable the interrupt that was masked");
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc != 2) {
            throw ChipError("usage: kept FIRMWARE");
        }
        Bench bench(argv[1]);
        check_starts(bench);
        check_spoilt(bench);
        check_switch(bench);
        check_halves(bench);
        check_masked(bench);
        std::printf("kept power-ons and records %u wrong %u\n", checked, wrong);
        return (wrong == 0) ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
