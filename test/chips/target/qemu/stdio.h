// SPDX-License-Identifier: MIT
// What the tests use of the C library; runtime.c has it.
#ifndef STDIO_H
#define STDIO_H

int putchar(int character);

#endif
