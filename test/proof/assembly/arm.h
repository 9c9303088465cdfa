// SPDX-License-Identifier: MIT
// What a Cortex-M's instructions work on, and what several of them do alike:
// tools/lib/prove/assembly/arm.rb has a statement for each. The flags are those
// of the ARMv7-M Architecture Reference Manual: after a difference C is 1 if
// nothing was borrowed.
#ifndef ARM_H
#define ARM_H
#include <stdint.h>

#include "claim.h"

// Of machines whose lowest byte is first: this one and the ARM.
union word {
    uint32_t value;
    uint8_t bytes[4];
};

struct cpu {
    union word r[15];      // r13 is sp, r14 is lr
    uint8_t n, z, c, v, q; // each 0 or 1
    uint32_t caller;       // where it returns to
};

#define R(number) cpu->r[number].value

static uint32_t sign_and_zero(struct cpu *cpu, uint32_t result)
{
    cpu->n = result >> 31;
    cpu->z = (result == 0u);
    return result;
}

static uint32_t added(struct cpu *cpu, uint32_t a, uint32_t b, uint8_t carry)
{
    const uint32_t result = a + b + carry;

    cpu->c = ((uint64_t)a + b + carry) > UINT32_MAX;
    cpu->v = ((a ^ result) & (b ^ result)) >> 31;
    return sign_and_zero(cpu, result);
}

// By 1 to 31.
static uint32_t moved_left(struct cpu *cpu, uint32_t a, unsigned places)
{
    cpu->c = (a >> (32u - places)) & 1u;
    return sign_and_zero(cpu, a << places);
}

// By 1 to 32.
static uint32_t moved_right(struct cpu *cpu, uint32_t a, unsigned places)
{
    cpu->c = (a >> (places - 1u)) & 1u;
    return sign_and_zero(cpu, (places == 32u) ? 0u : a >> places);
}

// Q stays 1.
static uint32_t saturated(struct cpu *cpu, int64_t a, unsigned bits)
{
    const int64_t most = ((int64_t)1 << (bits - 1u)) - 1;
    const int64_t fitting = (a > most) ? most : (a < -most - 1) ? -most - 1 : a;

    cpu->q |= (a != fitting);
    return (uint32_t)fitting;
}

static void begin(struct cpu *cpu)
{
    uint8_t *const flags[] = {&cpu->n, &cpu->z, &cpu->c, &cpu->v, &cpu->q};

    for (unsigned i = 0; i < 5u; i++) {
        *flags[i] &= 1u;
    }
    cpu->caller = R(14);
}

// What a function must leave as it was: r4 to r11 and sp. `bx` says where it
// returns to. The functions have no instruction that writes to memory.
static int kept(const struct cpu *before, const struct cpu *cpu, unsigned any)
{
    const unsigned i = 4u + (any % 10u);

    return (i == 12u) || (R(i) == before->r[i].value);
}

#endif
