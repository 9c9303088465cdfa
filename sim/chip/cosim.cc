// SPDX-License-Identifier: MIT
// Runs a firmware on its simulated chip, in closed loop with a simulated world.
//
// The options and the trace are those of the host's program, whose main this
// one calls. The world is asked for a voltage when a conversion starts, and it
// moves on to that moment first, as it does when the drive changes; so both
// programs draw the same noise for the same conversion.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "board.hh"
#include "chip.hh"
#include "port_board.h"

extern "C" {
#include "faults.h"
#include "host.h"
#include "probe.h"
#include "world.h"

int host_main(int count, char **arguments); // main of host_main.c, renamed
}

namespace
{

constexpr double tick_s = 1.0 / PORT_TICKS_PER_SECOND;
constexpr double hang_s = 0.5; // the loop has to come round this often
constexpr unsigned adc_codes = 1024;
constexpr uint64_t jump_cycles = 8; // longer than any instruction

// Where a recorded value means that the plant is lost.
struct Bound {
    const char *name;
    double magnitude;
    const char *meaning;
};
const Bound bounds[] = {
    {"angle_degrees", 89.0, "the pendulum lies on the floor"},
    {"base_m", 1000.0, "the pendulum's base has run away"},
    {"speed_rad_s", 2000.0, "the motor has run away"},
    {"temperature_c", 1000.0, "the oven is burning"},
};

// What the command line asks for.
std::string firmware;
std::vector<std::string> metered;
bool every_instruction = false; // those of the loop that waits, too
uint32_t seed = 1;
FILE *trace = nullptr;
double trace_period_s = tick_s;
bool faulty = false; // the loop is broken on purpose

// Where a bit flips that is not the object's: bytes, or a stack's, which are
// from above its pointer to its end.
struct Place {
    std::vector<unsigned> bytes;
    unsigned pointer = 0;
    unsigned end = 0;
} place;
constexpr unsigned working = 0xFFFF; // the address of a PIC16's W

// The loop of the application: from the return of the port's function
// that it calls for ticks to its next call.
struct Pass {
    bool begun = false;
    double ready_s = -1.0; // when the first of them was called
    uint64_t start = 0;
    double ended_s = 0.0;
    uint64_t count = 0;
    uint64_t least = UINT64_MAX;
    uint64_t most = 0;
    uint64_t total = 0;
    uint64_t shown = 0; // the longest of a row, or the last before it
    bool row_has_one = false;
};

class Cosimulation
{
  public:
    Cosimulation();
    int run();

  private:
    void look();
    void obey(const fault_order &order);
    void flip(unsigned bit);
    void flip_as_wanted();
    void hang();
    void stop_timer();
    void shift_ticks(double ticks);
    void take_drive();
    bool goes_on();
    void set_tick(bool enabled);
    void stand_still(double seconds);
    void randomize();
    void hang_here();
    void reset_chip();
    void reset_as_wanted();
    void watch_bounds();
    void wire_converter();
    void wire_drive();
    void watch_loop();
    void wait_begins();
    void copy_objects();
    void wait_ends();
    void catch_up();
    void check_world();
    void trace_row();
    void summary(double wall_s) const;

    Chip chip;
    double cycles_per_second;
    uint64_t seen = 0; // cycle up to which the world has moved
    double rows = 0.0;
    int drive_counts = 0;
    Pass pass;
    std::map<unsigned, unsigned> inputs; // of the chip, by channel
    std::vector<const Meter *> meters;
    std::vector<const Meter *> interrupts;
    std::vector<std::pair<size_t, Bound>> watched; // by index in the trace
    std::vector<unsigned> objects; // of the application, their addresses

    // What the chip is stopped for.
    enum class Wanted { nothing, reset, hang, flip } wanted = Wanted::nothing;
    bool looking = false;
    bool resetting = false; // it is at the reset vector, or will be
    double dark_s = 0.0;
    bool random_ram = false;
    double share_of_pass = 0.0; // when a reset comes
    double share_of_tick = 0.0; // when a bit of a place flips
    unsigned bit_of_place = 0;
    double ticks_ahead = 0.0;
    uint64_t masked_until = 0; // the tick's interrupt; 0: it is not masked
};

// Where the tick's interrupt is enabled: TMR1IE of a PIC16, CCP2IE of a PIC18,
// OCIE0A of an AVR.
struct Enable {
    const char *processor; // how its name begins
    unsigned address;
    unsigned bit;
    unsigned counted; // the port's byte of ticks, where it has no symbol
};
const Enable enables[] = {{"p16", 0x8C, 0x01, 0x20},
                          {"p18", 0xFA0, 0x01, 0},
                          {"atmega", 0x6E, 0x02, 0}};

const Enable &tick_enable(const Chip &chip)
{
    for (const Enable &enable : enables) {
        if (chip.processor().rfind(enable.processor, 0) == 0) {
            return enable;
        }
    }
    throw ChipError("no interrupt known of " + chip.processor());
}

Cosimulation::Cosimulation() : chip(firmware, board.processor)
{
    if (board.oscillator_hz > 0.0) {
        chip.set_oscillator(board.oscillator_hz);
    }
    if (chip.is_pic18()) {
        chip.lenient_until("main"); // SDCC's start-up clears all that could be
    }
    cycles_per_second = chip.cycles_per_second();
    const std::vector<std::string> findings = chip.lint();
    if (!findings.empty()) {
        throw ChipError("gpsim would get this firmware wrong: " + findings[0]);
    }
    watch_bounds();
    for (size_t i = 0; i < probe_object_count; i++) {
        objects.push_back(chip.data(probe_objects[i].name));
    }
    place.bytes.erase(std::remove_if(place.bytes.begin(), place.bytes.end(),
                                     [this](unsigned at) {
                                         return at >= objects[0] &&
                                                at < objects[0] +
                                                         probe_objects[0].size;
                                     }),
                      place.bytes.end());
    for (const std::string &name : metered) {
        meters.push_back(&chip.meter(name));
    }
    for (const unsigned vector : board.interrupt_vectors) {
        interrupts.push_back(&chip.meter_interrupt(vector));
    }
    wire_converter();
    wire_drive();
    watch_loop();
    chip.every(board.step_cycles, [this] { catch_up(); });
}

void Cosimulation::watch_bounds()
{
    size_t count = 0;
    const char *const *const names = world_trace_names(&count);
    for (size_t i = 0; i < count; i++) {
        for (const Bound &bound : bounds) {
            if (std::strcmp(names[i], bound.name) == 0) {
                watched.emplace_back(i, bound);
            }
        }
    }
}

void Cosimulation::wire_converter()
{
    for (const AnalogPin &wire : board.analog_pins) {
        inputs[wire.channel] = chip.analog_input(wire.pin);
    }
    chip.on_write(board.converter_register, [this](unsigned control) {
        if ((control & board.converter_go) == 0) {
            return;
        }
        catch_up();
        const unsigned channel = board_channel(chip, control);
        if (channel == board.ground_channel) {
            return; // not of the world
        }
        const double fraction = world_voltage((uint8_t)channel);
        const auto input = inputs.find(channel);
        if (input == inputs.end()) {
            chip.fail("a conversion of channel " + std::to_string(channel) +
                      ", which is not wired");
        } else {
            chip.set_code(input->second, (unsigned)(fraction * adc_codes));
        }
    });
}

void Cosimulation::wire_drive()
{
    for (const unsigned address : board.drive_registers) {
        chip.on_write(address, [this](unsigned) {
            catch_up();
            take_drive();
        });
    }
}

void Cosimulation::take_drive()
{
    drive_counts = board_drive_counts(chip);
    world_drive((double)drive_counts / PORT_DRIVE_FULL);
}

void Cosimulation::watch_loop()
{
    Meter &wait = chip.meter(probe_wait);
    wait.on_return = [this](uint64_t) { wait_ends(); };
    wait.on_call = [this] { wait_begins(); };
    if (!every_instruction) {
        chip.skip_waiting("port_wait_tick");
    }
}

void Cosimulation::wait_begins()
{
    if (!pass.begun) {
        catch_up();
        pass.ready_s = world_time_s();
        return;
    }
    const uint64_t cycles = chip.cycle() - pass.start;
    pass.count++;
    pass.total += cycles;
    pass.least = std::min(pass.least, cycles);
    pass.most = std::max(pass.most, cycles);
    pass.shown = pass.row_has_one ? std::max(pass.shown, cycles) : cycles;
    pass.row_has_one = true;
    copy_objects(); // between two steps, so never half of one
}

void Cosimulation::copy_objects()
{
    for (size_t i = 0; i < objects.size(); i++) {
        auto *const bytes =
            static_cast<unsigned char *>(probe_objects[i].bytes);
        for (unsigned j = 0; j < probe_objects[i].size; j++) {
            bytes[j] = (unsigned char)chip.peek(objects[i] + j);
        }
    }
}

void Cosimulation::wait_ends()
{
    pass.begun = true;
    pass.start = chip.cycle();
    pass.ended_s = world_time_s();
    if (wanted == Wanted::reset) {
        chip.stop("a reset");
    }
}

// The world moves to this cycle, and to each row of the trace on the way.
void Cosimulation::catch_up()
{
    const double seconds = (double)(chip.cycle() - seen) / cycles_per_second;
    const double end_s = world_time_s() + seconds;
    seen = chip.cycle();
    cycles_per_second = chip.cycles_per_second(); // from here on
    while ((trace != nullptr) && (rows * trace_period_s <= end_s)) {
        world_advance(std::fmax(rows * trace_period_s - world_time_s(), 0.0));
        trace_row();
        rows += 1.0;
    }
    world_advance(std::fmax(end_s - world_time_s(), 0.0));
    if (faulty) {
        look();
        return;
    }
    check_world();
    if (world_time_s() - pass.ended_s > hang_s) {
        chip.fail("the loop does not come round");
    }
    if (!world_running()) {
        chip.stop("the scenario is over");
    }
}

// ---- Faults ----

void Cosimulation::look()
{
    if (looking) {
        return;
    }
    looking = true;
    if ((masked_until != 0) && (chip.cycle() >= masked_until)) {
        set_tick(true);
        masked_until = 0;
    }
    obey(faults_watch(drive_counts, drive_counts, 0)); // a chip has no guard
    looking = false;
}

void Cosimulation::obey(const fault_order &order)
{
    switch (order.deed) {
    case FAULT_FLIP_BIT:
        flip(order.bit);
        break;
    case FAULT_FLIP_BIT_OF_PLACE: // at an instruction boundary, too
        wanted = Wanted::flip;
        share_of_tick = order.share;
        bit_of_place = order.bit;
        chip.stop("a bit is to flip");
        break;
    case FAULT_RESET_CHIP: // at an instruction boundary within the next pass
        wanted = Wanted::reset;
        dark_s = order.seconds;
        random_ram = order.random_ram;
        share_of_pass = order.share;
        break;
    case FAULT_HANG_LOOP: // its own watchdog ends it
        hang();
        break;
    case FAULT_STOP_TIMER:
        stop_timer();
        break;
    case FAULT_SHIFT_TICKS:
        shift_ticks(order.ticks);
        break;
    default:
        break;
    }
}

void Cosimulation::flip(unsigned bit)
{
    const unsigned address = objects[0] + bit / 8;
    chip.poke(address, chip.peek(address) ^ (1u << (bit % 8)));
}

void Cosimulation::flip_as_wanted()
{
    (void)chip.run((uint64_t)(share_of_tick * tick_s * cycles_per_second));
    catch_up();
    wanted = Wanted::nothing;
    std::vector<unsigned> bytes = place.bytes;
    if (place.pointer != 0) {
        const unsigned top = chip.peek_u16(place.pointer);
        for (unsigned at = std::min(top + 1, place.end); at <= place.end;
             at++) {
            bytes.push_back(at);
        }
    }
    const unsigned at = bytes.at(bit_of_place / 8 % bytes.size());
    const unsigned bit = 1u << (bit_of_place % 8);
    if (at == working) {
        chip.set_working(chip.working() ^ bit);
        return;
    }
    const unsigned value = chip.peek(at) ^ bit;
    chip.poke(at, value);
    chip.write(at, value); // what the simulator derives from it
}

void Cosimulation::hang()
{
    wanted = Wanted::hang;
    chip.stop("the loop is to hang");
}

// An AVR's flag waits by itself; gpsim looks at a PIC's when it is enabled.
void Cosimulation::set_tick(bool enabled)
{
    const Enable &enable = tick_enable(chip);
    const unsigned others = chip.peek(enable.address) & ~enable.bit;
    const unsigned value = others | (enabled ? enable.bit : 0u);
    chip.poke(enable.address, value);
    chip.write(enable.address, value);
}

void Cosimulation::stop_timer()
{
    set_tick(false);
}

// Whole ticks are counted or not; a tick is late where its interrupt is masked.
void Cosimulation::shift_ticks(double ticks)
{
    const double step = ticks - ticks_ahead;
    const double whole = std::round(step);
    if (std::fabs(step - whole) < 1e-9) {
        const unsigned counted = chip.has_symbol("ticks_counted")
                                     ? chip.data("ticks_counted")
                                     : tick_enable(chip).counted;
        chip.poke(counted, (chip.peek(counted) + (unsigned)(int)whole) & 0xFF);
        ticks_ahead = ticks;
    } else {
        stop_timer();
        masked_until = chip.cycle() +
                       (uint64_t)(-ticks * tick_s * chip.cycles_per_second());
    }
}

// The world goes on without the chip, whose drive is off.
void Cosimulation::stand_still(double seconds)
{
    const double end_s = world_time_s() + seconds;
    drive_counts = 0;
    world_drive(0.0);
    while (world_time_s() < end_s) {
        world_advance(std::fmin(end_s - world_time_s(), tick_s / 4.0));
        look();
    }
}

void Cosimulation::randomize()
{
    chip.fill_ram(faults_random() & 0xFFu);
    for (unsigned i = 0; i < probe_objects[0].size; i++) {
        chip.poke(objects[0] + i, faults_random() & 0xFFu);
    }
}

void Cosimulation::hang_here()
{
    unsigned at = 0;
    wanted = Wanted::nothing;
    do {
        at = chip.program_counter();
        chip.hang();
        (void)chip.run(jump_cycles);
    } while (chip.program_counter() != at);
}

// From the pins, as after power-on, but for the RAM.
void Cosimulation::reset_chip()
{
    chip.reset();
    resetting = true;
    seen = chip.cycle();
    if (chip.is_pic18()) {
        chip.lenient_until("main");
    }
    masked_until = 0;
    ticks_ahead = 0.0;
    stand_still(0.0);
    look(); // the drive is off
}

void Cosimulation::reset_as_wanted()
{
    (void)chip.run((uint64_t)(share_of_pass * (double)pass.most));
    catch_up();
    wanted = Wanted::nothing;
    reset_chip();
    stand_still(dark_s);
    if (random_ram) {
        randomize();
    }
}

// True if the chip has stopped for a fault of the loop, and runs on. gpsim says
// that it is at the reset vector after each reset, and may do so after its
// watchdog's, too.
bool Cosimulation::goes_on()
{
    const bool vector = chip.reason() == "restarted at the reset vector";
    const bool watchdog = chip.reason().find("watchdog") != std::string::npos;
    if (wanted == Wanted::hang) {
        hang_here();
    } else if (wanted == Wanted::flip) {
        flip_as_wanted();
    } else if (wanted == Wanted::reset) {
        reset_as_wanted();
    } else if (vector && resetting) {
        resetting = false;
    } else if (watchdog || vector) {
        reset_chip();
        faults_was_reset();
    } else {
        return false;
    }
    return true;
}

void Cosimulation::check_world()
{
    double values[WORLD_TRACE_MAX];
    world_trace(values);
    for (const auto &[i, bound] : watched) {
        if (!std::isfinite(values[i])) {
            chip.fail(std::string("the plant diverged: ") + bound.name +
                      " is not a number");
        } else if (std::fabs(values[i]) > bound.magnitude) {
            chip.fail(std::string(bound.meaning) + ": " + bound.name + " " +
                      std::to_string(values[i]));
        }
    }
}

void Cosimulation::trace_row()
{
    double values[WORLD_TRACE_MAX];
    size_t count = 0;
    host_terms terms = {0.0, 0.0, 0.0, 0.0};

    (void)world_trace_names(&count);
    world_trace(values);
    host_probe(&terms);
    (void)std::fprintf(trace, "%.6f", world_time_s());
    for (size_t i = 0; i < count; i++) {
        (void)std::fprintf(trace, ",%.9g", values[i]);
    }
    (void)std::fprintf(trace, ",%d,%.6g,%.6g,%.6g,%.6g,%llu\n", drive_counts,
                       terms.proportional, terms.integral, terms.derivative,
                       terms.accumulated_error, (unsigned long long)pass.shown);
    pass.row_has_one = false;
}

double mean(uint64_t total, uint64_t count)
{
    return (count > 0) ? (double)total / (double)count : 0.0;
}

void print_meter(const char *what, const Meter &meter)
{
    std::printf("%s %s: %llu calls, %llu to %llu cycles, mean %.1f\n", what,
                meter.name.c_str(), (unsigned long long)meter.calls,
                (unsigned long long)((meter.calls > 0) ? meter.least : 0),
                (unsigned long long)meter.most, mean(meter.total, meter.calls));
}

void Cosimulation::summary(double wall_s) const
{
    const double tick_cycles = chip.cycles_per_second() * tick_s;
    std::printf("simulated: %.3f s on a %s, %.1f times real time\n",
                world_time_s(), chip.processor().c_str(),
                world_time_s() / wall_s);
    std::printf("ready: %.6f s after power-on\n", pass.ready_s);
    std::printf("loop: %llu passes, %llu to %llu cycles, mean %.1f\n",
                (unsigned long long)pass.count,
                (unsigned long long)((pass.count > 0) ? pass.least : 0),
                (unsigned long long)pass.most, mean(pass.total, pass.count));
    std::printf("share of a tick: worst %.1f %%, mean %.1f %%\n",
                100.0 * (double)pass.most / tick_cycles,
                100.0 * mean(pass.total, pass.count) / tick_cycles);
    for (const Meter *meter : meters) {
        print_meter("routine", *meter);
    }
    for (const Meter *meter : interrupts) {
        print_meter("interrupt", *meter);
    }
    std::printf("return stack: %u %s\n", chip.stack_most(),
                chip.stack_unit().c_str());
}

int Cosimulation::run()
{
    const auto start = std::chrono::steady_clock::now();
    world_start(seed);
    // Far beyond any scenario, which ends by itself.
    do {
        (void)chip.run(uint64_t{1} << 50);
    } while (faulty && goes_on());
    const std::chrono::duration<double> wall =
        std::chrono::steady_clock::now() - start;
    std::string trouble;
    if (chip.stopped() != Stop::requested) {
        trouble = chip.reason();
    } else {
        trouble = chip.messages();
    }
    summary(wall.count());
    if (!trouble.empty()) {
        (void)std::fprintf(stderr, "%s: %.6f s, cycle %llu: %s\n",
                           firmware.c_str(), world_time_s(),
                           (unsigned long long)chip.cycle(), trouble.c_str());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}

constexpr int exit_wrong_use = 2;

// "20-21,3a" or "stack:5d:8ff", in hexadecimal; without the object's bytes.
void read_place(const std::string &text)
{
    if (std::sscanf(text.c_str(), "stack:%x:%x", &place.pointer, &place.end) ==
        2) {
        return;
    }
    std::istringstream ranges(text);
    for (std::string range; std::getline(ranges, range, ',');) {
        unsigned first = 0;
        unsigned last = 0;
        if (std::sscanf(range.c_str(), "%x-%x", &first, &last) < 2) {
            last = first;
        }
        for (unsigned at = first; at <= last; at++) {
            place.bytes.push_back(at);
        }
    }
}

// FIRMWARE --faults NAME FIRST COUNT [KIND | place BYTES]
int break_loop(const std::vector<std::string> &words)
{
    int kind = (int)FAULT_KINDS;
    if ((words.size() < 3) ||
        ((words.size() > 3) && !faults_kind(words[3].c_str(), &kind)) ||
        ((kind == (int)FAULT_FLIP_PLACE) != (words.size() == 5))) {
        return exit_wrong_use;
    }
    if (kind == (int)FAULT_FLIP_PLACE) {
        read_place(words[4]);
    }
    faulty = true;
    faults_plan(words[0].c_str(), (unsigned)(8 * probe_objects[0].size),
                std::strtol(words[1].c_str(), nullptr, 10),
                std::strtol(words[2].c_str(), nullptr, 10), kind);
    faults_heading();
    return application_main();
}

void help(const char *program)
{
    std::printf("usage: %s FIRMWARE [--meter ROUTINE]... [option]...\n"
                "Runs a firmware, .cod of a PIC or .elf of an AVR, on its "
                "simulated chip, in its\nsimulated world.\n\n"
                "  --meter ROUTINE   measure a routine's cycles\n"
                "  --every-instruction   simulate the waiting for a tick, "
                "too: slower, and\n"
                "                    the same\n"
                "  --faults NAME FIRST COUNT [KIND | place BYTES]   alone: "
                "break the loop,\n"
                "                    ../faults/faults.h\n\n"
                "The other options, the seed's effect and the trace are those "
                "of the host's program;\n"
                "the trace has one more column, the cycles of the longest "
                "pass of the loop:\n\n",
                program);
}

} // namespace

// ---- What host_main.c calls instead of the host port ----

void host_seed(uint32_t value)
{
    seed = value;
}

bool host_trace_open(const char *path, double period_s)
{
    size_t count = 0;
    const char *const *const names = world_trace_names(&count);

    trace = std::fopen(path, "w");
    if (trace == nullptr) {
        return false;
    }
    trace_period_s = period_s;
    (void)std::fprintf(trace, "time_s");
    for (size_t i = 0; i < count; i++) {
        (void)std::fprintf(trace, ",%s", names[i]);
    }
    (void)std::fprintf(trace, ",drive_counts,proportional,integral,derivative,"
                              "accumulated_error,pass_cycles\n");
    return true;
}

bool host_trace_close(void)
{
    if (trace == nullptr) {
        return true;
    }
    const bool failed = std::ferror(trace) != 0;
    return (std::fclose(trace) == 0) && !failed;
}

int application_main(void)
{
    try {
        Cosimulation one;
        return one.run();
    } catch (const ChipError &error) {
        (void)std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
}

int main(int count, char **arguments)
{
    std::vector<char *> rest = {arguments[0]};
    if ((count < 2) || (std::strcmp(arguments[1], "--help") == 0)) {
        help(arguments[0]);
        if (count < 2) {
            return exit_wrong_use;
        }
        return host_main(count, arguments);
    }
    firmware = arguments[1];
    if ((count > 2) && (std::strcmp(arguments[2], "--faults") == 0)) {
        return break_loop({arguments + 3, arguments + count});
    }
    for (int i = 2; i < count; i++) {
        if ((std::strcmp(arguments[i], "--meter") == 0) && (i + 1 < count)) {
            i++;
            metered.emplace_back(arguments[i]);
        } else if (std::strcmp(arguments[i], "--every-instruction") == 0) {
            every_instruction = true;
        } else {
            rest.push_back(arguments[i]);
        }
    }
    return host_main((int)rest.size(), rest.data());
}
