// SPDX-License-Identifier: MIT
#include "chip.hh"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <gpsim/14bit-processors.h>
#include <gpsim/14bit-tmrs.h>
#include <gpsim/eeprom.h>

#include "parts.hh"

using namespace parts;

namespace
{

constexpr unsigned codes = 1024;
constexpr unsigned poison = 0xA5;
constexpr unsigned txreg = 0xFAD; // of a PIC18

std::string printed(const char *format, ...)
    __attribute__((format(printf, 1, 2)));

std::string printed(const char *format, ...)
{
    char text[200];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    return text;
}

// A call of a metered routine that has not returned yet.
struct Frame {
    Meter *meter;
    unsigned return_address;
    unsigned depth;
    uint64_t start;             // its first instruction
    uint64_t interrupted_start; // the interrupt's latency included
    uint64_t interrupts_before;
    bool is_interrupt;
};

} // namespace

struct Chip::Implementation {
    pic_processor *processor = nullptr;
    GuardedStack *stack = nullptr;
    Stop stopped = Stop::none;
    std::string reason;
    unsigned restarts = 0;

    Console console;
    Halt halt;
    Printed printed_by_gpsim;
    std::streambuf *real_cout = nullptr;
    std::streambuf *real_cerr = nullptr;

    std::map<unsigned, Watched *> watched;
    std::deque<Meter> meters;
    std::vector<Frame> frames;
    std::set<unsigned> return_addresses;
    uint64_t interrupt_cycles = 0;

    // Never freed, as gpsim refers to them.
    std::map<std::string, Stimulus_Node *> nodes;
    std::vector<Source *> sources;
    std::vector<Probe *> probes;
    Arrival *arrival = nullptr;

    Implementation();
    ~Implementation();
    void load(const std::string &cod);
    void end(Stop how, const std::string &why);
    void explain_halt();
    void guard_stack();
    void guard_flash();
    void break_on_invalid_registers(bool on);
    void correct_table_reads();
    std::string take_messages();

    Register *reg(unsigned address) const;
    gpsimObject *find(const std::string &name) const;
    instruction *routine(const std::string &name) const;
    unsigned code_bytes() const;
    Watched *watch(unsigned address);
    Stimulus_Node *node(const std::string &pin);

    void enter(Meter *meter, bool is_interrupt);
    void watch_return(unsigned address);
    void leave(unsigned address);
};

// ---- Loading ----

Chip::Implementation::Implementation()
{
    static bool taken = false;
    if (taken) {
        throw ChipError("a program can simulate one chip only");
    }
    taken = true;
    real_cout = std::cout.rdbuf(&printed_by_gpsim);
    real_cerr = std::cerr.rdbuf(&printed_by_gpsim);
}

Chip::Implementation::~Implementation()
{
    std::cout.rdbuf(real_cout);
    std::cerr.rdbuf(real_cerr);
}

void Chip::Implementation::load(const std::string &cod)
{
    if (!std::ifstream(cod)) {
        throw ChipError("cannot read " + cod);
    }
    initialize_gpsim_core();
    GetUserInterface().SetConsole(&console); // else messages crash
    initialization_is_complete();
    auto *const sources_too =
        dynamic_cast<Boolean *>(globalSymbolTable().find("EnableSourceLoad"));
    if (sources_too != nullptr) {
        *sources_too = false;
    }
    Processor *loaded = nullptr;
    const bool good = CSimulationContext::GetContext()->LoadProgram(
        cod.c_str(), nullptr, &loaded, nullptr);
    processor = dynamic_cast<pic_processor *>(loaded);
    if (!good || (processor == nullptr)) {
        throw ChipError(cod + ": not a .cod file of a chip that gpsim knows: " +
                        take_messages());
    }
}

Chip::Chip(const std::string &cod, const std::string &wanted)
    : self(new Implementation)
{
    self->load(cod);
    if (!wanted.empty() && (processor() != wanted)) {
        throw ChipError(cod + " is for " + processor() + ", not for " + wanted);
    }
    self->guard_stack();
    self->guard_flash();
    self->correct_table_reads();
    on_execute(0, [this] {
        self->restarts++;
        if (self->restarts > 1) {
            fail("restarted at the reset vector");
        }
    });
    fill_ram(poison);
    (void)messages();
}

Chip::~Chip() = default;

// ---- Guards ----

void Chip::Implementation::end(Stop how, const std::string &why)
{
    if (stopped == Stop::none) {
        stopped = how;
        reason = why;
        halt.arm(get_cycles().get() + 1);
    }
}

void Chip::Implementation::guard_stack()
{
    stack = new GuardedStack(processor, processor->stack);
    stack->fault = [this](const std::string &what) {
        end(Stop::fault, what + printed(", at %05x", processor->pma->get_PC()));
    };
    processor->stack = stack;
}

void Chip::Implementation::guard_flash()
{
    for (unsigned i = 0; i < processor->program_memory_size(); i++) {
        if (processor->program_memory[i] == &processor->bad_instruction) {
            processor->program_memory[i] = new Erased(
                processor, processor->map_pm_index2address((int)i),
                [this](unsigned at) {
                    end(Stop::fault,
                        printed("ran into erased flash at %05x", at));
                });
        }
    }
}

void Chip::Implementation::break_on_invalid_registers(bool on)
{
    for (const char *name :
         {"BreakOnInvalidRegisterRead", "BreakOnInvalidRegisterWrite"}) {
        auto *const option =
            dynamic_cast<Boolean *>(processor->findSymbol(name));
        if (option != nullptr) {
            *option = on;
        }
    }
}

void Chip::lenient_until(const std::string &routine)
{
    self->break_on_invalid_registers(false);
    on_execute(code(routine), [this] {
        self->break_on_invalid_registers(true);
        (void)messages();
    });
}

// gpsim halts by itself at what it finds invalid, and prints why.
void Chip::Implementation::explain_halt()
{
    const std::string message = take_messages();
    const bool memory =
        (message.find("invalid file register") != std::string::npos);
    stopped = Stop::fault;
    reason = std::string(memory ? "access outside the chip's RAM"
                                : "stopped by gpsim") +
             printed(", at %05x: ", processor->pma->get_PC()) + message;
}

// ---- Time ----

uint64_t Chip::run(uint64_t cycles)
{
    const uint64_t start = cycle();
    self->stopped = Stop::none;
    self->reason.clear();
    self->halt.arm(start + cycles);
    self->processor->run(false);
    if ((self->stopped == Stop::none) && (cycle() < start + cycles)) {
        self->explain_halt();
    }
    return cycle() - start;
}

Stop Chip::stopped() const
{
    return self->stopped;
}

const std::string &Chip::reason() const
{
    return self->reason;
}

void Chip::stop(const std::string &reason)
{
    self->end(Stop::requested, reason);
}

void Chip::fail(const std::string &reason)
{
    self->end(Stop::fault, reason);
}

uint64_t Chip::cycle() const
{
    return get_cycles().get();
}

double Chip::cycles_per_second() const
{
    return get_cycles().instruction_cps();
}

void Chip::set_oscillator(double hertz)
{
    self->processor->set_frequency(hertz);
}

// ---- Faults ----

// What `hang` has put in the place of an instruction.
namespace
{

constexpr unsigned goto_pic14 = 0x2800;   // and eleven bits of the address
constexpr unsigned to_itself_18 = 0xD7FF; // bra $

struct Hung {
    unsigned at;
    unsigned was;
};
std::vector<Hung> hung;

void mend(pic_processor &chip)
{
    for (const Hung &one : hung) {
        chip.pma->put_opcode(one.at, one.was);
    }
    hung.clear();
}

} // namespace

// What gpsim's reset leaves as it was. A PIC16 that was serving an interrupt
// would take no other; Timer2, which it stops without a word, waits for a cycle
// that is over when its firmware starts it again.
void Chip::reset()
{
    pic_processor &chip = *self->processor;
    mend(chip);
    chip.reset(POR_RESET);
    auto *const pic14 = dynamic_cast<_14bit_processor *>(&chip);
    if (pic14 != nullptr) {
        pic14->intcon->in_interrupt = false;
    }
    for (unsigned address = 0; address < chip.rma.get_size(); address++) {
        auto *const timer =
            dynamic_cast<TMR2 *>(chip.rma.get_register(address));
        if (timer != nullptr) {
            get_cycles().clear_break(timer);
            timer->start();
        }
    }
}

void Chip::hang()
{
    const unsigned at = program_counter();

    mend(*self->processor);
    hung.push_back({at, self->processor->pma->get_opcode(at)});
    self->processor->pma->put_opcode(
        at, is_pic18() ? to_itself_18 : goto_pic14 | (at & 0x7FFu));
}

// ---- Memory ----

// The register itself, below the actions on it.
Register *Chip::Implementation::reg(unsigned address) const
{
    if (address >= processor->rma.get_size()) {
        throw ChipError(printed("no register at %03x", address));
    }
    Register *found = processor->rma.get_register(address);
    while ((found != nullptr) && (found->isa() == Register::BP_REGISTER)) {
        found = static_cast<BreakpointRegister *>(found)->getReplaced();
    }
    if (found == nullptr) {
        throw ChipError(printed("no register at %03x", address));
    }
    return found;
}

unsigned Chip::peek(unsigned address) const
{
    return self->reg(address)->get_value();
}

void Chip::poke(unsigned address, unsigned value)
{
    self->reg(address)->put_value(value & 0xFF);
}

void Chip::write(unsigned address, unsigned value)
{
    self->reg(address)->put(value & 0xFF);
}

uint16_t Chip::peek_u16(unsigned address) const
{
    return (uint16_t)(peek(address) | (peek(address + 1) << 8));
}

int16_t Chip::peek_s16(unsigned address) const
{
    return (int16_t)peek_u16(address);
}

uint32_t Chip::peek_u32(unsigned address) const
{
    return peek_u16(address) | ((uint32_t)peek_u16(address + 2) << 16);
}

int32_t Chip::peek_s32(unsigned address) const
{
    return (int32_t)peek_u32(address);
}

void Chip::poke_u16(unsigned address, uint16_t value)
{
    poke(address, value);
    poke(address + 1, value >> 8);
}

void Chip::poke_u32(unsigned address, uint32_t value)
{
    poke_u16(address, (uint16_t)value);
    poke_u16(address + 2, (uint16_t)(value >> 16));
}

static bool is_ram(Register *found)
{
    return (found != nullptr) && ((found->isa() == Register::FILE_REGISTER) ||
                                  (found->isa() == Register::GENERIC_REGISTER));
}

void Chip::fill_ram(unsigned value)
{
    for (unsigned i = 0; i < self->processor->rma.get_size(); i++) {
        Register *const found = self->processor->rma.get_register(i);
        if (is_ram(found)) {
            found->put_value(value & 0xFF);
        }
    }
}

unsigned Chip::ram_bytes() const
{
    std::set<Register *> bytes; // one may have several addresses
    for (unsigned i = 0; i < self->processor->rma.get_size(); i++) {
        Register *const found = self->processor->rma.get_register(i);
        if (is_ram(found)) {
            bytes.insert(found);
        }
    }
    return (unsigned)bytes.size();
}

static Register *eeprom_cell(pic_processor &chip, unsigned address)
{
    EEPROM *const eeprom = chip.get_eeprom();
    if ((eeprom == nullptr) || (address >= eeprom->get_rom_size())) {
        throw ChipError(printed("no EEPROM at %03x", address));
    }
    return eeprom->get_rom()[address];
}

unsigned Chip::peek_eeprom(unsigned address) const
{
    return eeprom_cell(*self->processor, address)->get_value();
}

void Chip::poke_eeprom(unsigned address, unsigned value)
{
    eeprom_cell(*self->processor, address)->put_value(value & 0xFF);
}

// ---- Symbols ----

gpsimObject *Chip::Implementation::find(const std::string &name) const
{
    // C's first, as gpsim itself has a status, a pr2 and so on.
    gpsimObject *const found = processor->findSymbol("_" + name);
    return (found != nullptr) ? found : processor->findSymbol(name);
}

bool Chip::has_symbol(const std::string &name) const
{
    return self->find(name) != nullptr;
}

unsigned Chip::data(const std::string &name) const
{
    auto *const found = dynamic_cast<Register *>(self->find(name));
    if (found == nullptr) {
        throw ChipError("the firmware has no variable " + name);
    }
    return found->getAddress();
}

// A function of the library may have a suffix to its name: FIXPID_SUFFIXED in
// include/fixpid.h. Of several, such as step and step_percent, the shortest is
// it. (gpsim calls a plain function for each symbol.)
instruction *Chip::Implementation::routine(const std::string &name) const
{
    static std::string wanted;
    static std::string shortest;

    if (auto *const found = dynamic_cast<instruction *>(find(name))) {
        return found;
    }
    wanted = "_" + name + "_";
    shortest.clear();
    processor->getSymbolTable().ForEachSymbolTable(
        [](const SymbolEntry_t &symbol) {
            if ((symbol.first.compare(0, wanted.size(), wanted) == 0) &&
                (dynamic_cast<instruction *>(symbol.second) != nullptr) &&
                (shortest.empty() || (symbol.first.size() < shortest.size()))) {
                shortest = symbol.first;
            }
        });
    return dynamic_cast<instruction *>(processor->findSymbol(shortest));
}

unsigned Chip::code(const std::string &name) const
{
    instruction *const found = self->routine(name);
    if (found == nullptr) {
        throw ChipError("the firmware has no routine " + name);
    }
    return found->getAddress();
}

unsigned Chip::Implementation::code_bytes() const
{
    return (unsigned)processor->map_pm_index2address(
        (int)processor->program_memory_size());
}

std::vector<unsigned> Chip::instructions() const
{
    std::vector<unsigned> found;
    for (unsigned i = 0; i < self->processor->program_memory_size(); i++) {
        const unsigned address =
            (unsigned)self->processor->map_pm_index2address((int)i);
        if (self->processor->pma->hasValid_opcode_at_address(address)) {
            found.push_back(address);
        }
    }
    return found;
}

// ---- State ----

bool Chip::is_pic18() const
{
    return self->processor->base_isa() == _PIC18_PROCESSOR_;
}

std::string Chip::processor() const
{
    return self->processor->name();
}

unsigned Chip::program_counter() const
{
    return self->processor->pma->get_PC();
}

unsigned Chip::working() const
{
    return self->processor->Wget();
}

void Chip::set_working(unsigned value)
{
    self->processor->Wput(value);
}

unsigned Chip::stack_depth() const
{
    return self->stack->depth();
}

unsigned Chip::stack_most() const
{
    return self->stack->most;
}

std::string Chip::stack_unit() const
{
    return "levels";
}

bool Chip::asleep() const
{
    return self->processor->mCurrentPhase == self->processor->mIdle;
}

// ---- Actions ----

Watched *Chip::Implementation::watch(unsigned address)
{
    Watched *&found = watched[address];
    if (found == nullptr) {
        const unsigned i =
            (unsigned)processor->map_pm_address2index((int)address);
        if (i >= processor->program_memory_size()) {
            throw ChipError(printed("no instruction at %05x", address));
        }
        found = new Watched(processor, address, processor->program_memory[i]);
        processor->program_memory[i] = found;
    }
    return found;
}

void Chip::every(uint64_t cycles, Action action)
{
    get_cycles().set_break(cycle() + cycles,
                           new Periodic(cycles, std::move(action)));
}

// Where a jump goes back to, or the jump's own address if it is none.
static unsigned jump_back(unsigned at, unsigned opcode, bool is_pic18)
{
    if (!is_pic18) { // GOTO, within this page
        const unsigned to = (at & ~0x7FFu) | (opcode & 0x7FFu);
        return (opcode & 0x3800u) == 0x2800u ? to : at;
    }
    if ((opcode & 0xFE00u) == 0xE000u) { // BZ, BNZ
        return at + 2u + 2u * (unsigned)(int8_t)(opcode & 0xFFu);
    }
    if ((opcode & 0xF800u) == 0xD000u) { // BRA
        const int words = (int)((opcode & 0x7FFu) ^ 0x400u) - 0x400;
        return at + 2u + 2u * (unsigned)words;
    }
    return at;
}

// Whether an instruction only compares bytes or jumps.
static bool only_compares(unsigned opcode, bool is_pic18)
{
    if (!is_pic18) { // MOVF, XORWF and SUBWF to W; GOTO, BTFSC and BTFSS; banks
        const unsigned to_w = opcode & 0x3F80u;
        return to_w == 0x0800u || to_w == 0x0600u || to_w == 0x0200u ||
               (opcode & 0x3800u) == 0x2800u || (opcode & 0x3800u) == 0x1800u ||
               (opcode & 0x387Fu) == 0x1003u;
    }
    const unsigned to_w = opcode & 0xFF00u; // the same, of access RAM
    return to_w == 0x5000u || to_w == 0x1800u || to_w == 0x5C00u ||
           (opcode & 0xFE00u) == 0xE000u || (opcode & 0xF800u) == 0xD000u;
}

// A loop whose rounds are alike until an interrupt comes, because it only reads
// memory. gpsim interrupts after its clock has come to a break; until then
// nothing but the clock goes on.
struct Waiting {
    uint64_t last = 0;  // when it began a round
    uint64_t round = 0; // what the round before took

    void begins()
    {
        const uint64_t now = get_cycles().get();
        const uint64_t took = now - last;
        const bool alike = took == round && took <= longest_round;
        last = now;
        round = took;
        const Cycle_Counter_breakpoint_list *const next =
            get_cycles().active.next;
        if (!alike || next == nullptr || get_bp().have_interrupt()) {
            return;
        }
        while (last + 2 * round < next->break_value) {
            for (uint64_t i = 0; i < round; i++) {
                get_cycles().increment();
            }
            last += round;
        }
    }

    static constexpr uint64_t longest_round = 8; // an interrupt takes more
};

void Chip::skip_waiting(const std::string &routine)
{
    if (self->routine(routine) == nullptr) {
        return;
    }
    const unsigned words = 16; // it is short
    const unsigned step = is_pic18() ? 2 : 1;
    const unsigned begin = code(routine);

    for (unsigned at = begin; at < begin + words * step; at += step) {
        const unsigned opcode = self->processor->pma->get_opcode(at);
        if (!only_compares(opcode, is_pic18())) {
            return;
        }
        const unsigned to = jump_back(at, opcode, is_pic18());
        if (to >= begin && to < at) {
            on_execute(to, [loop = Waiting()]() mutable { loop.begins(); });
            return;
        }
    }
}

void Chip::on_execute(unsigned code_address, Action action)
{
    self->watch(code_address)->actions.push_back(std::move(action));
}

void Chip::on_write(unsigned address, ValueAction action)
{
    new WrittenRegister(self->processor, address, std::move(action));
}

void Chip::on_read(unsigned address, Action action)
{
    new ReadRegister(self->processor, address, std::move(action));
}

// ---- Meters ----

void Chip::Implementation::enter(Meter *meter, bool is_interrupt)
{
    const unsigned back_at = stack->top();
    const unsigned depth = stack->depth();
    if (!frames.empty() && (frames.back().meter == meter) &&
        (frames.back().depth == depth) &&
        (frames.back().return_address == back_at)) {
        return; // a loop back to its first instruction
    }
    frames.push_back({meter, back_at, depth, get_cycles().get(),
                      stack->last_push, interrupt_cycles, is_interrupt});
    watch_return(back_at);
    if (meter->on_call) {
        meter->on_call();
    }
}

void Chip::Implementation::watch_return(unsigned address)
{
    if (return_addresses.insert(address).second) {
        watch(address)->returned = [this, address] { leave(address); };
    }
}

void Chip::Implementation::leave(unsigned address)
{
    const unsigned depth = stack->depth();
    while (!frames.empty() && (frames.back().return_address == address) &&
           (frames.back().depth == depth + 1)) {
        const Frame frame = frames.back();
        frames.pop_back();
        const uint64_t now = get_cycles().get();
        const uint64_t within = interrupt_cycles - frame.interrupts_before;
        const uint64_t own = now - frame.start - within;
        Meter &meter = *frame.meter;
        meter.calls++;
        meter.total += own;
        meter.last = own;
        meter.least = std::min(meter.least, own);
        meter.most = std::max(meter.most, own);
        meter.interrupted += within;
        if (frame.is_interrupt) {
            interrupt_cycles += now - frame.interrupted_start - within;
        }
        if (meter.on_return) {
            meter.on_return(own);
        }
    }
}

Meter &Chip::meter(const std::string &routine)
{
    return meter_at(code(routine), routine);
}

Meter &Chip::meter_at(unsigned code_address, const std::string &name)
{
    self->meters.emplace_back();
    Meter *const meter = &self->meters.back();
    meter->name = name;
    on_execute(code_address, [this, meter] { self->enter(meter, false); });
    return *meter;
}

Meter &Chip::meter_interrupt(unsigned vector)
{
    self->meters.emplace_back();
    Meter *const meter = &self->meters.back();
    meter->name = printed("interrupt %02x", vector);
    on_execute(vector, [this, meter] { self->enter(meter, true); });
    return *meter;
}

uint64_t Chip::interrupt_cycles() const
{
    return self->interrupt_cycles;
}

// ---- Pins ----

Stimulus_Node *Chip::Implementation::node(const std::string &pin)
{
    Stimulus_Node *&found = nodes[pin];
    for (int i = 1; (found == nullptr) && (i <= processor->get_pin_count());
         i++) {
        IOPIN *const candidate = processor->get_pin((unsigned)i);
        if ((candidate != nullptr) && (candidate->name() == pin)) {
            found = new Stimulus_Node(("node_" + pin).c_str());
            found->attach_stimulus(candidate);
        }
    }
    if (found == nullptr) {
        throw ChipError("the chip has no pin " + pin);
    }
    return found;
}

unsigned Chip::analog_input(const std::string &pin)
{
    Stimulus_Node *const node = self->node(pin);
    self->sources.push_back(new Source("source_" + pin));
    node->attach_stimulus(self->sources.back());
    node->update();
    return (unsigned)self->sources.size() - 1;
}

void Chip::set_volts(unsigned input, double volts)
{
    Source *const source = self->sources.at(input);
    // gpsim converts a negative voltage to garbage.
    source->set_Vth(std::clamp(volts, 0.0, supply_volts));
    source->updateNode();
}

void Chip::set_code(unsigned input, unsigned code)
{
    set_volts(input, (std::min(code, codes - 1) + 0.5) / codes * supply_volts);
}

unsigned Chip::probe(const std::string &pin)
{
    Stimulus_Node *const node = self->node(pin);
    self->probes.push_back(new Probe("probe_" + pin));
    node->attach_stimulus(self->probes.back());
    node->update();
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
    Probe *const found = self->probes.at(probe);
    found->account();
    return std::exchange(found->high, 0);
}

void Chip::on_edge(unsigned probe, ValueAction action)
{
    self->probes.at(probe)->action = std::move(action);
}

// ---- UART ----

void Chip::on_send(ValueAction action)
{
    on_write(txreg, std::move(action));
}

void Chip::receive(unsigned byte, unsigned cycles_a_bit)
{
    if (self->arrival == nullptr) {
        self->arrival = new Arrival(this);
    }
    self->arrival->begin(byte, cycles_a_bit);
}

// ---- Simulator ----

std::string Chip::Implementation::take_messages()
{
    std::istringstream lines(printed_by_gpsim.str());
    printed_by_gpsim.str("");
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        // Said of every watched instruction, and harmless.
        if (!line.empty() && (line.find("::addSymbol line_") == line.npos)) {
            text += (text.empty() ? "" : "; ") + line;
        }
    }
    return text;
}

std::string Chip::messages()
{
    return self->take_messages();
}

// TBLRD and TBLWT take two cycles on the chip and one in gpsim.
void Chip::Implementation::correct_table_reads()
{
    if (processor->base_isa() != _PIC18_PROCESSOR_) {
        return;
    }
    for (unsigned at = 0; at < code_bytes(); at += 2) {
        const unsigned opcode = processor->pma->get_opcode(at);
        if ((opcode >= 0x0008) && (opcode <= 0x000F) &&
            processor->pma->hasValid_opcode_at_address(at)) {
            watch(at)->one_cycle_short = true;
        }
    }
}

static std::string wrong_in_gpsim(unsigned opcode)
{
    const unsigned file = opcode & 0xFF;
    const bool preinc = (file == 0xEC) || (file == 0xE4) || (file == 0xDC);
    const bool access = (opcode & 0x100) == 0;
    const bool modifies =
        ((opcode & 0xFE00) == 0x2600) || ((opcode & 0xE000) == 0x8000);
    if (preinc && access && modifies) {
        return "reads the wrong byte through PREINCn";
    }
    if ((opcode & 0xFE00) == 0xE400) {
        return "BOV or BNOV: OV is wrong after ADDWF, ADDWFC and INCF";
    }
    return "";
}

std::vector<std::string> Chip::lint() const
{
    std::vector<std::string> findings;
    for (const unsigned at : instructions()) {
        const unsigned opcode = self->processor->pma->get_opcode(at);
        const std::string wrong = is_pic18() ? wrong_in_gpsim(opcode) : "";
        if (!wrong.empty()) {
            findings.push_back(printed("%05x: %04x ", at, opcode) + wrong);
        }
    }
    return findings;
}
