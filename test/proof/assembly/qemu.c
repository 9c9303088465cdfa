// SPDX-License-Identifier: MIT
// Whether QEMU's Cortex-M4 does what tools/lib/prove/assembly/arm.rb says of
// each instruction: a program for that core, which runs the functions of
// another one that have an instruction each, and what was made of them
// (instructions.h), with random registers and flags. It says how many cases
// that were, or what differs.
#include "arm.h"
#include "instructions.h"
#include "put.h"

enum { CASES = 2000, REGISTERS = 12, THUMB = 1 };

struct state {
    uint32_t r[REGISTERS];
    uint32_t flags; // N, Z, C, V and Q, from the highest bit on
};

// Calls a function with this state, and leaves there what it returns with.
__attribute__((naked)) static void run_here(struct state *state, uint32_t entry)
{
    __asm__("push {r0, r4-r11, lr}\n\t"
            "mov r12, r1\n\t"
            "ldr r1, [r0, #48]\n\t"
            "msr apsr_nzcvq, r1\n\t"
            "ldm r0, {r0-r11}\n\t"
            "blx r12\n\t"
            "push {r0}\n\t"
            "ldr r0, [sp, #4]\n\t"
            "add.w r0, r0, #4\n\t"
            "stm r0!, {r1-r11}\n\t"
            "mrs r1, apsr\n\t"
            "str r1, [r0]\n\t"
            "pop {r1}\n\t"
            "str r1, [r0, #-48]\n\t"
            "pop {r0, r4-r11, pc}");
}

static uint32_t random_word(void)
{
    static uint32_t word = 1;

    word ^= word << 13;
    word ^= word >> 17;
    word ^= word << 5;
    return word;
}

// Half of the words are at an end of a range, or near a change of sign.
static uint32_t nasty(void)
{
    static const uint32_t chosen[] = {
        0,          1,          2,          0x7FFF,     0x8000,     0x8001,
        0xFFFF7FFF, 0xFFFF8000, 0xFFFF8001, 0x40000000, 0x7FFFFFFE, 0x7FFFFFFF,
        0x80000000, 0x80000001, 0xC0000000, 0xFFFFFFFE, 0xFFFFFFFF};
    const uint32_t which = random_word() >> 7;

    return (which & 1u)
               ? chosen[(which >> 1) % (sizeof chosen / sizeof chosen[0])]
               : random_word();
}

static void set_both(struct cpu *cpu, struct state *state)
{
    for (unsigned i = 0; i < REGISTERS; i++) {
        R(i) = state->r[i] = nasty();
    }
    state->flags = random_word() & 0xF8000000u;
    cpu->n = (state->flags >> 31) & 1u;
    cpu->z = (state->flags >> 30) & 1u;
    cpu->c = (state->flags >> 29) & 1u;
    cpu->v = (state->flags >> 28) & 1u;
    cpu->q = (state->flags >> 27) & 1u;
}

static bool same(const char *name, const char *what, uint32_t here,
                 uint32_t there)
{
    if (here != there) {
        put_text(name);
        put_text(": ");
        put_text(what);
        put_number(" is ", here);
        put_number(" by the table, and ", there);
        put_text(" by QEMU\n");
    }
    return here == there;
}

static bool both_agree(const struct instruction *one)
{
    static const char *const names[REGISTERS] = {"r0", "r1", "r2",  "r3",
                                                 "r4", "r5", "r6",  "r7",
                                                 "r8", "r9", "r10", "r11"};
    struct cpu on_table;
    struct cpu *const cpu = &on_table;
    struct state state;
    bool good = true;

    set_both(cpu, &state);
    one->run(cpu);
    run_here(&state, one->entry | THUMB);
    for (unsigned i = 0; i < REGISTERS; i++) {
        good &= same(one->name, names[i], R(i), state.r[i]);
    }
    good &= same(one->name, "N", cpu->n, (state.flags >> 31) & 1u);
    good &= same(one->name, "Z", cpu->z, (state.flags >> 30) & 1u);
    good &= same(one->name, "C", cpu->c, (state.flags >> 29) & 1u);
    good &= same(one->name, "V", cpu->v, (state.flags >> 28) & 1u);
    good &= same(one->name, "Q", cpu->q, (state.flags >> 27) & 1u);
    return good;
}

int main(void)
{
    const unsigned count = sizeof instructions / sizeof instructions[0];

    for (unsigned i = 0; i < count; i++) {
        for (unsigned j = 0; j < CASES; j++) {
            if (!both_agree(&instructions[i])) {
                return 1;
            }
        }
    }
    put_number("", count * CASES);
    put_text(" cases\n");
    return 0;
}
