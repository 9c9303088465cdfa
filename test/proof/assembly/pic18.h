// SPDX-License-Identifier: MIT
// What a PIC18's instructions work on, and what several of them do alike:
// tools/lib/prove/assembly/pic18.rb has a statement for each. The flags are
// those of the data sheet of the PIC18F4520, without extended instructions.
#ifndef PIC18_H
#define PIC18_H
#include <stdint.h>

#include "claim.h"

// Of the 4096 bytes of memory only banks 0, 2 and 15 are here, for the model
// checker: the assembly is linked there.
struct cpu {
    uint8_t memory[768];
};

#define PLACE(address)                                                         \
    (((address)&0xFFu) | ((address) >= 0xF00u   ? 0x100u                       \
                          : (address) >= 0x200u ? 0x200u                       \
                                                : 0u))
#define BYTE(address) cpu->memory[PLACE(address)]
#define W BYTE(0xFE8u)
#define STATUS BYTE(0xFD8u)
#define BSR BYTE(0xFE0u)
#define PRODH BYTE(0xFF4u)
#define PRODL BYTE(0xFF3u)
#define FSR0H BYTE(0xFEAu)
#define FSR0L BYTE(0xFE9u)

enum { FLAG_C = 1, FLAG_DC = 2, FLAG_Z = 4, FLAG_OV = 8, FLAG_N = 16 };

static int may_change(uint16_t address); // the operands of a claim

// What a function may write: its operands, W, STATUS, BSR, PRODL, PRODH and
// FSR0.
static int writable(uint16_t address)
{
    return (address == 0xFE8u) || (address == 0xFD8u) || (address == 0xFE0u) ||
           (address == 0xFF3u) || (address == 0xFF4u) || (address == 0xFE9u) ||
           (address == 0xFEAu) || may_change(address);
}

static uint8_t get(const struct cpu *cpu, uint16_t address)
{
    must((address < 0x100u) || (address >= 0xF00u) || ((address >> 8) == 2u),
         "it reads from a bank that it knows");
    return BYTE(address);
}

static void put(struct cpu *cpu, uint16_t address, uint8_t value)
{
    must(writable(address), "it changes nothing that the caller needs");
    BYTE(address) = value;
}

// What stands at an address of 12 bits: of the registers that point, only those
// that the assembly uses.
static uint16_t pointed(struct cpu *cpu, uint16_t address)
{
    const uint16_t at = (uint16_t)((FSR0H << 8 | FSR0L) & 0xFFF);

    switch (address) {
    case 0xFEE: // POSTINC0
        FSR0L++;
        FSR0H += (FSR0L == 0u);
        return at;
    case 0xFEB: // PLUSW0
        return (uint16_t)(at + (int8_t)W) & 0xFFFu;
    case 0xFEF: // INDF0
        return at;
    default:
        return address;
    }
}

// The address of an operand, in the bank or, if it is not banked, in access
// RAM.
static uint16_t where(struct cpu *cpu, uint8_t f, uint8_t banked)
{
    const uint16_t access = (f < 0x80u) ? f : (0xF00u | f);

    return pointed(cpu, banked ? (uint16_t)((BSR & 15u) << 8 | f) : access);
}

static void store(struct cpu *cpu, uint16_t f, uint8_t to_f, uint8_t value)
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

static uint8_t zero_and_sign(struct cpu *cpu, uint8_t result)
{
    flags(cpu, FLAG_Z | FLAG_N,
          (result == 0u ? FLAG_Z : 0) | (result & 0x80u ? FLAG_N : 0));
    return result;
}

static uint8_t added(struct cpu *cpu, uint8_t a, uint8_t b, uint8_t carry)
{
    const uint8_t result = (uint8_t)(a + b + carry);

    flags(cpu, FLAG_C | FLAG_DC | FLAG_OV,
          (((unsigned)a + b + carry) > 255u ? FLAG_C : 0) |
              ((a & 15u) + (b & 15u) + carry > 15u ? FLAG_DC : 0) |
              ((a ^ result) & (b ^ result) & 0x80u ? FLAG_OV : 0));
    return zero_and_sign(cpu, result);
}

// Microchip's carry of a subtraction is 1 where nothing is borrowed.
static uint8_t subtracted(struct cpu *cpu, uint8_t a, uint8_t b, uint8_t carry)
{
    return added(cpu, a, (uint8_t)~b, carry);
}

static uint8_t moved_left(struct cpu *cpu, uint8_t a, uint8_t lowest)
{
    flags(cpu, FLAG_C, a >> 7);
    return zero_and_sign(cpu, (uint8_t)(a << 1 | lowest));
}

static uint8_t moved_right(struct cpu *cpu, uint8_t a, uint8_t highest)
{
    flags(cpu, FLAG_C, a & 1u);
    return zero_and_sign(cpu, (uint8_t)(a >> 1 | highest << 7));
}

// Without flags, before a skip.
static uint8_t stepped(struct cpu *cpu, uint16_t f, uint8_t to_f, uint8_t by)
{
    const uint8_t result = (uint8_t)(get(cpu, f) + by);

    store(cpu, f, to_f, result);
    return result;
}

static void multiplied(struct cpu *cpu, uint8_t a, uint8_t b)
{
    const uint16_t product = bytes_product(a, b);

    PRODL = (uint8_t)(product & 0xFFu);
    PRODH = (uint8_t)(product >> 8);
}

static void point(struct cpu *cpu, uint16_t address)
{
    FSR0L = (uint8_t)(address & 0xFFu);
    FSR0H = (uint8_t)(address >> 8);
}

// What a function finds in all that is not an operand.
static void litter(struct cpu *cpu, uint8_t value)
{
    W = STATUS = BSR = PRODH = PRODL = FSR0H = FSR0L = value;
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
