// SPDX-License-Identifier: MIT
// For a compiler without a C library: what the example calls.
#ifndef STDIO_H
#define STDIO_H

int printf(const char *format, ...);

#endif
