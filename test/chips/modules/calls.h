// SPDX-License-Identifier: MIT
// Calls of a module, recorded and random, the same on every machine. Each
// answer goes into a digest, which the machines compare.
#ifndef CALLS_H
#define CALLS_H
#include <stdbool.h>
#include <stdint.h>

// Of the module that this program is built with: calls_slew.c and the like.
void calls_rows(void);
void calls_random(uint32_t count);

// An answer. `defined` is what the definition answers; where the definition is
// not compiled, the program gives the same number twice.
void calls_answer(uint32_t given, uint32_t defined);

// Before the first call and after the last, in a program that is built with
// -DCALLS_METERED: test/tools/cost/qemu/calls.c.
void calls_begin(void);
void calls_end(void);

// DEFINED(d, given) is d where the definition is compiled (-DCALLS_DEFINED).
#ifdef CALLS_DEFINED
#define DEFINED(definition, given) ((uint32_t)(definition))
#else
#define DEFINED(definition, given) (given)
#endif

#endif
