// SPDX-License-Identifier: MIT
// Is this the gpsim that the wrapper was written for? Holds it to data-sheet
// cycles and to its own known defects, so that another release cannot change
// results silently, and shows that the wrapper's guards catch what they should.
//
//   simulator CASE FOLDER     one case; FOLDER has the firmware
//   simulator                 the cases, by name
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "chip.hh"

namespace
{

unsigned failures = 0;

void expect(bool good, const std::string &what)
{
    if (!good) {
        std::printf("  FAILED: %s\n", what.c_str());
        failures++;
    }
}

void expect_equal(double measured, double expected, const std::string &what)
{
    expect(measured == expected, what + ": " + std::to_string(measured) +
                                     ", expected " + std::to_string(expected));
}

// ---- Cycles ----

using Lengths = std::map<std::string, unsigned>; // the data sheet's

void routines_take(Chip &chip, const Lengths &lengths)
{
    std::vector<std::pair<const Meter *, unsigned>> meters;
    for (const auto &[name, length] : lengths) {
        meters.emplace_back(&chip.meter(name), length);
    }
    chip.on_execute(chip.code("called_all"), [&] { chip.stop("done"); });
    (void)chip.run(1000);
    expect(chip.stopped() == Stop::requested, "all were called");
    for (const auto &[meter, length] : meters) {
        expect_equal((double)meter->calls, (meter->name == "nops") ? 2 : 1,
                     meter->name + ", calls");
        expect_equal((double)meter->least, length, meter->name + ", least");
        expect_equal((double)meter->most, length, meter->name + ", most");
    }
}

// Wherever an interrupt comes, neither meter changes; except that one in the
// middle of an instruction of two cycles costs that one its second cycle.
void interrupts_are_kept_apart(Chip &chip, unsigned vector, unsigned intcon,
                               unsigned length)
{
    const Meter &routine = chip.meter("interrupted");
    const Meter &interrupt = chip.meter_interrupt(vector);
    const unsigned first = chip.code("forever");
    std::set<unsigned> interrupted;
    unsigned current = 0;
    for (const unsigned at : chip.instructions()) {
        if ((at >= first) || (at == chip.code("nops"))) {
            chip.on_execute(at, [&current, at] { current = at; });
        }
    }
    unsigned before = 0;
    unsigned enabled = 0; // a real chip clears GIE for the interrupt
    chip.on_execute(vector, [&] {
        interrupted.insert(current);
        before++;
        enabled += chip.peek(intcon) >> 7;
    });
    chip.every(101, [&] { chip.write(intcon, chip.peek(intcon) | 0x04); });
    (void)chip.run(101 * 1000);
    expect(chip.stopped() == Stop::none, "runs on: " + chip.reason());
    expect(before >= 990, "a thousand interrupts");
    expect_equal(interrupted.size(), 11, "places of an interrupt");
    expect_equal(enabled, before, "interrupts with GIE still set");
    expect(interrupt.calls + 1 >= before, "each interrupt was metered");
    expect_equal((double)interrupt.least, 3, "interrupt, least");
    expect_equal((double)interrupt.most, 3, "interrupt, most");
    expect_equal((double)routine.least, length - 1, "interrupted, least");
    expect_equal((double)routine.most, length, "interrupted, most");
}

const Lengths lengths_14 = {{"nops", 4},     {"jump", 4},    {"skip", 4},
                            {"no_skip", 4},  {"loop", 18},   {"nested", 8},
                            {"computed", 5}, {"literal", 2}, {"turns", 16}};

const Lengths lengths_14e = {{"nops", 4},   {"branch", 4},   {"backward", 4},
                             {"banks", 4},  {"shifts", 5},   {"carries", 4},
                             {"moves", 5},  {"pages", 3},    {"loop", 18},
                             {"nested", 8}, {"computed", 5}, {"literal", 2},
                             {"turns", 16}};

// With TBLRD and TBLWT at two cycles, after the wrapper's correction: gpsim's
// own count is one.
const Lengths lengths_18 = {{"nops", 4},
                            {"jump", 4},
                            {"branch", 4},
                            {"branch_taken", 5},
                            {"branch_not_taken", 6},
                            {"skip_one", 4},
                            {"skip_two", 5},
                            {"move", 4},
                            {"load_fsr", 4},
                            {"multiply", 3},
                            {"table_read", 4},
                            {"table_reads", 6},
                            {"nested", 8},
                            {"loop", 18},
                            {"compare", 5},
                            {"table_write", 4},
                            {"turns", 16}};

void cycles_14(Chip &chip)
{
    routines_take(chip, lengths_14);
    interrupts_are_kept_apart(chip, 0x04, 0x0B, 25);
}

void cycles_14e(Chip &chip)
{
    routines_take(chip, lengths_14e);
    expect_equal(chip.stack_most(), 16, "levels of the stack");
}

void cycles_18(Chip &chip)
{
    routines_take(chip, lengths_18);
    interrupts_are_kept_apart(chip, 0x08, 0xFF2, 25);
}

// ---- Guards ----

constexpr unsigned command = 0x20; // in both firmwares

void is_caught(Chip &chip, unsigned number, const std::string &reason)
{
    chip.poke(command, number);
    (void)chip.run(500000);
    expect(chip.stopped() == Stop::fault, "caught");
    expect(chip.reason().find(reason) == 0,
           "the reason is \"" + chip.reason() + "\"");
}

// A loop without end is no defect by itself: the run ends when it should.
void runs_for_ever(Chip &chip, unsigned number)
{
    chip.poke(command, number);
    const uint64_t cycles = chip.run(200000);
    expect(chip.stopped() == Stop::none, "not stopped: " + chip.reason());
    expect(cycles - 200000 <= 2, "the cycles asked for");
    expect(chip.messages().empty(), "gpsim is silent");
    expect_equal(chip.lint().size(), chip.is_pic18() ? 1 : 0, "lint");
}

void memory_is_poisoned(Chip &chip)
{
    const unsigned size = chip.is_pic18() ? 1536 : 128;
    expect_equal(chip.ram_bytes(), size, "bytes of RAM");
    unsigned poisoned = 0;
    for (unsigned i = 0; i < size; i++) {
        // A PIC16F684's RAM is at 0x20..0x7F and 0xA0..0xBF.
        const unsigned at = chip.is_pic18() ? i
                            : (i < 96)      ? 0x20 + i
                                            : 0xA0 + i - 96;
        poisoned += (chip.peek(at) == 0xA5) ? 1 : 0;
    }
    expect_equal(poisoned, size, "poisoned bytes");
}

void wrong_use_is_refused(Chip &chip)
{
    const auto refused = [](const char *what, const auto &action) {
        try {
            action();
            expect(false, std::string(what) + " is refused");
        } catch (const ChipError &) {
        }
    };
    try {
        Chip("none.cod");
        expect(false, "a second chip is refused");
    } catch (const ChipError &error) {
        expect(std::string(error.what()).find("one chip only") !=
                   std::string::npos,
               "a second chip is refused as such");
    }
    refused("a pin", [&] { (void)chip.analog_input("porta9"); });
    refused("a routine", [&] { (void)chip.code("nowhere"); });
    refused("a variable", [&] { (void)chip.data("nowhere"); });
    refused("an address", [&] { (void)chip.peek(0x10000); });
}

// ---- Peripherals, from outside: the firmware only waits ----

struct Converter {
    unsigned control, control_start, high, low;
};

unsigned converted(Chip &chip, const Converter &converter)
{
    chip.write(converter.control, converter.control_start);
    (void)chip.run(500);
    return (chip.peek(converter.high) << 8) | chip.peek(converter.low);
}

// gpsim rounds to 1023 steps; the wrapper's codes come out as they went in.
void converts_as_known(Chip &chip, const Converter &converter)
{
    const unsigned input = chip.analog_input("porta0");
    unsigned wrong = 0;
    for (unsigned code = 0; code < 1024; code++) {
        chip.set_code(input, code);
        wrong += (converted(chip, converter) != code) ? 1 : 0;
    }
    expect_equal(wrong, 0, "wrong codes");
    wrong = 0;
    for (unsigned i = 1; i < 512; i++) {
        const double volts = 5.0 * i / 512.37;
        chip.set_volts(input, volts);
        wrong += (converted(chip, converter) !=
                  (unsigned)std::floor(1023 * volts / 5.0 + 0.5))
                     ? 1
                     : 0;
    }
    expect_equal(wrong, 0, "off gpsim's own transfer");
    chip.set_volts(input, -0.2);
    expect_equal(converted(chip, converter), 0, "below the supply");
    chip.set_volts(input, 5.3);
    expect_equal(converted(chip, converter), 1023, "above the supply");
    expect(chip.messages().empty(), "gpsim is silent");
}

struct Pwm {
    unsigned t2con, pr2, ccprl, ccpcon, mode, pir1;
};

unsigned timer2_ends(Chip &chip, const Pwm &pwm)
{
    unsigned ends = 0;
    for (unsigned i = 0; i < 20; i++) {
        chip.write(pwm.pir1, chip.peek(pwm.pir1) & ~0x02u);
        (void)chip.run(80);
        ends += ((chip.peek(pwm.pir1) & 0x02) != 0) ? 1 : 0;
    }
    return ends;
}

// At 1:1, duties of 1 to 3 stop TMR2 for good.
void small_duties_stop_timer2(Chip &chip, const Pwm &pwm, unsigned duty)
{
    chip.write(pwm.pr2, 0x3F);
    chip.write(pwm.ccprl, 8);
    chip.write(pwm.ccpcon, pwm.mode);
    chip.write(pwm.t2con, 0x04);
    (void)chip.run(1000);
    expect_equal(timer2_ends(chip, pwm), 20, "periods, duty 32");
    chip.write(pwm.ccpcon, pwm.mode | (duty << 4));
    chip.write(pwm.ccprl, 0);
    (void)chip.run(1000);
    expect_equal(timer2_ends(chip, pwm), (duty == 0) ? 20 : 0,
                 "periods, duty " + std::to_string(duty));
}

const Converter converter_14 = {0x1F, 0x83, 0x1E, 0x9E};
const Pwm pwm_14 = {0x12, 0x92, 0x13, 0x15, 0x4C, 0x0C};

void idle_14(Chip &chip)
{
    chip.poke(command, 7);
    (void)chip.run(100);
    chip.write(0x8F, 0x70); // OSCCON
    chip.write(0x91, 0x01); // ANSEL
    chip.write(0x9F, 0x20); // ADCON1
    (void)chip.run(100);
    expect_equal(chip.cycles_per_second(), 2e6, "cycles a second");
}

void converter_is_known_14(Chip &chip)
{
    idle_14(chip);
    converts_as_known(chip, converter_14);
}

// The bridge shows at its pins in steps of four counts.
void bridge_is_known(Chip &chip)
{
    idle_14(chip);
    const unsigned p1d = chip.probe("portc2");
    chip.write(0x87, 0x03); // TRISC
    chip.write(pwm_14.pr2, 0x3F);
    chip.write(pwm_14.t2con, 0x04);
    for (const unsigned duty : {32u, 33u, 34u, 35u, 36u, 128u}) {
        chip.write(pwm_14.ccprl, duty >> 2);
        chip.write(pwm_14.ccpcon, 0x4C | ((duty & 3) << 4));
        (void)chip.run(64 * 4);
        (void)chip.probe_high_cycles(p1d);
        const uint64_t start = chip.cycle();
        (void)chip.run(64 * 100 - 1);
        expect_equal((double)(chip.cycle() - start), 64 * 100, "periods");
        expect_equal((double)chip.probe_high_cycles(p1d), 100 * (duty / 4),
                     "high cycles at duty " + std::to_string(duty));
    }
}

constexpr unsigned idle_command_18 = 9;
constexpr unsigned alu_command = 10;
const Converter converter_18 = {0xFC2, 0x03, 0xFC4, 0xFC3};
const Pwm pwm_18 = {0xFCA, 0xFCB, 0xFBE, 0xFBD, 0x0C, 0xF9E};

void idle_18(Chip &chip, unsigned number = idle_command_18)
{
    chip.poke(command, number);
    (void)chip.run(100);
    expect_equal(chip.cycles_per_second(), 5e6, "gpsim knows no HSPLL");
    chip.write(0xFC1, 0x0E); // ADCON1
    chip.write(0xFC0, 0x92); // ADCON2
}

void converter_is_known_18(Chip &chip)
{
    idle_18(chip);
    converts_as_known(chip, converter_18);
}

// Each conversion interrupts, although ADIE is off: to 0x18 when low
// priorities are on, to 8 without priorities, and not with INTCON = 0x80.
void converter_interrupts(Chip &chip)
{
    unsigned high = 0;
    unsigned low = 0;
    chip.on_execute(0x08, [&] { high++; });
    chip.on_execute(0x18, [&] { low++; });
    idle_18(chip);
    const unsigned input = chip.analog_input("porta0");
    chip.set_code(input, 100);
    chip.write(0xFD0, 0x80 | chip.peek(0xFD0)); // IPEN
    chip.write(0xFF2, 0x80);                    // GIEH
    (void)converted(chip, converter_18);
    expect_equal(high + low, 0, "interrupts with GIEH only");
    chip.write(0xFD0, 0x7F & chip.peek(0xFD0));
    chip.write(0xFF2, 0xC0); // GIE, PEIE
    (void)converted(chip, converter_18);
    expect_equal(high, 1, "interrupts without priorities");
    expect_equal(low, 0, "low ones without priorities");
    chip.write(0xFD0, 0x80 | chip.peek(0xFD0));
    chip.write(0xFF2, 0xC0); // GIEH, GIEL
    (void)converted(chip, converter_18);
    expect(low > 0, "low interrupts with GIEL");
}

// Right results, but a wrong OV, and the wrong byte through PREINCn.
void alu_is_known(Chip &chip)
{
    constexpr unsigned left = 0x21, right = 0x22, status = 0x23, result = 0x24;
    idle_18(chip, alu_command);
    unsigned wrong_flags = 0;
    unsigned wrong_overflows = 0;
    unsigned pair = 0;
    unsigned wrong_bytes = 0;
    chip.poke(0x100, 40);
    chip.on_execute(chip.code("alu"), [&] {
        chip.poke(left, pair & 0xFF);
        chip.poke(right, pair >> 8);
        chip.poke(0x101, 7);
    });
    chip.on_execute(chip.code("done"), [&] {
        const unsigned a = pair & 0xFF, b = pair >> 8, sum = (a + b) & 0xFF;
        const unsigned flags = ((a + b) >> 8) |
                               (((a & 15) + (b & 15)) >> 4 << 1) |
                               ((sum == 0) ? 4u : 0u) | ((sum >> 7) << 4);
        const unsigned overflow = ((~(a ^ b) & (a ^ sum)) >> 7) & 1;
        wrong_flags += ((chip.peek(status) & 0x17) != flags) ? 1 : 0;
        wrong_overflows += (((chip.peek(status) >> 3) & 1) != overflow) ? 1 : 0;
        wrong_bytes += (chip.peek(result) != 8) ? 1 : 0;
        pair += 7;
        if (pair > 0xFFFF) {
            chip.stop("all pairs");
        }
    });
    (void)chip.run(1000000);
    expect(chip.stopped() == Stop::requested, "all pairs: " + chip.reason());
    expect_equal(wrong_flags, 0, "wrong C, DC, Z or N");
    expect_equal(wrong_overflows, 2341, "pairs with a wrong OV");
    expect_equal(wrong_bytes, pair / 7, "wrong bytes through PREINC0");
}

// The end of a TMR2 period copies CCPR2L to CCPR2H, also when CCP2 compares.
void compare_is_spoiled(Chip &chip)
{
    idle_18(chip);
    chip.write(0xFBA, 0x0A); // CCP2CON: compare
    chip.write(0xFBC, 0x27); // CCPR2H
    chip.write(0xFBB, 0x10); // CCPR2L
    (void)chip.run(2000);
    expect_equal(chip.peek(0xFBC), 0x27, "CCPR2H, TMR2 off");
    chip.write(pwm_18.pr2, 0x3F);
    chip.write(pwm_18.ccpcon, pwm_18.mode);
    chip.write(pwm_18.t2con, 0x04);
    (void)chip.run(2000);
    expect_equal(chip.peek(0xFBC), 0x10, "CCPR2H, TMR2 on");
}

// CCP2 matches Timer1 at 1, but never at 0.
void compare_with_zero_is_missed(Chip &chip)
{
    idle_18(chip);
    chip.write(0xFB1, 0x00); // T3CON: CCP2 counts with Timer1
    chip.write(0xFCD, 0x81); // T1CON: on, 1:1
    for (const unsigned match : {1u, 0u}) {
        chip.write(0xFBA, 0x0A); // CCP2CON: compare
        chip.write(0xFBC, 0x00);
        chip.write(0xFBB, match);
        chip.write(0xFA1, chip.peek(0xFA1) & ~0x01u); // CCP2IF
        (void)chip.run(200000);
        expect_equal(chip.peek(0xFA1) & 0x01, match, "a match within 3 turns");
    }
}

// Timer0 at 1:32 interrupts each 8192 cycles, without drift.
void timer0_is_right(Chip &chip)
{
    std::set<uint64_t> periods;
    uint64_t last = 0;
    idle_14(chip);
    chip.on_execute(0x04, [&] {
        chip.write(0x0B, 0xA0); // T0IF off
        if (last != 0) {
            periods.insert(chip.cycle() - last);
        }
        last = chip.cycle();
    });
    chip.write(0x81, 0x84); // OPTION_REG
    chip.write(0x0B, 0xA0); // GIE, T0IE
    (void)chip.run(20 * 8192);
    const bool exact = !periods.empty() && (*periods.begin() >= 8191) &&
                       (*periods.rbegin() <= 8193);
    expect(exact, "8192 cycles, to an instruction");
}

// Timer1 stands still while it is off, and counts each cycle from what was
// written then.
void timer1_is_right(Chip &chip)
{
    const auto count = [&] { return (chip.peek(0x0F) << 8) | chip.peek(0x0E); };
    idle_14(chip);
    chip.write(0x10, 0x00); // T1CON: off
    chip.write(0x0F, 0x12);
    chip.write(0x0E, 0xF0);
    (void)chip.run(100);
    expect_equal(count(), 0x12F0, "stands still");
    const uint64_t start = chip.cycle();
    chip.write(0x10, 0x01); // on, 1:1
    (void)chip.run(1000);
    chip.write(0x10, 0x00);
    expect_equal(count(), 0x12F0 + (double)(chip.cycle() - start), "counts");
    chip.write(0x0E, (chip.peek(0x0E) + 0x10) & 0xFF);
    const unsigned written = count();
    (void)chip.run(100);
    expect_equal(count(), written, "stands still again");
}

// ---- The cases ----

using Body = std::function<void(Chip &)>;

Body caught(unsigned number, const char *said)
{
    return [=](Chip &chip) { is_caught(chip, number, said); };
}

Body endless(unsigned number)
{
    return [=](Chip &chip) { runs_for_ever(chip, number); };
}

Body duty(void (*idle)(Chip &), const Pwm &pwm, unsigned counts)
{
    return [=](Chip &chip) {
        idle(chip);
        small_duties_stop_timer2(chip, pwm, counts);
    };
}

struct Case {
    const char *name;
    const char *firmware;
    Body body;
};

const Case cases[] = {
    {"cycles_14", "cycles14", cycles_14},
    {"cycles_14e", "cycles14e", cycles_14e},
    {"cycles_18", "cycles18", cycles_18},
    {"memory_14", "defects14", memory_is_poisoned},
    {"memory_18", "defects18", memory_is_poisoned},
    {"use", "defects14", wrong_use_is_refused},
    {"overflow_14", "defects14", caught(0, "return stack overflow")},
    {"underflow_14", "defects14", caught(1, "return stack underflow")},
    {"outside_14", "defects14", caught(2, "access outside the chip's RAM")},
    {"outside_read_14", "defects14",
     caught(3, "access outside the chip's RAM")},
    {"erased_14", "defects14", caught(4, "ran into erased flash at 00600")},
    {"watchdog_14", "defects14", caught(5, "watchdog reset")},
    {"restart_14", "defects14", caught(6, "restarted at the reset vector")},
    {"endless_14", "defects14", endless(7)},
    {"overflow_14e", "cycles14e",
     caught(1, "return stack overflow: more than 16 levels")},
    {"underflow_14e", "cycles14e", caught(2, "return stack underflow")},
    {"overflow_18", "defects18", caught(0, "return stack overflow")},
    {"underflow_18", "defects18", caught(1, "return stack underflow")},
    {"outside_18", "defects18", caught(2, "access outside the chip's RAM")},
    {"outside_read_18", "defects18",
     caught(3, "access outside the chip's RAM")},
    {"erased_18", "defects18", caught(4, "ran into erased flash at 06000")},
    {"watchdog_18", "defects18", caught(5, "watchdog reset")},
    {"restart_18", "defects18", caught(6, "restarted at the reset vector")},
    {"reset_18", "defects18", caught(7, "reset by a RESET")},
    {"endless_18", "defects18", endless(9)},
    {"converter_14", "defects14", converter_is_known_14},
    {"converter_18", "defects18", converter_is_known_18},
    {"bridge_14", "defects14", bridge_is_known},
    {"duty_0_14", "defects14", duty(idle_14, pwm_14, 0)},
    {"duty_1_14", "defects14", duty(idle_14, pwm_14, 1)},
    {"duty_3_14", "defects14", duty(idle_14, pwm_14, 3)},
    {"duty_1_18", "defects18", duty([](Chip &c) { idle_18(c); }, pwm_18, 1)},
    {"interrupts_18", "defects18", converter_interrupts},
    {"alu_18", "defects18", alu_is_known},
    {"compare_18", "defects18", compare_is_spoiled},
    {"compare_zero_18", "defects18", compare_with_zero_is_missed},
    {"timer0_14", "defects14", timer0_is_right},
    {"timer1_14", "defects14", timer1_is_right},
};

int run(const Case &which, const std::string &folder)
{
    try {
        Chip chip(folder + "/" + which.firmware + ".cod");
        which.body(chip);
    } catch (const ChipError &error) {
        expect(false, error.what());
    }
    std::printf("%s %s\n", which.name, (failures == 0) ? "ok" : "FAILED");
    return (failures == 0) ? 0 : 1;
}

} // namespace

int main(int count, char **arguments)
{
    for (const Case &candidate : cases) {
        if (count == 1) {
            std::printf("%s\n", candidate.name);
        } else if ((count == 3) &&
                   (candidate.name == std::string(arguments[1]))) {
            return run(candidate, arguments[2]);
        }
    }
    return (count == 1) ? 0 : 2;
}
