// SPDX-License-Identifier: MIT
// What chip.cc hangs into gpsim: its console, clock, memory, pins and stack.
// gpsim refers to most of these until the program ends, so they are never
// freed.
#ifndef PARTS_HH
#define PARTS_HH
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <deque>
#include <functional>
#include <iostream>
#include <string>
#include <utility>

// gpsim's headers need this one first.
#include <gpsim/processor.h>

#include <gpsim/14bit-registers.h>
#include <gpsim/breakpoints.h>
#include <gpsim/clock_phase.h>
#include <gpsim/gpsim_interface.h>
#include <gpsim/gpsim_time.h>
#include <gpsim/interface.h>
#include <gpsim/pic-processor.h>
#include <gpsim/sim_context.h>
#include <gpsim/stimuli.h>
#include <gpsim/symbol.h>
#include <gpsim/ui.h>

#include "chip.hh"

namespace parts
{

constexpr double supply_volts = 5.0;
constexpr double source_ohms = 1.0; // 100 would lose code 1023
constexpr double probe_ohms = 1e9;

// What gpsim prints, but for what a PIC18F26K22's Timer2 says in each period of
// CCP1's PWM of a CCP2 that compares.
struct Printed : std::stringbuf {
    std::streamsize xsputn(const char *text, std::streamsize size) override
    {
        return std::string(text, (size_t)size) == "not pwm mode. bug?\n"
                   ? size
                   : std::stringbuf::xsputn(text, size);
    }
};

// gpsim's command line, which we do not have; its messages go with the others.
struct Console : ISimConsole {
    void Printf(const char *format, ...) override
    {
        va_list arguments;
        va_start(arguments, format);
        VPrintf(format, arguments);
        va_end(arguments);
    }
    void VPrintf(const char *format, va_list arguments) override
    {
        char text[500];
        (void)vsnprintf(text, sizeof(text), format, arguments);
        std::cout << text;
    }
    void Puts(const char *text) override
    {
        std::cout << text;
    }
    void Putc(const char letter) override
    {
        std::cout << letter;
    }
    const char *Gets(char *text, int) override
    {
        text[0] = '\0';
        return text;
    }
};

struct Periodic : TriggerObject {
    uint64_t period;
    Chip::Action action;

    Periodic(uint64_t cycles, Chip::Action what)
        : period(cycles), action(std::move(what))
    {
    }
    void callback() override
    {
        get_cycles().set_break(get_cycles().get() + period, this);
        action();
    }
};

// The bits of a byte at a UART's input: a start bit, the lowest first, and a
// stop bit, which is the line at rest.
struct Arrival : TriggerObject {
    Chip *chip;
    unsigned line;
    unsigned bits = 0; // those to come
    unsigned cycles = 0;

    explicit Arrival(Chip *of) : chip(of), line(of->analog_input("portc7"))
    {
        chip->set_volts(line, supply_volts);
    }
    void begin(unsigned byte, unsigned cycles_a_bit)
    {
        bits = (byte | 0x100u) << 1;
        cycles = cycles_a_bit;
        callback();
    }
    void callback() override
    {
        chip->set_volts(line, (bits & 1u) != 0 ? supply_volts : 0);
        bits >>= 1;
        if (bits != 0) {
            get_cycles().set_break(get_cycles().get() + cycles, this);
        }
    }
};

// Ends a run from between two instructions: a halt from inside one would lose
// its cycle.
struct Halt : TriggerObject {
    bool armed = false;

    void callback() override
    {
        armed = false;
        get_bp().halt();
    }
    void arm(uint64_t cycle)
    {
        if (armed) {
            get_cycles().clear_break(this);
        }
        armed = get_cycles().set_break(cycle, this);
    }
};

// In program memory in front of an instruction. gpsim's own notify breakpoints
// would do, but only 1024 of them can exist, and more are ignored silently.
struct Watched : AliasedInstruction {
    Chip::Action
        returned; // first: an interrupt may return to a routine's entry
    std::deque<Chip::Action> actions; // stays in place while it grows
    bool one_cycle_short = false;

    Watched(Processor *processor, unsigned address, instruction *original)
        : AliasedInstruction(processor, original->get_opcode(), address)
    {
        setReplaced(original);
    }
    void execute() override
    {
        if (returned) {
            returned();
        }
        for (size_t i = 0; i < actions.size(); i++) {
            actions[i]();
        }
        if (one_cycle_short) {
            get_cycles().increment(); // after the meters have read the clock
        }
        m_replaced->execute();
    }
};

// Erased program memory, which gpsim would run through as NOPs.
struct Erased : invalid_instruction {
    Processor *processor;
    unsigned address;
    Chip::ValueAction action;

    Erased(Processor *where, unsigned at, Chip::ValueAction what)
        : invalid_instruction(where, at, 0), processor(where), address(at),
          action(std::move(what))
    {
    }
    void execute() override
    {
        action(address);
        processor->pc->increment();
    }
};

struct WrittenRegister : BreakpointRegister {
    Chip::ValueAction action;

    WrittenRegister(Processor *processor, unsigned address,
                    Chip::ValueAction what)
        : BreakpointRegister(processor, nullptr, (int)address, 0),
          action(std::move(what))
    {
    }
    void put(unsigned value) override
    {
        getReplaced()->put(value);
        action(value);
    }
    void putRV(RegisterValue value) override
    {
        getReplaced()->putRV(value);
        action(value.data);
    }
};

struct ReadRegister : BreakpointRegister {
    Chip::Action action;

    ReadRegister(Processor *processor, unsigned address, Chip::Action what)
        : BreakpointRegister(processor, nullptr, (int)address, 0),
          action(std::move(what))
    {
    }
    unsigned get() override
    {
        action();
        return getReplaced()->get();
    }
    RegisterValue getRV() override
    {
        action();
        return getReplaced()->getRV();
    }
    RegisterValue getRVN() override
    {
        action();
        return getReplaced()->getRVN();
    }
};

struct Source : stimulus {
    explicit Source(const std::string &name)
        : stimulus(name.c_str(), 0.0, source_ohms)
    {
        bDriving = true;
    }
};

struct Probe : stimulus {
    bool level = false;
    uint64_t since = 0;
    uint64_t high = 0;
    uint64_t edges = 0;
    Chip::ValueAction action;

    explicit Probe(const std::string &name)
        : stimulus(name.c_str(), 0.0, probe_ohms)
    {
    }
    void account()
    {
        const uint64_t now = get_cycles().get();
        high += level ? (now - since) : 0;
        since = now;
    }
    void set_nodeVoltage(double volts) override
    {
        stimulus::set_nodeVoltage(volts);
        const bool now_high = (volts > supply_volts / 2.0);
        if (now_high != level) {
            account();
            level = now_high;
            edges++;
            if (action) {
                action(level ? 1 : 0);
            }
        }
    }
};

// The hardware stack, with its limits and its resets in view.
struct GuardedStack : Stack {
    Stack *real;
    std::function<void(const std::string &)> fault;
    unsigned most = 0;
    uint64_t last_push = 0;

    GuardedStack(Processor *processor, Stack *stack)
        : Stack(processor), real(stack)
    {
    }
    unsigned size() const
    {
        // A PIC18's has 31 levels: a pointer of 0 is its empty stack.
        return (real->stack_mask == 31) ? 31 : real->stack_mask + 1;
    }
    // Levels that are taken. An enhanced PIC16's empty stack has a pointer of
    // its own.
    unsigned depth() const
    {
        return (real->pointer == NO_ENTRY)
                   ? 0
                   : (unsigned)std::max(real->pointer, 0);
    }
    bool push(unsigned address) override
    {
        last_push = get_cycles().get();
        if (depth() >= size()) {
            fault("return stack overflow: more than " + std::to_string(size()) +
                  " levels");
            return true; // the run ends; do not let gpsim reset the chip
        }
        const bool pushed = real->push(address);
        most = std::max(most, depth());
        return pushed;
    }
    unsigned pop() override
    {
        if (depth() == 0) {
            fault("return stack underflow: a return without a call");
            return 0;
        }
        return real->pop();
    }
    void reset(RESET_TYPE type) override
    {
        real->reset(type);
        if (type == WDT_RESET) {
            fault("watchdog reset");
        } else if (type == SOFT_RESET) {
            fault("reset by a RESET instruction");
        } else if ((type != EXIT_RESET) && (type != SIM_RESET)) {
            fault("reset of the chip, type " + std::to_string((int)type));
        }
    }
    bool stack_overflow() override
    {
        return real->stack_overflow();
    }
    bool stack_underflow() override
    {
        return real->stack_underflow();
    }
    bool set_break_on_overflow(bool on) override
    {
        return real->set_break_on_overflow(on);
    }
    bool set_break_on_underflow(bool on) override
    {
        return real->set_break_on_underflow(on);
    }
    unsigned get_tos() override
    {
        return real->get_tos();
    }
    void put_tos(unsigned address) override
    {
        real->put_tos(address);
    }
    unsigned top() const
    {
        return real->contents[(depth() - 1) & real->stack_mask];
    }
};

} // namespace parts

#endif
