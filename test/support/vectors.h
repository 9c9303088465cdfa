// SPDX-License-Identifier: MIT
// Rows of a recorded file under test/support/vectors/, in order: read from the
// file on the host, from a table made of the same file where there are no
// files.
#ifndef VECTORS_H
#define VECTORS_H
#include <stdbool.h>
#include <stdint.h>

#define VECTORS_COLUMNS_MAX 77

// The first row comes next. `name` is the file's, without folder and ending.
void vectors_open(const char *name);
void vectors_open_file(const char *path); // any, on the host

// The same of a file that is known here, as VECTORS_OPEN(pid): a program for a
// chip keeps the tables of no others.
#ifdef VECTORS_IN_FLASH
#define VECTORS_OPEN(name)                                                     \
    do {                                                                       \
        void vectors_open_##name(void);                                        \
        vectors_open_##name();                                                 \
    } while (0)
#else
#define VECTORS_OPEN(name) vectors_open(#name)
#endif

// The next row's columns; false after the last one. A file that is missing or
// a row that is not all numbers ends the program.
bool vectors_next(int32_t columns[VECTORS_COLUMNS_MAX]);

extern unsigned vectors_columns; // how many the last row had, on the host

#endif
