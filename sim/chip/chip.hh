// SPDX-License-Identifier: MIT
// A microcontroller simulated by gpsim 0.31, ../gpsim/chip.cc, with a firmware
// in it. An AVR is simulated by simavr, ../simavr/chip.cc, behind the same
// functions, as far as it has what they are about.
//
// gpsim keeps its state in global variables, so a program has one chip: a
// second one is refused. Everything is deterministic; time is instruction
// cycles. What gpsim models wrongly is corrected here where that is possible
// (TBLRD's cycles, the converter's rounding) and reported by lint() where it is
// not; test/chips/target/simulator/ holds gpsim to exactly these defects.
//
// An action runs between two instructions or inside one; it may read, write,
// drive pins and stop the run, but not run the chip.
#ifndef CHIP_HH
#define CHIP_HH
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// What cannot be done at all: no such file, chip, symbol or pin.
struct ChipError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Cycles of a routine: from its first instruction up to and including its
// RETURN or RETFIE. The CALL or the interrupt's latency is not in it, nor are
// the metered interrupts that came in between; but gpsim makes a two-cycle
// instruction a cycle shorter when an interrupt arrives in its middle, so only
// `most` is exact then.
struct Meter {
    std::string name;
    uint64_t calls = 0;
    uint64_t least = UINT64_MAX; // meaningless while calls is 0
    uint64_t most = 0;
    uint64_t total = 0;
    uint64_t last = 0;
    uint64_t interrupted = 0; // cycles of metered interrupts within, in all
    std::function<void()> on_call; // before its first instruction
    std::function<void(uint64_t cycles)> on_return; // after its last
};

enum class Stop {
    none,      // the cycles asked for have been run
    requested, // by stop()
    fault      // by a guard
};

class Chip
{
  public:
    using Action = std::function<void()>;
    using ValueAction = std::function<void(unsigned value)>;

    // Loads a .cod file, which names its own chip; `processor` ("p16f684")
    // refuses any other. The RAM is poisoned, as a real one is random at power-
    // on, and all guards are set. Throws ChipError.
    explicit Chip(const std::string &cod, const std::string &processor = "");
    ~Chip();
    Chip(const Chip &) = delete;
    Chip &operator=(const Chip &) = delete;

    // ---- Time ----

    // Runs this many cycles, or fewer if stopped; returns how many.
    uint64_t run(uint64_t cycles);
    Stop stopped() const;
    const std::string &reason() const; // of the stop; empty if there was none
    void stop(const std::string &reason);
    void fail(const std::string &reason); // the same, as a fault

    uint64_t cycle() const;
    double cycles_per_second() const; // as the oscillator is set now
    // The oscillator, where the configuration words do not decide: gpsim does
    // not multiply by the HSPLL's 4.
    void set_oscillator(double hertz);

    // ---- Faults; only between two runs ----

    // As the reset pin does it, or power-on: the RAM stays as it is. The next
    // run begins at the reset vector, which a PIC says as a fault of its guard.
    void reset();
    // The instruction at program_counter() jumps to itself until a reset. It is
    // the next one unless the chip is within a jump: run it, and look whether
    // it is still there. The instruction that was hung before is mended.
    void hang();

    // ---- Memory ----

    // A byte of RAM or a register, without side effects and unseen by actions.
    unsigned peek(unsigned address) const;
    void poke(unsigned address, unsigned value);
    // With the side effects of an instruction that writes it: for flags.
    void write(unsigned address, unsigned value);
    uint16_t peek_u16(unsigned address) const;
    int16_t peek_s16(unsigned address) const;
    uint32_t peek_u32(unsigned address) const;
    int32_t peek_s32(unsigned address) const;
    void poke_u16(unsigned address, uint16_t value);
    void poke_u32(unsigned address, uint32_t value);
    void fill_ram(unsigned value); // all of it, no register
    unsigned ram_bytes() const;    // that the chip has
    unsigned peek_eeprom(unsigned address) const;
    void poke_eeprom(unsigned address, unsigned value);

    // ---- Symbols: "x" finds C's x, which is _x, before assembly's x ----

    bool has_symbol(const std::string &name) const;
    unsigned data(const std::string &name) const; // address; throws ChipError
    unsigned code(const std::string &name) const; // byte address on a PIC18
    std::vector<unsigned> instructions() const;   // every programmed address

    // ---- State ----

    bool is_pic18() const;
    std::string processor() const; // "p16f684"
    unsigned program_counter() const;
    unsigned working() const; // W; r24 of an AVR
    void set_working(unsigned value);
    unsigned stack_depth() const;   // return addresses on the hardware stack
    unsigned stack_most() const;    // the deepest at any instruction so far
    std::string stack_unit() const; // "levels", or "bytes" of RAM
    bool asleep() const;

    // ---- Actions; they stay until the end ----

    void every(uint64_t cycles, Action action);
    // A routine's loop that waits for an interrupt goes round once; then only
    // time passes, until shortly before anything else happens. All else, each
    // cycle too, is as if each of its instructions had been simulated, which
    // the simulator of an AVR does.
    void skip_waiting(const std::string &routine);
    void on_execute(unsigned code_address, Action action); // just before it
    void on_write(unsigned address, ValueAction action);   // just after it
    void on_read(unsigned address, Action action);         // just before it

    // ---- Meters; they stay valid until the end ----

    Meter &meter(const std::string &routine);
    Meter &meter_at(unsigned code_address, const std::string &name);
    // Meters an interrupt: 4 on a PIC16, 8 or 0x18 on a PIC18. Its cycles are
    // kept out of all other meters.
    Meter &meter_interrupt(unsigned vector);
    uint64_t interrupt_cycles() const; // in metered interrupts, so far

    // ---- Pins: "porta0", "portc5", ... ----

    // Connects a voltage to a pin; returns its number for the calls below.
    unsigned analog_input(const std::string &pin);
    // The voltage whose conversion is this code, 0..1023, as on the real chip,
    // against a reference of 5 V. gpsim rounds where the chip truncates, so it
    // is in the middle of the code.
    void set_code(unsigned input, unsigned code);
    void set_volts(unsigned input, double volts); // 0..5; clamped

    // Watches a digital pin; returns its number for the calls below.
    unsigned probe(const std::string &pin);
    bool probe_level(unsigned probe) const;
    uint64_t probe_edges(unsigned probe) const;
    uint64_t probe_high_cycles(unsigned probe);       // since the last call
    void on_edge(unsigned probe, ValueAction action); // value: the new level

    // ---- UART: a PIC18's at "portc6" and "portc7", an AVR's USART0 ----

    // With each byte that the firmware hands to it.
    void on_send(ValueAction action);
    // A byte begins to arrive, one at a time: with so many cycles a bit, or of
    // an AVR's as fast as it is set.
    void receive(unsigned byte, unsigned cycles_a_bit);

    // ---- Simulator ----

    // What gpsim has printed since the last call; empty when all is well.
    std::string messages();
    // Instructions of the firmware that gpsim gets wrong, one line each.
    std::vector<std::string> lint() const;
    // Start-up code of SDCC's that clears RAM which a chip does not have: such
    // writes are let pass until this routine.
    void lenient_until(const std::string &routine);

    struct Implementation; // gpsim's side of it

  private:
    std::unique_ptr<Implementation> self;
};

#endif
