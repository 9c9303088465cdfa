// SPDX-License-Identifier: MIT
// The digests of all arithmetic on a machine whose program can print: each line
// is of a sixteenth of a controller's rows. Those that are ARITH_ROWS_APART
// apart are digested: 1, 2, 4 or 8.
#include "arith.h"
#include "put.h"

#ifndef ARITH_ROWS_APART
#define ARITH_ROWS_APART 1
#endif

static uint32_t digest;

static void add_row(void (*arith)(void), uint16_t row)
{
    arith_row = row;
    arith();
    digest = digest * UINT32_C(16777619) + arith_digest;
}

static void print_digest(const char *name)
{
    put_text(name);
    put_number(" rows to ", arith_row);
    put_text(" digest ");
    put_hexadecimal(digest);
    put_text("\n");
}

static void all_rows(const char *name, void (*arith)(void), uint16_t rows)
{
    digest = 0;
    for (uint16_t row = ARITH_ROWS_APART - 1u; row < rows;
         row += ARITH_ROWS_APART) {
        add_row(arith, row);
        if ((row + 1u) % (rows / 16u) == 0u) {
            print_digest(name);
        }
    }
}

int main(void)
{
    all_rows("an937", an937_arith, 256);
    add_row(an937_arith, 256 + 255); // of all magnitudes
    print_digest("an937");
    all_rows("an964", an964_arith, 1024);
    all_rows("an964_8bit", an964_8bit_arith, 128);
    all_rows("pid", pid_arith, 256);
    return 0;
}
