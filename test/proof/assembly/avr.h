// SPDX-License-Identifier: MIT
// What an AVR's instructions work on, and what several of them do alike:
// tools/lib/prove/assembly/avr.rb has a statement for each. The flags are those
// of the AVR Instruction Set Manual; S is N xor V and has no place of its own.
#ifndef AVR_H
#define AVR_H
#include <stdint.h>

#include "claim.h"

struct cpu {
    uint8_t r[32];
    uint8_t c, z, n, v, h, t; // each 0 or 1
    uint8_t stack[256];
    uint8_t sp; // of the next byte that is pushed
};

#define R cpu->r

static void zero_and_sign(struct cpu *cpu, uint8_t result)
{
    cpu->z = (result == 0u);
    cpu->n = result >> 7;
}

static uint8_t added(struct cpu *cpu, uint8_t a, uint8_t b, uint8_t carry)
{
    const uint8_t result = (uint8_t)(a + b + carry);

    cpu->h = ((a & 15u) + (b & 15u) + carry) > 15u;
    cpu->c = ((unsigned)a + b + carry) > 255u;
    cpu->v = (uint8_t)((a ^ result) & (b ^ result)) >> 7;
    zero_and_sign(cpu, result);
    return result;
}

static uint8_t subtracted(struct cpu *cpu, uint8_t a, uint8_t b, uint8_t carry)
{
    const uint8_t result = (uint8_t)(a - b - carry);

    cpu->h = (a & 15u) < ((b & 15u) + carry);
    cpu->c = a < ((unsigned)b + carry);
    cpu->v = (uint8_t)((a ^ b) & (a ^ result)) >> 7;
    zero_and_sign(cpu, result);
    return result;
}

// Z stays 0 if a byte below was not 0.
static uint8_t subtracted_on(struct cpu *cpu, uint8_t a, uint8_t b)
{
    const uint8_t z = cpu->z;
    const uint8_t result = subtracted(cpu, a, b, cpu->c);

    cpu->z &= z;
    return result;
}

static uint8_t logical(struct cpu *cpu, uint8_t result)
{
    zero_and_sign(cpu, result);
    cpu->v = 0;
    return result;
}

static uint8_t complemented(struct cpu *cpu, uint8_t a)
{
    cpu->c = 1;
    return logical(cpu, (uint8_t)~a);
}

static uint8_t stepped(struct cpu *cpu, uint8_t result, uint8_t overflow)
{
    zero_and_sign(cpu, result);
    cpu->v = (result == overflow);
    return result;
}

static uint8_t moved_right(struct cpu *cpu, uint8_t a, uint8_t highest)
{
    const uint8_t result = (uint8_t)((a >> 1) | (highest << 7));

    cpu->c = a & 1u;
    zero_and_sign(cpu, result);
    cpu->v = cpu->n ^ cpu->c;
    return result;
}

// The products leave their result in r1 and r0; C is its bit 15.
static void multiplied(struct cpu *cpu, uint16_t result)
{
    cpu->r[0] = (uint8_t)(result & 0xFFu);
    cpu->r[1] = (uint8_t)(result >> 8);
    cpu->c = result >> 15;
    cpu->z = (result == 0u);
}

static uint16_t signed_by_unsigned(uint8_t a, uint8_t b)
{
    return (uint16_t)(bytes_product(a, b) - ((a & 0x80u) ? b << 8 : 0));
}

static uint16_t signed_by_signed(uint8_t a, uint8_t b)
{
    return (uint16_t)(signed_by_unsigned(a, b) - ((b & 0x80u) ? a << 8 : 0));
}

static void multiplied_fractions(struct cpu *cpu, uint16_t result)
{
    multiplied(cpu, (uint16_t)(result << 1));
    cpu->c = result >> 15;
}

static void push(struct cpu *cpu, uint8_t value)
{
    cpu->stack[cpu->sp--] = value;
}

static uint8_t pop(struct cpu *cpu)
{
    return cpu->stack[++cpu->sp];
}

// What a function finds in all that is not an operand.
static void litter(struct cpu *cpu, uint8_t value)
{
    for (unsigned i = 0; i < 32u; i++) {
        cpu->r[i] = value;
    }
    cpu->c = cpu->z = cpu->n = cpu->v = cpu->h = cpu->t = value & 1u;
    cpu->r[1] = 0;
}

// What gcc's code relies on.
static void begin(struct cpu *cpu)
{
    uint8_t *const flags[] = {&cpu->c, &cpu->z, &cpu->n,
                              &cpu->v, &cpu->h, &cpu->t};

    for (unsigned i = 0; i < 6u; i++) {
        *flags[i] &= 1u;
    }
    cpu->r[1] = 0;
    cpu->sp = 200;
}

// What a function of gcc must leave as it was: r1, which is 0, r2 to r17, r28
// and r29, the stack and what is on it.
static int kept(const struct cpu *before, const struct cpu *cpu, unsigned any)
{
    const unsigned i = any % 30u;
    const unsigned j = any % 256u;
    const int saved = ((i >= 1u) && (i <= 17u)) || (i >= 28u);

    return (!saved || (cpu->r[i] == before->r[i])) && (cpu->sp == before->sp) &&
           ((j <= before->sp) || (cpu->stack[j] == before->stack[j]));
}

#endif
