// SPDX-License-Identifier: MIT
// The Chip of ../chip/chip.hh, simulated by simavr 1.6: an ATmega328P.
//
// simavr runs one instruction at a time and says nothing of what it wrote, so
// the addresses of stores are decoded here. What a PIC has and an AVR has not
// is left out: who calls it is not linked. Time is CPU cycles, and the return
// stack is in RAM, in bytes. simavr enters an interrupt in no time.
#include "chip.hh"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <map>
#include <unistd.h>

#include <simavr/avr_adc.h>
#include <simavr/avr_eeprom.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_core.h>
#include <simavr/sim_elf.h>

namespace
{

constexpr const char *usual = "atmega328p";
constexpr uint32_t usual_hz = 16000000;
constexpr uint32_t data_offset = 0x800000; // of the linker's data addresses
constexpr unsigned millivolts = 5000;      // supply and reference
constexpr unsigned codes_most = 1023;
constexpr unsigned sreg_bits = 8;
constexpr unsigned working_register = 24;

// What simavr says where a timer is set that has no clock yet.
constexpr const char *stands_still = "avr_timer_write_ocr";

// Of the timer that drives.
constexpr unsigned tccr1a = 0x80, ocr1al = 0x88, inverted = 0xC0, top = 1023;

// What an instruction is to the wrapper.
constexpr uint8_t stores = 1, returns = 2, begins = 4;

std::string printed; // simavr's logger knows no chip of ours

void log_message(avr_t *, const int level, const char *format, va_list ap)
{
    char text[256];

    if (level == LOG_ERROR || level == LOG_WARNING) {
        (void)std::vsnprintf(text, sizeof text, format, ap);
        if (std::strstr(text, stands_still) == nullptr) {
            printed += text;
        }
    }
}

bool is_store(unsigned opcode)
{
    return (opcode & 0xD200) == 0x8200 || // STD Y+q, Z+q
           ((opcode & 0xFE00) == 0x9200 && (opcode & 0x000F) != 0x000F) ||
           (opcode & 0xF800) == 0xB800 || // OUT
           (opcode & 0xFD00) == 0x9800;   // CBI, SBI
}

bool is_return(unsigned opcode)
{
    return (opcode & 0xFFEF) == 0x9508; // RET, RETI
}

struct Probe {
    avr_t *avr = nullptr;
    bool level = false;
    uint64_t edges = 0;
    uint64_t high = 0; // cycles, up to `since`
    uint64_t since = 0;
    std::vector<Chip::ValueAction> actions;

    void look()
    {
        if (level) {
            high += avr->cycle - since;
        }
        since = avr->cycle;
    }
};

// With OCR1A at TOP an inverted fast PWM is constantly low, as the data sheet
// says: the match is ignored. simavr 1.6 has it after the period's end.
bool never_rises(const Probe &probe)
{
    const uint8_t *const data = probe.avr->data;

    return (data[tccr1a] & inverted) == inverted &&
           data[ocr1al] == (top & 0xFF) && data[ocr1al + 1] == (top >> 8);
}

void pin_changed(avr_irq_t *, uint32_t value, void *param)
{
    Probe &probe = *static_cast<Probe *>(param);
    const bool level = (value & 1u) != 0 && !never_rises(probe);

    if (level == probe.level) {
        return;
    }
    probe.look();
    probe.level = level;
    probe.edges++;
    for (const Chip::ValueAction &action : probe.actions) {
        action(level ? 1 : 0);
    }
}

struct Periodic {
    uint64_t next, period;
    Chip::Action action;
};

// A call of a metered routine that has not returned.
struct Frame {
    Meter *meter;
    uint64_t start;
    uint64_t interrupts; // their cycles so far
    unsigned stack;
    bool interrupt;
};

} // namespace

struct Chip::Implementation {
    avr_t *avr = nullptr;
    elf_firmware_t firmware = {};
    avr_run_t ordinary = nullptr;
    std::string name;
    std::map<std::string, uint32_t> symbols;
    std::vector<uint8_t> kinds; // by word of the program
    std::multimap<unsigned, Action> executes;
    std::multimap<unsigned, ValueAction> writes;
    std::vector<bool> watched; // addresses of `writes`
    std::vector<Periodic> periodics;
    uint64_t next_periodic = UINT64_MAX;
    std::vector<std::unique_ptr<Meter>> meters;
    std::vector<Frame> frames;
    std::vector<std::unique_ptr<Probe>> probes;
    std::vector<std::unique_ptr<ValueAction>> sends;
    uint64_t in_interrupts = 0;
    unsigned lowest_stack = 0;
    Stop stop = Stop::none;
    std::string reason;

    unsigned opcode(unsigned address) const
    {
        return avr->flash[address] | ((unsigned)avr->flash[address + 1] << 8);
    }
    unsigned pointer(unsigned low) const
    {
        return avr->data[low] | ((unsigned)avr->data[low + 1] << 8);
    }
    unsigned stored_at(unsigned pc) const;
    uint32_t symbol(const std::string &wanted, bool data) const;
    Meter &meter_at(unsigned address, const std::string &called,
                    bool interrupt);
    void one();
    void act_before(unsigned pc);
    void act_after(unsigned address);
    void pop_frames(unsigned stack);
    void look_at_time();
    void ends(Stop how, const std::string &why);
};

// Where the store at pc writes to, before it does.
unsigned Chip::Implementation::stored_at(unsigned pc) const
{
    const unsigned code = opcode(pc);

    if ((code & 0xF800) == 0xB800) { // OUT
        return AVR_IO_TO_DATA(((code >> 5) & 0x30) | (code & 0x0F));
    }
    if ((code & 0xFD00) == 0x9800) { // CBI, SBI
        return AVR_IO_TO_DATA((code >> 3) & 0x1F);
    }
    if ((code & 0xD200) == 0x8200) { // STD
        const unsigned q =
            ((code >> 8) & 0x20) | ((code >> 7) & 0x18) | (code & 7);
        return pointer((code & 8) != 0 ? R_YL : R_YL + 2) + q;
    }
    switch (code & 0x0F) {
    case 0x0: // STS
        return opcode(pc + 2);
    case 0x1: // ST Z+
        return pointer(R_YL + 2);
    case 0x2: // ST -Z
        return pointer(R_YL + 2) - 1;
    case 0x9: // ST Y+
        return pointer(R_YL);
    case 0xA: // ST -Y
        return pointer(R_YL) - 1;
    case 0xC: // ST X
    case 0xD: // ST X+
        return pointer(R_XL);
    case 0xE: // ST -X
        return pointer(R_XL) - 1;
    default:
        return 0; // what this core has not
    }
}

void Chip::Implementation::ends(Stop how, const std::string &why)
{
    if (stop == Stop::none) {
        stop = how;
        reason = why;
    }
}

void Chip::Implementation::act_before(unsigned pc)
{
    const auto range = executes.equal_range(pc);
    for (auto at = range.first; at != range.second; ++at) {
        at->second();
    }
}

void Chip::Implementation::act_after(unsigned address)
{
    const auto range = writes.equal_range(address);
    for (auto at = range.first; at != range.second; ++at) {
        at->second(avr->data[address]);
    }
}

// The routines that a return to this stack pointer leaves.
void Chip::Implementation::pop_frames(unsigned stack)
{
    while (!frames.empty() && stack > frames.back().stack) {
        const Frame frame = frames.back();
        Meter &meter = *frame.meter;
        const uint64_t interrupted = in_interrupts - frame.interrupts;

        frames.pop_back();
        meter.last = avr->cycle - frame.start - interrupted;
        meter.interrupted += interrupted;
        meter.calls++;
        meter.least = std::min(meter.least, meter.last);
        meter.most = std::max(meter.most, meter.last);
        meter.total += meter.last;
        if (frame.interrupt) {
            in_interrupts += meter.last;
        }
        if (meter.on_return) {
            meter.on_return(meter.last);
        }
    }
}

void Chip::Implementation::look_at_time()
{
    next_periodic = UINT64_MAX;
    for (Periodic &periodic : periodics) {
        while (periodic.next <= avr->cycle) {
            periodic.action();
            periodic.next += periodic.period;
        }
        next_periodic = std::min(next_periodic, periodic.next);
    }
}

void Chip::Implementation::one()
{
    const unsigned pc = avr->pc;
    const uint8_t kind = kinds[(pc >> 1) % kinds.size()];
    unsigned address = 0;

    if ((kind & begins) != 0) {
        act_before(pc);
    }
    if ((kind & stores) != 0) {
        address = stored_at(pc) % watched.size();
    }
    // simavr 1.6 takes a new OCR1A only if it differs when the low half comes,
    // from an old one that has the new high half already.
    if ((kind & stores) != 0 && address == ocr1al) {
        avr->data[ocr1al] ^= 0xFFu;
    }
    const unsigned stack = pointer(R_SPL);
    const int state = avr_run(avr);

    lowest_stack = std::min(lowest_stack, pointer(R_SPL));
    if (avr->run != ordinary) {
        ends(Stop::fault, "the watchdog resets the chip");
        avr->run = ordinary;
    } else if (state != cpu_Running) {
        ends(Stop::fault, "the chip does not run on: " + printed);
    }
    if ((kind & returns) != 0) {
        pop_frames(stack + 2);
    }
    if ((kind & stores) != 0 && watched[address]) {
        act_after(address);
    }
    if (avr->cycle >= next_periodic) {
        look_at_time();
    }
}

uint32_t Chip::Implementation::symbol(const std::string &wanted,
                                      bool data) const
{
    auto found = symbols.find(wanted);

    // A function of the library may have a suffix to its name: FIXPID_SUFFIXED
    // in include/fixpid.h. Of several, such as step and step_percent, the
    // shortest is it.
    if (found == symbols.end() && !data) {
        for (auto at = symbols.begin(); at != symbols.end(); at++) {
            if (at->first.compare(0, wanted.size() + 1, wanted + "_") == 0 &&
                (found == symbols.end() ||
                 at->first.size() < found->first.size())) {
                found = at;
            }
        }
    }
    if (found == symbols.end() || (found->second >= data_offset) != data) {
        throw ChipError(std::string(data ? "no variable " : "no routine ") +
                        wanted);
    }
    return found->second & (data_offset - 1);
}

// ---- Construction ----

Chip::Chip(const std::string &elf, const std::string &processor)
    : self(new Implementation)
{
    if (access(elf.c_str(), R_OK) != 0) {
        throw ChipError("cannot read " + elf);
    }
    self->name = processor.empty() ? usual : processor;
    avr_global_logger_set(log_message);
    self->avr = avr_make_mcu_by_name(self->name.c_str());
    if (self->avr == nullptr ||
        elf_read_firmware(elf.c_str(), &self->firmware) != 0 ||
        self->firmware.flashsize == 0) {
        throw ChipError(elf + " is not a firmware for an " + self->name);
    }
    avr_t &avr = *self->avr;
    (void)avr_init(&avr);
    avr.frequency = usual_hz;
    avr.vcc = avr.avcc = millivolts;
    avr.aref = millivolts / 4; // not used: an Uno has a capacitor there
    avr_load_firmware(&avr, &self->firmware);
    uint32_t uart = 0; // what is sent is not printed
    (void)avr_ioctl(&avr, AVR_IOCTL_UART_GET_FLAGS('0'), &uart);
    uart &= ~(uint32_t)AVR_UART_FLAG_STDIO;
    (void)avr_ioctl(&avr, AVR_IOCTL_UART_SET_FLAGS('0'), &uart);
    self->ordinary = avr.run;
    self->lowest_stack = avr.ramend;
    for (uint32_t i = 0; i < self->firmware.symbolcount; i++) {
        self->symbols[self->firmware.symbol[i]->symbol] =
            self->firmware.symbol[i]->addr;
    }
    self->kinds.assign((avr.flashend + 1) / 2, 0);
    for (unsigned pc = 0; pc < avr.flashend; pc += 2) {
        const unsigned code = self->opcode(pc);
        self->kinds[pc / 2] =
            is_store(code) ? stores : (is_return(code) ? returns : 0);
    }
    self->watched.assign(avr.ramend + 1u, false);
    fill_ram(0xA5);
}

Chip::~Chip()
{
    if (self->avr != nullptr) {
        avr_terminate(self->avr);
    }
}

// ---- Time ----

uint64_t Chip::run(uint64_t cycles)
{
    const uint64_t start = self->avr->cycle;

    self->stop = Stop::none;
    self->reason.clear();
    while (self->stop == Stop::none && self->avr->cycle - start < cycles) {
        self->one();
    }
    return self->avr->cycle - start;
}

Stop Chip::stopped() const
{
    return self->stop;
}

const std::string &Chip::reason() const
{
    return self->reason;
}

void Chip::stop(const std::string &reason)
{
    self->ends(Stop::requested, reason);
}

void Chip::fail(const std::string &reason)
{
    self->ends(Stop::fault, reason);
}

uint64_t Chip::cycle() const
{
    return self->avr->cycle;
}

double Chip::cycles_per_second() const
{
    return self->avr->frequency;
}

void Chip::set_oscillator(double hertz)
{
    self->avr->frequency = (uint32_t)hertz;
}

// ---- Faults ----

// What `hang` has put in the place of an instruction.
namespace
{

constexpr uint16_t jump_to_itself = 0xCFFF; // rjmp .-2

struct Hung {
    uint32_t at;
    uint8_t was[2];
};
std::vector<Hung> hung;

void mend(uint8_t *flash)
{
    for (const Hung &one : hung) {
        std::copy(one.was, one.was + 2, flash + one.at);
    }
    hung.clear();
}

} // namespace

void Chip::reset()
{
    avr_t &avr = *self->avr;

    mend(avr.flash);
    self->frames.clear();
    avr_reset(&avr);
    avr.pc = 0;
}

void Chip::hang()
{
    uint8_t *const next = self->avr->flash + self->avr->pc;

    mend(self->avr->flash);
    hung.push_back({self->avr->pc, {next[0], next[1]}});
    next[0] = jump_to_itself & 0xFFu;
    next[1] = jump_to_itself >> 8;
}

// ---- Memory ----

unsigned Chip::peek(unsigned address) const
{
    unsigned value = self->avr->data[address];

    if (address == R_SREG) {
        READ_SREG_INTO(self->avr, value)
    }
    return value;
}

void Chip::poke(unsigned address, unsigned value)
{
    self->avr->data[address] = (uint8_t)value;
}

// SREG; flags of interrupts, which are raised as the hardware does it; and what
// a peripheral listens to.
void Chip::write(unsigned address, unsigned value)
{
    avr_t &avr = *self->avr;

    if (address == R_SREG) {
        for (unsigned bit = 0; bit < sreg_bits; bit++) {
            avr_sreg_set(&avr, (uint8_t)bit, (value >> bit) & 1u);
        }
        return;
    }
    bool flag = false;
    for (unsigned i = 0; i < avr.interrupts.vector_count; i++) {
        avr_int_vector_t *const vector = avr.interrupts.vector[i];
        if (vector->raised.reg == address &&
            ((value >> vector->raised.bit) & 1u) != 0 &&
            ((avr.data[address] >> vector->raised.bit) & 1u) == 0) {
            (void)avr_raise_interrupt(&avr, vector);
        }
        flag |= vector->raised.reg == address;
    }
    const unsigned io = AVR_DATA_TO_IO(address);
    if (!flag && io < MAX_IOs && avr.io[io].w.c != nullptr) {
        avr.io[io].w.c(&avr, (avr_io_addr_t)address, (uint8_t)value,
                       avr.io[io].w.param);
    }
}

uint16_t Chip::peek_u16(unsigned address) const
{
    return (uint16_t)self->pointer(address);
}

void Chip::poke_u16(unsigned address, uint16_t value)
{
    poke(address, value & 0xFFu);
    poke(address + 1, value >> 8);
}

void Chip::fill_ram(unsigned value)
{
    const unsigned first = self->avr->ioend + 1u;

    std::fill(&self->avr->data[first], &self->avr->data[self->avr->ramend + 1],
              (uint8_t)value);
}

// simavr tells where it has the byte, and nothing if there is none.
static uint8_t &eeprom_cell(avr_t *avr, unsigned address)
{
    avr_eeprom_desc_t cell = {nullptr, (uint16_t)address, 1};

    (void)avr_ioctl(avr, AVR_IOCTL_EEPROM_GET, &cell);
    if (cell.ee == nullptr) {
        throw ChipError("no EEPROM at " + std::to_string(address));
    }
    return *cell.ee;
}

unsigned Chip::peek_eeprom(unsigned address) const
{
    return eeprom_cell(self->avr, address);
}

void Chip::poke_eeprom(unsigned address, unsigned value)
{
    eeprom_cell(self->avr, address) = (uint8_t)value;
}

// ---- Symbols ----

bool Chip::has_symbol(const std::string &name) const
{
    return self->symbols.count(name) != 0;
}

unsigned Chip::data(const std::string &name) const
{
    return self->symbol(name, true);
}

unsigned Chip::code(const std::string &name) const
{
    return self->symbol(name, false);
}

std::vector<unsigned> Chip::instructions() const
{
    std::vector<unsigned> all;

    for (unsigned at = 0; at < self->firmware.flashsize; at += 2) {
        all.push_back(at);
    }
    return all;
}

// ---- State ----

bool Chip::is_pic18() const
{
    return false;
}

std::string Chip::processor() const
{
    return self->name;
}

unsigned Chip::program_counter() const
{
    return self->avr->pc;
}

unsigned Chip::working() const
{
    return peek(working_register);
}

void Chip::set_working(unsigned value)
{
    poke(working_register, value);
}

unsigned Chip::stack_most() const
{
    return self->avr->ramend - self->lowest_stack;
}

std::string Chip::stack_unit() const
{
    return "bytes";
}

// ---- Actions ----

void Chip::every(uint64_t cycles, Action action)
{
    self->periodics.push_back(
        {self->avr->cycle + cycles, cycles, std::move(action)});
    self->next_periodic =
        std::min(self->next_periodic, self->periodics.back().next);
}

void Chip::skip_waiting(const std::string &)
{
}

void Chip::on_execute(unsigned code_address, Action action)
{
    self->kinds.at(code_address / 2) |= begins;
    self->executes.emplace(code_address, std::move(action));
}

void Chip::on_write(unsigned address, ValueAction action)
{
    self->watched.at(address) = true;
    self->writes.emplace(address, std::move(action));
}

// ---- Meters ----

Meter &Chip::Implementation::meter_at(unsigned address,
                                      const std::string &called, bool interrupt)
{
    meters.push_back(std::make_unique<Meter>());
    Meter &meter = *meters.back();
    meter.name = called;
    kinds.at(address / 2) |= begins;
    executes.emplace(address, [this, &meter, interrupt] {
        if (!frames.empty() && frames.back().meter == &meter &&
            frames.back().stack == pointer(R_SPL)) {
            return; // a loop around the whole routine
        }
        if (meter.on_call) {
            meter.on_call();
        }
        frames.push_back(
            {&meter, avr->cycle, in_interrupts, pointer(R_SPL), interrupt});
    });
    return meter;
}

Meter &Chip::meter(const std::string &routine)
{
    return self->meter_at(code(routine), routine, false);
}

Meter &Chip::meter_interrupt(unsigned vector)
{
    return self->meter_at(vector, "at " + std::to_string(vector), true);
}

uint64_t Chip::interrupt_cycles() const
{
    return self->in_interrupts;
}

// ---- Pins ----

// "adc0" to "adc7".
unsigned Chip::analog_input(const std::string &pin)
{
    if (pin.size() != 4 || pin.compare(0, 3, "adc") != 0 || pin[3] < '0' ||
        pin[3] > '7') {
        throw ChipError("no analog pin " + pin);
    }
    return (unsigned)(pin[3] - '0');
}

// simavr truncates, too, but takes millivolts and 1023 codes.
void Chip::set_code(unsigned input, unsigned code)
{
    const unsigned least = (code * millivolts + codes_most - 1) / codes_most;

    avr_raise_irq(avr_io_getirq(self->avr, AVR_IOCTL_ADC_GETIRQ,
                                (int)(ADC_IRQ_ADC0 + input)),
                  least);
}

void Chip::set_volts(unsigned input, double volts)
{
    const double code = std::floor(volts / 5.0 * (codes_most + 1));

    set_code(input, (unsigned)std::clamp(code, 0.0, (double)codes_most));
}

// "portb1", which is OC1A: the timer itself is asked, as the port tells nothing
// where the timer sets what is set.
unsigned Chip::probe(const std::string &pin)
{
    if (pin != "portb1") {
        throw ChipError("no probe for " + pin);
    }
    self->probes.push_back(std::make_unique<Probe>());
    self->probes.back()->avr = self->avr;
    avr_irq_register_notify(avr_io_getirq(self->avr,
                                          AVR_IOCTL_TIMER_GETIRQ('1'),
                                          TIMER_IRQ_OUT_COMP),
                            pin_changed, self->probes.back().get());
    return (unsigned)self->probes.size() - 1;
}

bool Chip::probe_level(unsigned probe) const
{
    return self->probes.at(probe)->level;
}

uint64_t Chip::probe_edges(unsigned probe) const
{
    return self->probes.at(probe)->edges;
}

uint64_t Chip::probe_high_cycles(unsigned probe)
{
    Probe &one = *self->probes.at(probe);

    one.look();
    const uint64_t cycles = one.high;
    one.high = 0;
    return cycles;
}

void Chip::on_edge(unsigned probe, ValueAction action)
{
    self->probes.at(probe)->actions.push_back(std::move(action));
}

// ---- UART ----

static avr_irq_t *uart_irq(avr_t *avr, int which)
{
    return avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), which);
}

static void sent(avr_irq_t *, uint32_t value, void *param)
{
    (*static_cast<Chip::ValueAction *>(param))(value);
}

void Chip::on_send(ValueAction action)
{
    self->sends.push_back(std::make_unique<ValueAction>(std::move(action)));
    avr_irq_register_notify(uart_irq(self->avr, UART_IRQ_OUTPUT), sent,
                            self->sends.back().get());
}

void Chip::receive(unsigned byte, unsigned)
{
    avr_raise_irq(uart_irq(self->avr, UART_IRQ_INPUT), byte);
}

// ---- Simulator ----

std::string Chip::messages()
{
    std::string all;

    all.swap(printed);
    return all;
}

std::vector<std::string> Chip::lint() const
{
    return {}; // nothing of the firmware that simavr gets wrong is known
}

void Chip::lenient_until(const std::string &routine)
{
    (void)code(routine);
}
