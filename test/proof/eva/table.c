// SPDX-License-Identifier: MIT
#include "eva.h"

#include "table/fixpid_table.c"

void eva(void)
{
    struct fixpid_table_point points[255];
    struct fixpid_table table = {points, 0};

    for (int i = 0; i < 255; i++) {
        points[i].x = ANY_INT16;
        points[i].y = ANY_INT16;
    }
    table.count = ANY_UINT8;
    (void)fixpid_table_valid(&table);
    (void)fixpid_table_at(&table, ANY_INT16);
}
