// SPDX-License-Identifier: MIT
// The functions of a port against its chip's pins and registers:
//
//   port FIRMWARE [CHECK]...
//
// with the firmware of driver_port.c, .cod of a PIC or .elf of an AVR; the
// linker chooses the simulator. All checks, or `start` and those that are
// named; `unfed` only by its name, since it ends with a reset as `watchdog`
// does. What is wrong is printed after the name of its check. Exit status: 0
// all is well, 1 something is not, 2 the run could not be made.
#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <set>

#include "chip.hh"

namespace
{

constexpr uint64_t turn_most = 30000; // cycles; longer than a tick's wait
constexpr unsigned codes = 1024;
constexpr unsigned duty_least = 4; // shorter pulses are not made
constexpr unsigned periods = 8;    // of the PWM, over which pins are watched
constexpr unsigned ticks_measured = 10000;
constexpr unsigned ticks_most = 255;
constexpr unsigned latest = 300; // cycles that an interrupt is masked for
constexpr unsigned looks = 10;   // cycles of a loop that waits for it
constexpr unsigned gie = 0x80;   // of INTCON, I of SREG
constexpr unsigned forced = 75;  // cycles in which an interrupt ends
constexpr double watchdog_apart = 0.05; // of its time, at most

// What port_board.h and the data sheet say of a board.
struct Board {
    unsigned vector, intcon;                 // or SREG: GIE is bit 7 of both
    std::pair<unsigned, unsigned> tick_flag; // register, bit
    uint64_t tick_cycles;
    uint64_t latency_spread; // cycles between the latest and the earliest
    uint64_t interrupt_cycles;
    std::vector<std::string> channels; // the pins of port_board.h's, in order
    unsigned (*duty_counts)(const Chip &chip);
    std::pair<unsigned, unsigned> direction; // register, bit
    unsigned full;                           // PORT_DRIVE_FULL
    uint64_t pwm_cycles;                     // a period
    unsigned counts_per_cycle;               // of the duty
    uint64_t off_before_turn; // cycles without drive before it changes
    std::string forward_pin, reverse_pin; // that carry the duty
    unsigned outputs;                     // register that makes pins outputs
    unsigned drive_inputs, drive_outputs; // its bits of the drive, as either
    std::pair<unsigned, unsigned> pwm_on; // register, value: the PWM's clock
    struct Pins {
        unsigned address, bits, value;
    };
    std::vector<Pins> others; // registers of the pins without a use
    uint64_t off_after_turn;  // cycles without drive after it changes
    // Both switches of a leg, whose direction the chip changes itself.
    std::vector<std::pair<std::string, std::string>> legs;
    // Cycles of a conversion, with the time to acquire: what the data sheet
    // asks for, and no more than a few instructions longer.
    uint64_t conversion_least, conversion_most;
    double watchdog; // seconds, in the simulator
    struct Working { // registers that an interrupt must leave as they were
        unsigned status, flags; // which of its bits are tried
        unsigned bank, banks;   // a register of the bank; 0: it is in STATUS
    } working;
    unsigned half_moved; // the first register of two that move the next tick
    std::vector<unsigned> duty; // registers that hold it, the last byte of each
    unsigned clock; // the register that doubles the clock after a reset, or 0
    // The register and bit that start a conversion, and those of its channel.
    std::pair<unsigned, unsigned> go, channel;
};

// CCPR1L and CCP1CON's low bits.
unsigned pic16_duty(const Chip &chip)
{
    return (chip.peek(0x13) << 2) | ((chip.peek(0x15) >> 4) & 3u);
}

unsigned pic18_duty(const Chip &chip)
{
    return (chip.peek(0xFBE) << 2) | ((chip.peek(0xFBD) >> 4) & 3u);
}

// OCR1A, of an inverted PWM.
unsigned avr_duty(const Chip &chip)
{
    return 1023u - chip.peek_u16(0x88);
}

const Board pic16f684 = {
    4,
    0x0B,
    {0x0C, 0x01},
    7812,
    8,
    23,
    {"porta0", "porta2", "portc0", "portc1"},
    pic16_duty,
    {0x15, 0x80},
    256,
    64,
    4,
    0,        // P1M1 waits for the end of the period itself
    "portc2", // P1D
    "portc4", // P1B
    0x87,
    0x3C,
    0,
    {0x12, 0x04},
    {{0x85, 0x32, 0}, {0x05, 0x32, 0}},
    120, // P1M1 changes at the end of one period, the duty at that of the next
    {{"portc5", "portc4"}, {"portc3", "portc2"}},
    120, // 32 of Timer0, and 11 TAD of 8
    165,
    17.9e-3,
    {0x03, 0x27, 0, 1},
    0,
    {0x13, 0x15},
    0x8F,
    {0x1F, 0x02},
    {0x1F, 0x1C}};

const Board pic18f4520 = {8,
                          0xFF2,
                          {0xFA1, 0x01},
                          10000,
                          8,
                          18,
                          {"porta0", "porta1", "porta2"},
                          pic18_duty,
                          {0xF8B, 0x01},
                          1023,
                          256,
                          4,
                          256,
                          "portc2", // CCP1
                          "portc2",
                          0xF94,
                          0x05,
                          0,
                          {0xFCA, 0x04},
                          {{0xF92, 0x38, 0},
                           {0xF89, 0x38, 0},
                           {0xF93, 0xFF, 0},
                           {0xF8A, 0xFF, 0},
                           {0xF94, 0xFA, 0},
                           {0xF8B, 0xFA, 0}},
                          256,
                          {},
                          128, // 4 TAD to acquire and 12 to convert, of 8
                          170,
                          4.5 * 32e-3, // gpsim 0.31 is slow here
                          {0xFD8, 0x1F, 0xFE0, 16},
                          0xFBB,
                          {0xFBE, 0xFBD},
                          0,
                          {0xFC2, 0x02},
                          {0xFC2, 0x3C}};

// The same pins, of which ANSEL has the analog ones, and another Timer2. Of the
// watchdog's postscaler gpsim takes the bits one place too low, 128 for 8.
const Board pic18f26k22 = [] {
    Board board = pic18f4520;
    board.pwm_on = {0xFBA, 0x04};
    board.others.insert(
        board.others.end(),
        {{0xF38, 0xFF, 0x07}, {0xF39, 0xFF, 0}, {0xF3A, 0xFF, 0}});
    board.half_moved = 0xF67;
    board.watchdog *= 16;
    return board;
}();

const Board atmega328p = {14 * 4,
                          0x5F,
                          {0x35, 0x02},
                          16000,
                          8,
                          38,
                          {"adc0", "adc1", "adc2"},
                          avr_duty,
                          {0x25, 0x01},
                          1023,
                          1024,
                          1,
                          1024,
                          "portb1", // OC1A
                          "portb1",
                          0x24,
                          0,
                          0x03,
                          {0x81, 0x09},
                          {{0x24, 0x3C, 0},
                           {0x25, 0x3E, 0x3C},
                           {0x27, 0x3F, 0},
                           {0x28, 0x3F, 0x38},
                           {0x2A, 0xFF, 0},
                           {0x2B, 0xFF, 0xFF},
                           // DIDR0: ADC0D to ADC2D, no digital input there.
                           {0x7E, 0x3F, 0x07}},
                          0, // simavr 1.6 does not wait for a period's end
                          {},
                          13 * 80, // 200 kHz, the most for 10 bits
                          1700,
                          32e-3,
                          {0x5F, 0x7F, 0, 1},
                          0,
                          {0x88},
                          0,
                          {0x7A, 0x40},
                          {0x7C, 0x0F}};

const Board &board_of(const Chip &chip)
{
    if (chip.processor() == "atmega328p") {
        return atmega328p;
    }
    if (chip.processor() == "p18f26k22") {
        return pic18f26k22;
    }
    return chip.is_pic18() ? pic18f4520 : pic16f684;
}

class Port
{
  public:
    explicit Port(const std::string &cod);
    // True if all is well.
    bool run(const std::vector<std::string> &names);

  private:
    void call(char function, uint64_t most = turn_most);
    void drive(int duty);
    unsigned duty_counts() const;
    bool reverse() const;
    bool modulated_pins_low() const;
    void wrong(const char *format, ...) __attribute__((format(printf, 2, 3)));
    void turned();
    void drive_pin_changed(unsigned level);
    void duty_written();
    void pins_become(unsigned outputs);
    void watch_leg(const std::string &one, const std::string &other);
    void interrupted();
    void tick();
    void force_tick();
    void returned();

    void start();
    void tick_period();
    void waits();
    void late_interrupts();
    void registers();
    void half_moved();
    void readings();
    void read_is(unsigned channel, unsigned expected);
    unsigned channel_bits() const;
    void conversion_ends();
    void duties();
    void duty_is(int asked);
    void pins();
    void pin_shows(int asked);
    void pwm_period();
    void turns_around();
    void ticks_saturate();
    void watchdog();
    void unfed();
    void reset_after(uint64_t cycles);

    struct Check {
        const char *name;
        void (Port::*run)();
        bool usual;
    };
    static const std::vector<Check> checks;

    Chip chip;
    const Board &board;
    const char *check = "start";  // that runs
    std::vector<unsigned> inputs; // of the channels
    unsigned forward, reverse_probe;
    Meter *interrupt, *conversion;
    bool started = false;
    bool was_reverse = false;
    uint64_t slow_cycles = 0; // before the clock was doubled
    uint64_t last_high = 0;   // cycle when a drive pin was on
    uint64_t turned_at = 0;   // cycle, or 0 when the drive was on since
    uint64_t off_before = 0;  // cycles without drive, at that turn
    uint64_t without_drive = UINT64_MAX;      // cycles at a turn, the least
    std::map<std::string, uint64_t> went_off; // cycles, by pin of a leg
    uint64_t leg_off = UINT64_MAX;            // cycles of a leg, the least
    uint64_t rising = 0, rises = 0; // of the drive's pin: cycle, and how many
    uint64_t pwm_started = 0;       // cycle; 0 before
    unsigned long turn_arounds = 0, errors = 0;
    uint64_t previous_tick = 0, first_tick = 0;
    uint64_t shortest = UINT64_MAX, longest = 0, ticks = 0;

    struct Registers {
        unsigned working, status, bank;
        bool operator!=(const Registers &other) const;
    };
    Registers found() const;
    void set(const Registers &values);
    bool trying = false, changed = false; // registers, at an interrupt
    Registers own = {}, tried = {}, given = {};
    unsigned groups = 0xFF;        // what a PIC18F4431's ADCHS was set to
    std::function<void()> at_half; // when the next tick has moved by half
    bool begun = false;            // a conversion, since port_read was called
    unsigned begun_with = 0;       // its channel then
};

Port::Port(const std::string &cod) : chip(cod), board(board_of(chip))
{
    if (chip.is_pic18()) {
        // A PIC18F4431's port_init writes to what a PIC18F4520 has not.
        chip.lenient_until(chip.has_symbol("ADCHS") ? "port_wait_tick"
                                                    : "main");
        chip.set_oscillator(40e6);
    }
    if (chip.has_symbol("ADCHS")) {
        chip.on_write(chip.data("ADCHS"),
                      [this](unsigned value) { groups = value; });
    }
    for (const std::string &pin : board.channels) {
        inputs.push_back(chip.analog_input(pin));
    }
    forward = chip.probe(board.forward_pin);
    reverse_probe = board.reverse_pin == board.forward_pin
                        ? forward
                        : chip.probe(board.reverse_pin);
    for (const unsigned probe : std::set<unsigned>{forward, reverse_probe}) {
        chip.on_edge(probe,
                     [this](unsigned level) { drive_pin_changed(level); });
    }
    for (const auto &[one, other] : board.legs) {
        watch_leg(one, other);
        watch_leg(other, one);
    }
    interrupt = &chip.meter_interrupt(board.vector);
    conversion = &chip.meter("port_read");
    chip.on_write(board.go.first, [this](unsigned value) {
        if ((value & board.go.second) != 0 && !begun) {
            begun = true;
            begun_with = channel_bits();
        }
    });
    conversion->on_call = [this] { begun = false; };
    conversion->on_return = [this](uint64_t) { conversion_ends(); };
    chip.on_execute(chip.code("main"), [this] { started = true; });
    chip.on_write(chip.data("turn"), [this](unsigned value) {
        if (started && value == 0) {
            chip.stop("the harness's turn");
        }
    });
    chip.on_write(board.direction.first, [this](unsigned) { turned(); });
    chip.on_write(board.pwm_on.first, [this](unsigned value) {
        if (value == board.pwm_on.second && pwm_started == 0) {
            pwm_started = chip.cycle();
        }
    });
    chip.on_write(board.outputs, [this](unsigned value) {
        if (started) {
            pins_become(value);
        }
    });
    chip.on_execute(board.vector, [this] { interrupted(); });
    interrupt->on_return = [this](uint64_t) { returned(); };
    if (board.clock != 0) {
        chip.on_write(board.clock,
                      [this](unsigned) { slow_cycles = chip.cycle(); });
    }
    for (const unsigned address : board.duty) {
        chip.on_write(address, [this](unsigned) { duty_written(); });
    }
    if (board.half_moved != 0) {
        chip.on_write(board.half_moved, [this](unsigned) {
            if (at_half) {
                at_half();
            }
        });
    }
}

void Port::wrong(const char *format, ...)
{
    va_list arguments;

    errors++;
    va_start(arguments, format);
    if (errors <= 10) {
        std::printf("%s: ", check);
        std::vprintf(format, arguments);
        std::puts("");
    }
    va_end(arguments);
}

// The chip's turn, until it ends.
void Port::call(char function, uint64_t most)
{
    chip.poke(chip.data("call"), static_cast<unsigned char>(function));
    chip.poke(chip.data("turn"), 1);
    chip.run(most);
    if (chip.stopped() != Stop::requested) {
        const std::string how =
            chip.stopped() == Stop::none ? "does not return" : chip.reason();
        throw ChipError(std::string(check) + ": port function " + function +
                        ": " + how);
    }
}

// Also takes the ticks, which keeps the watchdog quiet.
void Port::drive(int duty)
{
    call('t');
    chip.poke_u16(chip.data("duty"), static_cast<uint16_t>(duty));
    call('d');
}

unsigned Port::duty_counts() const
{
    return board.duty_counts(chip);
}

bool Port::reverse() const
{
    return (chip.peek(board.direction.first) & board.direction.second) != 0;
}

bool Port::modulated_pins_low() const
{
    return !chip.probe_level(forward) && !chip.probe_level(reverse_probe);
}

// At each change of direction the duty is 0 and was for a period.
void Port::turned()
{
    if (reverse() == was_reverse) {
        return;
    }
    was_reverse = reverse();
    turn_arounds++;
    if (duty_counts() != 0) {
        wrong("direction changed with a duty of %u", duty_counts());
    }
    if (!modulated_pins_low()) {
        wrong("direction changed with a drive pin on");
    }
    off_before = chip.cycle() - last_high;
    if (off_before < board.off_before_turn) {
        wrong("direction changed with %" PRIu64 " cycles without drive",
              off_before);
    }
    turned_at = chip.cycle();
}

// After a change of direction, too, nothing drives for a while; but for what
// the port takes to look.
void Port::drive_pin_changed(unsigned level)
{
    const uint64_t now = chip.cycle();

    last_high = now;
    if (level == 0) {
        return;
    }
    rising = now;
    rises++;
    if (turned_at == 0) {
        return;
    }
    without_drive = std::min(without_drive, off_before + now - turned_at);
    if (now - turned_at + looks + board.interrupt_cycles <
        board.off_after_turn) {
        wrong("drive %" PRIu64 " cycles after the direction changed",
              now - turned_at);
    }
    turned_at = 0;
}

// One switch of a leg goes on a period after the other went off.
void Port::watch_leg(const std::string &one, const std::string &other)
{
    uint64_t &off_since = went_off[other];

    chip.on_edge(chip.probe(other), [this, &off_since](unsigned level) {
        if (level == 0) {
            off_since = chip.cycle();
        }
    });
    chip.on_edge(chip.probe(one), [this, &off_since, one](unsigned level) {
        if (level == 0 || !started || off_since == 0) {
            return;
        }
        const uint64_t off = chip.cycle() - off_since;
        leg_off = std::min(leg_off, off);
        if (off < board.pwm_cycles) {
            wrong("%s goes on %" PRIu64 " cycles after the other of its leg",
                  one.c_str(), off);
        }
    });
}

// Pulses that are too short are not in the registers between two writes either.
void Port::duty_written()
{
    const unsigned counts = duty_counts();

    if (started && counts > 0 && counts < duty_least) {
        wrong("for a moment the duty is %u", counts);
    }
}

// The drive's pins become outputs when the PWM has run for a period, but for
// what the port takes to look, with no duty.
void Port::pins_become(unsigned outputs)
{
    const unsigned drive = board.drive_inputs | board.drive_outputs;

    if ((outputs & drive) == board.drive_inputs) {
        return;
    }
    if (duty_counts() != 0) {
        wrong("the drive's pins become outputs with a duty of %u",
              duty_counts());
    }
    if (pwm_started == 0 ||
        chip.cycle() - pwm_started + looks < board.pwm_cycles) {
        wrong("the drive's pins become outputs before a period of the PWM");
    }
}

void Port::interrupted()
{
    if (trying && !changed) {
        own = found();
        given = tried;
        set(given);
        changed = true;
    }
    tick();
}

// To the instruction that was interrupted.
void Port::returned()
{
    if (!changed) {
        return;
    }
    const Registers left = found();
    if (left != given) {
        wrong("an interrupt changes W, STATUS and bank from %02x, %02x, %x to "
              "%02x, %02x, %x",
              given.working, given.status, given.bank, left.working,
              left.status, left.bank);
    }
    set(own);
    changed = false;
}

void Port::tick()
{
    const uint64_t now = chip.cycle();

    if (ticks != 0 && now == previous_tick) {
        return; // a run ended just here, and the next one begins
    }
    if (ticks != 0) {
        shortest = std::min(shortest, now - previous_tick);
        longest = std::max(longest, now - previous_tick);
    } else {
        first_tick = now;
    }
    previous_tick = now;
    ticks++;
}

// In the loop that waits for a turn.
void Port::force_tick()
{
    chip.write(board.tick_flag.first,
               chip.peek(board.tick_flag.first) | board.tick_flag.second);
    chip.run(forced);
}

bool Port::Registers::operator!=(const Registers &other) const
{
    return working != other.working || status != other.status ||
           bank != other.bank;
}

Port::Registers Port::found() const
{
    return {chip.working(),
            chip.peek(board.working.status) & board.working.flags,
            board.working.bank == 0 ? 0 : chip.peek(board.working.bank)};
}

void Port::set(const Registers &values)
{
    const unsigned others =
        chip.peek(board.working.status) & ~board.working.flags;

    chip.set_working(values.working);
    if (board.working.bank != 0) {
        chip.write(board.working.bank, values.bank);
    }
    chip.write(board.working.status, others | values.status);
}

// Whatever W, the flags and the bank are when an interrupt comes, they are
// when it returns, and the tick was counted.
void Port::registers()
{
    unsigned long count = 0;
    uint64_t told = 0;

    call('t');
    const uint64_t before = ticks;
    for (unsigned working = 0; working < 256; working++) {
        unsigned status = 0;

        do {
            tried = {working, status,
                     static_cast<unsigned>(count) % board.working.banks};
            trying = true;
            force_tick();
            trying = false;
            count++;
            // The next subset of the flags.
            status = (status - board.working.flags) & board.working.flags;
        } while (status != 0);
        call('t');
        told += chip.peek(chip.data("ticks_told"));
    }
    if (told + 1 < ticks - before || told > ticks - before) { // one may be new
        wrong("%" PRIu64 " ticks are told as %" PRIu64, ticks - before, told);
    }
    std::printf("%lu states of W, STATUS and bank outlive an interrupt\n",
                count);
}

// With the next tick's time half moved a match may be found; it is no tick.
void Port::half_moved()
{
    if (board.half_moved == 0) {
        return;
    }
    call('w');
    const uint64_t before = ticks;
    at_half = [this] {
        at_half = nullptr;
        chip.write(board.tick_flag.first,
                   chip.peek(board.tick_flag.first) | board.tick_flag.second);
    };
    chip.run(board.tick_cycles + 100);
    if (at_half || ticks != before + 1) {
        wrong("%" PRIu64 " ticks come of one whose successor's time is "
              "half written",
              ticks - before);
    }
    std::printf("a match with half of the next tick's time is no tick\n");
}

// From power-on to the first call nothing drives.
void Port::start()
{
    const uint64_t edges = chip.probe_edges(forward);

    const unsigned drive = board.drive_inputs | board.drive_outputs;

    if ((chip.peek(board.outputs) & drive) != board.drive_inputs) {
        wrong("the drive's pins are outputs before port_init");
    }
    const uint64_t cycles = chip.run(10 * turn_most);
    if (chip.stopped() != Stop::requested) {
        throw ChipError("start: port_init does not return: " + chip.reason());
    }
    if ((chip.peek(board.outputs) & drive) != board.drive_outputs) {
        wrong("the drive's pins are no outputs after port_init");
    }
    if (duty_counts() != 0 || !modulated_pins_low() ||
        chip.probe_edges(forward) != edges) {
        wrong("the drive is not off after port_init");
    }
    for (const Board::Pins &pins : board.others) {
        const unsigned found = chip.peek(pins.address) & pins.bits;
        if (found != pins.value) {
            wrong("pins without a use: register 0x%02X has 0x%02X, not 0x%02X",
                  pins.address, found, pins.value);
        }
    }
    // Two bits each: GDSEL, GBSEL, GCSEL, GASEL. 0 is the first input of each
    // group, AN0 to AN3, which the channels of port_board.h count on.
    if (chip.has_symbol("ADCHS") && groups != 0) {
        wrong("ADCHS has 0x%02X, not 0x00: another input of a group", groups);
    }
    // Its converter wants some microseconds between ADON and GO.
    if (chip.has_symbol("ADCHS") && (chip.peek(board.go.first) & 1u) == 0) {
        wrong("the A/D converter is off after port_init");
    }
    std::printf("off after reset, and after port_init, %.1f ms\n",
                1000.0 * static_cast<double>(cycles + slow_cycles) /
                    chip.cycles_per_second());
}

// Other calls in between change the interrupt's latency, not its period.
void Port::tick_period()
{
    uint64_t told = 0;

    call('w'); // the first tick's phase is port_init's
    ticks = 0;
    while (ticks < ticks_measured + 1) {
        call('w');
        told += chip.peek(chip.data("ticks_told"));
        chip.poke(chip.data("channel"), 0);
        for (uint64_t count = 0; count < told % 7; count++) {
            call('r');
        }
    }
    const uint64_t all = previous_tick - first_tick;
    const uint64_t exact = (ticks - 1) * board.tick_cycles;
    const uint64_t off = all > exact ? all - exact : exact - all;
    std::printf("%" PRIu64 " ticks in %" PRIu64 " cycles, %" PRIu64 "..%" PRIu64
                " each\n",
                ticks - 1, all, shortest, longest);
    if (off > board.latency_spread) {
        wrong("ticks drift: %" PRIu64 " cycles expected", exact);
    }
    if (longest - shortest > 2 * board.latency_spread) {
        wrong("ticks are uneven");
    }
    if (told != ticks) {
        wrong("%" PRIu64 " ticks came, %" PRIu64 " were told", ticks, told);
    }
    std::printf("interrupt %" PRIu64 "..%" PRIu64 " cycles\n", interrupt->least,
                interrupt->most);
    if (interrupt->most != board.interrupt_cycles) {
        wrong("an interrupt takes %" PRIu64 " cycles, %" PRIu64 " expected",
              interrupt->most, board.interrupt_cycles);
    }
}

// A wait for many ticks ends with the last of them, and the watchdog, whose
// time is shorter than the longest, stays quiet.
void Port::waits()
{
    for (const unsigned wanted : {0u, 1u, 2u, 100u, ticks_most}) {
        const unsigned least = std::max(wanted, 1u);

        call('w'); // just after a tick
        ticks = 0;
        chip.poke(chip.data("channel"), wanted);
        call('n', (least + 2) * turn_most);
        if (ticks != least || chip.peek(chip.data("ticks_told")) != least) {
            wrong("a wait for %u ticks took %" PRIu64 " and told %u", wanted,
                  ticks, chip.peek(chip.data("ticks_told")));
        }
    }
    std::printf("waits end with their last tick\n");
}

// An application may mask the interrupt: that tick is late and the next is not.
void Port::late_interrupts()
{
    for (unsigned late = 0; late < latest; late++) {
        call('w');
        const uint64_t before = ticks;
        const uint64_t tick = previous_tick;
        chip.run(board.tick_cycles - 100 - (chip.cycle() - tick));
        chip.write(board.intcon, chip.peek(board.intcon) & ~gie);
        chip.run(100 + late);
        chip.write(board.intcon, chip.peek(board.intcon) | gie);
        chip.run(board.tick_cycles + 100 - late);
        const uint64_t two = previous_tick - tick;
        if (ticks != before + 2 ||
            two + board.latency_spread < 2 * board.tick_cycles ||
            two > 2 * board.tick_cycles + board.latency_spread) {
            wrong("after an interrupt %u cycles late, %" PRIu64
                  " ticks in %" PRIu64 " cycles",
                  late, ticks - before, two);
        }
        call('t');
        if (chip.peek(chip.data("ticks_told")) != 2) {
            wrong("with an interrupt %u cycles late, 2 ticks are told as %u",
                  late, chip.peek(chip.data("ticks_told")));
        }
    }
    std::printf("%u late interrupts\n", latest);
}

void Port::read_is(unsigned channel, unsigned expected)
{
    call('t');
    chip.poke(chip.data("channel"), channel);
    call('r');
    const unsigned got = chip.peek_u16(chip.data("reading"));
    if (got != expected) {
        wrong("channel %u reads %u at %u", channel, got, expected);
    }
}

unsigned Port::channel_bits() const
{
    return chip.peek(board.channel.first) & board.channel.second;
}

// A chip converts the channel that was chosen when the conversion began; simavr
// 1.6 and gpsim 0.31 accept a later choice.
void Port::conversion_ends()
{
    if (channel_bits() != begun_with) {
        wrong("a conversion began with channel bits 0x%02X, and they became "
              "0x%02X while it ran",
              begun_with, channel_bits());
    }
}

// Every code on every channel, with other codes on the others.
void Port::readings()
{
    unsigned long count = 0;

    for (unsigned channel = 0; channel < inputs.size(); channel++) {
        for (unsigned code = 0; code < codes; code++) {
            for (unsigned other = 0; other < inputs.size(); other++) {
                chip.set_code(inputs[other],
                              (code + 341 + 100 * other) % codes);
            }
            chip.set_code(inputs[channel], code);
            read_is(channel, code);
            count++;
        }
        for (const double volts : {0.0, 5.0}) {
            chip.set_volts(inputs[channel], volts);
            read_is(channel, volts > 0 ? codes - 1 : 0);
            count++;
        }
    }
    std::printf("%lu readings, %" PRIu64 "..%" PRIu64 " cycles each\n", count,
                conversion->least, conversion->most);
    if (conversion->least < board.conversion_least ||
        conversion->most > board.conversion_most) {
        wrong("a conversion takes %" PRIu64 "..%" PRIu64 " cycles",
              conversion->least, conversion->most);
    }
}

void Port::duty_is(int asked)
{
    const bool had_reverse = reverse();
    const unsigned magnitude =
        std::min(static_cast<unsigned>(std::abs(asked)), board.full);
    const unsigned made = magnitude < duty_least ? 0 : magnitude;
    const bool wanted = made == 0 ? had_reverse : asked < 0;

    drive(asked);
    if (duty_counts() != made) {
        wrong("drive %d: %u counts, %u expected", asked, duty_counts(), made);
    }
    if (reverse() != wanted) {
        wrong("drive %d: direction is %s", asked,
              reverse() ? "reverse" : "forward");
    }
}

void Port::duties()
{
    const int most = static_cast<int>(board.full) + 10;

    for (int duty = -most; duty <= most; duty++) {
        duty_is(duty);
    }
    for (int duty = 1; duty <= 32768; duty *= 2) { // each bit alone, and none
        for (const int near : {-duty, duty - 1, 1 - duty}) {
            duty_is(near);
        }
    }
    std::printf("%d duties in the registers\n", 2 * most + 1 + 16 * 3);
}

// gpsim shows whole cycles only at the pin.
void Port::pin_shows(int asked)
{
    const unsigned on = asked < 0 ? reverse_probe : forward;
    const unsigned other = asked < 0 ? forward : reverse_probe;
    const uint64_t expected = static_cast<uint64_t>(std::abs(asked)) /
                              board.counts_per_cycle * periods;

    drive(asked);
    chip.run(3 * board.pwm_cycles); // until it is at the pins
    chip.probe_high_cycles(on);
    chip.probe_high_cycles(other);
    const uint64_t edges = chip.probe_edges(on);
    chip.run(periods * board.pwm_cycles - 1); // it returns a cycle later
    const uint64_t high = chip.probe_high_cycles(on);
    if (high + periods < expected || high > expected + periods) {
        wrong("drive %d: pin high for %" PRIu64 " cycles, %" PRIu64 " expected",
              asked, high, expected);
    }
    const uint64_t changes = chip.probe_edges(on) - edges;
    if (expected > 0 && expected < periods * board.pwm_cycles &&
        (changes + 1 < 2 * periods || changes > 2 * periods + 1)) {
        wrong("drive %d: %" PRIu64 " edges in %u periods", asked, changes,
              periods);
    }
    if (other != on && chip.probe_high_cycles(other) != 0) {
        wrong("drive %d: the other direction's pin is on", asked);
    }
}

void Port::pins()
{
    unsigned long count = 0;

    for (unsigned quarter = 0; quarter <= board.full / 4; quarter++) {
        pin_shows(static_cast<int>(4 * quarter));
        pin_shows(-static_cast<int>(4 * quarter));
        count += 2;
    }
    std::printf("%lu duties at the pins\n", count);
    pwm_period();
}

// On the average: simavr's have one count more or less.
void Port::pwm_period()
{
    drive(static_cast<int>(board.full / 3));
    chip.run(3 * board.pwm_cycles);
    const uint64_t first = rising;
    rises = 0;
    chip.run(periods * board.pwm_cycles);
    const uint64_t period =
        rises == 0 ? 0 : (rising - first + rises / 2) / rises;
    std::printf("PWM %" PRIu64 " cycles, %" PRIu64 " counts, full drive %u\n",
                period, period * board.counts_per_cycle, board.full);
    if (period != board.pwm_cycles) {
        wrong("a period of the PWM has %" PRIu64 " cycles", period);
    }
}

// Any duty after any other; turned() looks on.
void Port::turns_around()
{
    uint32_t state = 1;

    for (unsigned count = 0; count < 2000; count++) {
        state = state * UINT32_C(1664525) + UINT32_C(1013904223);
        duty_is(static_cast<int>((state >> 16) % (2 * board.full + 1)) -
                static_cast<int>(board.full));
    }
    for (unsigned count = 0; count < 200; count++) { // with both at the pins
        drive(static_cast<int>(board.full) * (count % 2 == 0 ? 1 : -1));
        chip.run(3 * board.pwm_cycles + count);
    }
    std::printf("%lu changes of direction, %" PRIu64 " cycles without drive\n",
                turn_arounds, without_drive);
    if (turn_arounds < 500) {
        wrong("too few changes of direction");
    }
}

void Port::ticks_saturate()
{
    call('t');
    for (unsigned count = 0; count < ticks_most + 45; count++) {
        force_tick();
    }
    call('t');
    if (chip.peek(chip.data("ticks_told")) != ticks_most) {
        wrong("300 ticks are told as %u", chip.peek(chip.data("ticks_told")));
    }
    call('t');
    if (chip.peek(chip.data("ticks_told")) > 1) {
        wrong("ticks are told twice");
    }
    std::printf("ticks saturate at 255\n");
}

void Port::reset_after(uint64_t cycles)
{
    const double seconds =
        static_cast<double>(cycles) / chip.cycles_per_second();

    (void)chip.messages();
    std::printf("watchdog resets after %.1f ms\n", 1000.0 * seconds);
    if (chip.stopped() != Stop::fault ||
        chip.reason().find("watchdog") == std::string::npos) {
        wrong("the watchdog does not reset the chip");
    } else if (std::abs(seconds / board.watchdog - 1.0) > watchdog_apart) {
        wrong("the watchdog resets after %.1f ms", 1000.0 * seconds);
    }
}

// A loop that takes no ticks is reset.
void Port::watchdog()
{
    force_tick();
    call('t');
    const uint64_t fed = chip.cycle();
    chip.run(
        static_cast<uint64_t>(2 * board.watchdog * chip.cycles_per_second()));
    reset_after(chip.cycle() - fed);
}

// A loop that asks for ticks when none come is reset, too.
void Port::unfed()
{
    uint64_t calls = 0;

    force_tick();
    chip.write(board.intcon, chip.peek(board.intcon) & ~gie);
    call('t');
    const uint64_t fed = chip.cycle();
    const double most = 2 * board.watchdog * chip.cycles_per_second();
    try {
        while (static_cast<double>(chip.cycle() - fed) < most) {
            call('t');
            calls++;
            if (chip.peek(chip.data("ticks_told")) > 1) {
                wrong("ticks are told that did not come");
            }
        }
    } catch (const ChipError &) {
        // judged below
    }
    std::printf("%" PRIu64 " calls without a tick\n", calls);
    reset_after(chip.cycle() - fed);
}

const std::vector<Port::Check> Port::checks = {
    {"start", &Port::start, true}, // and before any other
    {"tick", &Port::tick_period, true},
    {"waits", &Port::waits, true},
    {"late", &Port::late_interrupts, true},
    {"half", &Port::half_moved, true},
    {"reading", &Port::readings, true},
    {"duty", &Port::duties, true},
    {"pins", &Port::pins, true},
    {"turning", &Port::turns_around, true},
    {"registers", &Port::registers, true},
    {"saturation", &Port::ticks_saturate, true},
    {"watchdog", &Port::watchdog, true},
    {"unfed", &Port::unfed, false},
};

bool Port::run(const std::vector<std::string> &names)
{
    size_t known = 0;

    for (const Check &one : checks) {
        const bool named =
            std::find(names.begin(), names.end(), one.name) != names.end();
        known += named ? 1 : 0;
        if (named || (names.empty() && one.usual) || &one == &checks.front()) {
            check = one.name;
            (this->*one.run)();
        }
    }
    if (known != names.size()) {
        throw ChipError("no such check");
    }
    const std::string printed = chip.messages();
    if (!printed.empty()) {
        check = "the simulator"; // so that no named check seems to have failed
        wrong("%s", printed.c_str());
    }
    std::printf("%s port errors %lu\n", chip.processor().c_str(), errors);
    return errors == 0;
}

} // namespace

int main(int argc, char *argv[])
{
    try {
        if (argc < 2) {
            throw ChipError("usage: port FIRMWARE [CHECK]...");
        }
        return Port(argv[1]).run({argv + 2, argv + argc}) ? EXIT_SUCCESS
                                                          : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
