// SPDX-License-Identifier: MIT
// What assert.rb makes of the headers, for assert.c.
#ifndef CALLS_H
#define CALLS_H
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The text of each call, and a null pointer at the end.
extern const char *const calls[];

// Makes one of them, with a wrong pointer or with a right one.
void call(int number, bool wrong);

#ifdef __cplusplus
}
#endif

#endif
