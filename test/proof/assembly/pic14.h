// SPDX-License-Identifier: MIT
// What a mid-range PIC's instructions work on, and what several of them do
// alike: tools/lib/prove/assembly/pic14.rb has a statement for each. The flags
// are those of the data sheet of the PIC16F684.
#ifndef PIC14_H
#define PIC14_H
#include <stdint.h>

#include "claim.h"

// Of the memory only what all banks share: the registers STATUS and PCLATH, and
// from 0x70 on the bytes of SDCC's arguments.
struct cpu {
    uint8_t memory[128];
    uint8_t w;
};

#define PLACE(address) (address)
#define BYTE(address) cpu->memory[address]
#define W cpu->w
#define STATUS BYTE(3u)
#define PCLATH BYTE(0x0Au)

enum { FLAG_C = 1, FLAG_DC = 2, FLAG_Z = 4 };

static int may_change(uint16_t address); // the operands of a claim

static uint8_t get(const struct cpu *cpu, uint8_t f)
{
    must((f == 3u) || (f == 0x0Au) || (f >= 0x70u),
         "it reads what all banks share");
    return BYTE(f);
}

static void put(struct cpu *cpu, uint8_t f, uint8_t value)
{
    must((f == 3u) || (f == 0x0Au) || may_change(f),
         "it changes nothing that the caller needs");
    BYTE(f) = value;
}

static void store(struct cpu *cpu, uint8_t f, uint8_t to_f, uint8_t value)
{
    if (to_f) {
        put(cpu, f, value);
    } else {
        W = value;
    }
}

static void flags(struct cpu *cpu, uint8_t which, uint8_t values)
{
    STATUS = (uint8_t)((STATUS & ~which) | values);
}

static uint8_t zero(struct cpu *cpu, uint8_t result)
{
    flags(cpu, FLAG_Z, result == 0u ? FLAG_Z : 0);
    return result;
}

static uint8_t added(struct cpu *cpu, uint8_t a, uint8_t b, uint8_t carry)
{
    flags(cpu, FLAG_C | FLAG_DC,
          (((unsigned)a + b + carry) > 255u ? FLAG_C : 0) |
              ((a & 15u) + (b & 15u) + carry > 15u ? FLAG_DC : 0));
    return zero(cpu, (uint8_t)(a + b + carry));
}

// Microchip's carry of a subtraction is 1 where nothing is borrowed.
static uint8_t subtracted(struct cpu *cpu, uint8_t a, uint8_t b)
{
    return added(cpu, a, (uint8_t)~b, 1);
}

static uint8_t moved_left(struct cpu *cpu, uint8_t a)
{
    const uint8_t lowest = STATUS & 1u;

    flags(cpu, FLAG_C, a >> 7);
    return (uint8_t)(a << 1 | lowest);
}

static uint8_t moved_right(struct cpu *cpu, uint8_t a)
{
    const uint8_t highest = STATUS & 1u;

    flags(cpu, FLAG_C, a & 1u);
    return (uint8_t)(a >> 1 | highest << 7);
}

// Without flags, before a skip.
static uint8_t stepped(struct cpu *cpu, uint8_t f, uint8_t to_f, uint8_t by)
{
    const uint8_t result = (uint8_t)(get(cpu, f) + by);

    store(cpu, f, to_f, result);
    return result;
}

// What a function finds in all that is not an operand.
static void litter(struct cpu *cpu, uint8_t value)
{
    for (uint8_t f = 0x70; f < 0x80u; f++) {
        BYTE(f) = value;
    }
    W = STATUS = value;
}

static void begin(struct cpu *cpu)
{
    (void)cpu;
}

// `put` sees to it.
static int kept(const struct cpu *before, const struct cpu *cpu, unsigned any)
{
    (void)before;
    (void)cpu;
    (void)any;
    return 1;
}

#endif
