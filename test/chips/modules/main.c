// SPDX-License-Identifier: MIT
// Answers the recorded and CALLS random calls of one module. A machine with a
// terminal prints
//
//   rows 0123abcd random 89abcdef different 0
//
// the digests of the answers, and how many are not as defined where the
// definition is compiled (-DCALLS_DEFINED). Any other one (-DCALLS_SILENT) ends
// with `done` at 1 and leaves the numbers in these variables. A chip of
// test/chips/families/ (-DCALLS_PART) has room for the random calls only.
#include "calls.h"

#include "numbers.h"

#ifndef CALLS
#define CALLS 2000
#endif

volatile uint32_t rows_digest;
volatile uint32_t random_digest;
volatile uint8_t done;

static uint32_t digest, different;

#ifdef CALLS_SILENT
#include "compiler.h"
#include "configuration.h"
#define ALIVE() PORT_CLEAR_WATCHDOG()
#else
#define ALIVE() ((void)0)
#endif

// Turned by 5 bits, and the answer added: cheap for a chip, and no answer
// leaves it as it was.
void calls_answer(uint32_t given, uint32_t defined)
{
    ALIVE();
    digest = ((digest & UINT32_C(0x7FFFFFF)) << 5) | (digest >> 27);
    digest += given + 1u;
    if (given != defined) {
        different++;
    }
}

#ifdef CALLS_METERED
#define BEGIN() calls_begin()
#define END() calls_end()
#else
#define BEGIN() ((void)0)
#define END() ((void)0)
#endif

static void answer_random(void)
{
    numbers_seed(2026);
    digest = 0;
    calls_random(CALLS);
    random_digest = digest;
}

#ifdef CALLS_PART
#include "program.h"

uint8_t program_bytes[PROGRAM_SIZE];

void program_do(uint8_t part)
{
    (void)part;
    answer_random();
    for (uint8_t i = 0; i < PROGRAM_SIZE; i++) {
        program_bytes[i] = (uint8_t)(random_digest >> (8u * i));
    }
}

#else

static void answer_all(void)
{
    different = 0;
    answer_random();
    digest = 0;
    calls_rows();
    rows_digest = digest;
}

#ifdef CALLS_SILENT

void main(void)
{
    done = 0;
    answer_all();
    done = 1;
    for (;;) {
        ALIVE();
    }
}

#else

#include <stdio.h>

static void put_text(const char *text)
{
    while (*text != '\0') {
        putchar(*text);
        text++;
    }
}

static void put_hexadecimal(uint32_t value)
{
    for (uint8_t digit = 0; digit < 8u; digit++) {
        putchar("0123456789abcdef"[(value >> (28u - 4u * digit)) & 15u]);
    }
}

int main(void)
{
    BEGIN();
    answer_all();
    END();
    put_text("rows ");
    put_hexadecimal(rows_digest);
    put_text(" random ");
    put_hexadecimal(random_digest);
    put_text(" different ");
    put_hexadecimal(different);
    put_text("\n");
    return different == 0u ? 0 : 1;
}

#endif
#endif
