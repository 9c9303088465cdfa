// SPDX-License-Identifier: MIT
#include "eva.h"

#include "table/fixpid_table.c"

// Behind its points the memory was never written.
static void ask(uint8_t count)
{
    struct fixpid_table_point points[255];
    const struct fixpid_table table = {points, count};

    Frama_C_make_unknown((char *)points, count * sizeof points[0]);
    if (GOES_ON) {
        (void)fixpid_table_valid(&table);
    } else {
        (void)fixpid_table_at(&table, ANY_INT16);
    }
}

void eva(void)
{
    int count;

    for (count = 0; count <= 255; count++) {
        ask((uint8_t)count);
    }
}
