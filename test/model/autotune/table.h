// SPDX-License-Identifier: MIT
// Rows of test/support/vectors/autotune.csv, as table.rb compiles them in.
#ifndef AUTOTUNE_TABLE_H
#define AUTOTUNE_TABLE_H
#include "player.h"

struct table_row {
    struct player_row row;
    uint32_t recorded; // player_digest of what must come out
};

extern const struct table_row table_rows[];
extern const uint16_t table_count;

#endif
