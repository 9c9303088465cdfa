// SPDX-License-Identifier: MIT
// Random points of fixpid_table, and where they are looked up.
#ifndef NUMBERS_TABLE_H
#define NUMBERS_TABLE_H
#include "fixpid_table.h"

// `most` points or fewer, nearly always in order. pre: most <= 255
uint8_t numbers_table_points(struct fixpid_table_point points[], uint8_t most);

// Where that table is looked up: at its points, near them, and elsewhere.
int16_t numbers_table_x(const struct fixpid_table_point points[],
                        uint8_t count);

#endif
