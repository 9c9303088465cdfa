// SPDX-License-Identifier: MIT
// Whether simavr does what tools/lib/prove/assembly/avr.rb says of each
// instruction: `simavr PROGRAM.elf` runs the functions of that program, which
// have an instruction each, and what was made of them (instructions.h), with
// random registers and flags. It says how many instructions and cases that
// were, or what differs.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/sim_avr.h>
#include <simavr/sim_core.h>
#include <simavr/sim_elf.h>

#include "avr.h"
#include "instructions.h"

enum { CASES = 5000, BEHIND = 0x7000, STACK = 0x8F0, STEPS_MOST = 20 };

static avr_t *avr;

// Half of the bytes are at an end of their range, or near a change of sign.
static uint8_t nasty(void)
{
    static const uint8_t chosen[] = {0,    1,    2,    0x0F, 0x10, 0x55,
                                     0x7F, 0x80, 0x81, 0xF0, 0xFE, 0xFF};
    const unsigned random = (unsigned)rand() >> 7;

    return (random & 1u) ? chosen[(random >> 1) % sizeof chosen]
                         : (uint8_t)(random >> 1);
}

static void set_both(struct cpu *cpu, uint32_t entry)
{
    const uint8_t flags = nasty();

    memset(cpu, 0, sizeof *cpu);
    for (unsigned i = 0; i < 32u; i++) {
        cpu->r[i] = avr->data[i] = nasty();
    }
    for (unsigned i = 0; i < 8u; i++) {
        avr->sreg[i] = (flags >> i) & 1u;
    }
    avr->sreg[S_I] = 0;
    avr->sreg[S_S] = avr->sreg[S_N] ^ avr->sreg[S_V];
    cpu->c = avr->sreg[S_C];
    cpu->z = avr->sreg[S_Z];
    cpu->n = avr->sreg[S_N];
    cpu->v = avr->sreg[S_V];
    cpu->h = avr->sreg[S_H];
    cpu->t = avr->sreg[S_T];
    avr->data[STACK + 1] = (BEHIND / 2) >> 8;
    avr->data[STACK + 2] = (BEHIND / 2) & 0xFF;
    avr->data[R_SPL] = STACK & 0xFF;
    avr->data[R_SPH] = STACK >> 8;
    avr->pc = entry;
}

static bool same(const char *name, const char *what, unsigned here,
                 unsigned there)
{
    if (here != there) {
        printf("%s: %s is 0x%02X by the table, and 0x%02X by simavr\n", name,
               what, here, there);
    }
    return here == there;
}

static bool both_agree(const struct instruction *one)
{
    struct cpu cpu;
    bool good = true;
    unsigned steps = 0;

    set_both(&cpu, one->entry);
    one->run(&cpu);
    while ((avr->pc != BEHIND) && (steps++ < STEPS_MOST)) {
        avr->pc = avr_run_one(avr);
    }
    good &= same(one->name, "the end", BEHIND, avr->pc);
    for (unsigned i = 0; i < 32u; i++) {
        char what[8];

        (void)snprintf(what, sizeof what, "r%u", i);
        good &= same(one->name, what, cpu.r[i], avr->data[i]);
    }
    good &= same(one->name, "C", cpu.c, avr->sreg[S_C]);
    good &= same(one->name, "Z", cpu.z, avr->sreg[S_Z]);
    good &= same(one->name, "N", cpu.n, avr->sreg[S_N]);
    good &= same(one->name, "V", cpu.v, avr->sreg[S_V]);
    good &= same(one->name, "S", cpu.n ^ cpu.v, avr->sreg[S_S]);
    good &= same(one->name, "H", cpu.h, avr->sreg[S_H]);
    good &= same(one->name, "T", cpu.t, avr->sreg[S_T]);
    good &= same(one->name, "the stack pointer", cpu.sp, 0);
    return good;
}

int main(int argc, char **argv)
{
    const unsigned count = sizeof instructions / sizeof instructions[0];
    elf_firmware_t program;

    memset(&program, 0, sizeof program);
    avr = avr_make_mcu_by_name("atmega328p");
    if ((argc != 2) || (avr == NULL) || (avr_init(avr) != 0) ||
        (elf_read_firmware(argv[1], &program) != 0)) {
        fprintf(stderr, "simavr: no such program\n");
        return 2;
    }
    avr_load_firmware(avr, &program);
    for (unsigned i = 0; i < count; i++) {
        for (unsigned j = 0; j < CASES; j++) {
            if (!both_agree(&instructions[i])) {
                return 1;
            }
        }
    }
    printf("%u cases\n", count * CASES);
    return 0;
}
