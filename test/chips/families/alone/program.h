// SPDX-License-Identifier: MIT
// What a chip does in parts, each of which leaves bytes: the experiments of
// alone.c or, built with -DCALLS_PART, the random calls of a module.
#ifndef PROGRAM_H
#define PROGRAM_H

#ifdef CALLS_PART
#include <stdint.h>

#define PROGRAM_PARTS 1
#define PROGRAM_SIZE 4u // the digest of all answers
#else
#include "fixpid_autotune.h"

// Digests of all outputs and of all that progress has told; the record; and the
// status. What has more than one byte has its low byte first.
#define PROGRAM_PARTS 5
#define PROGRAM_SIZE (FIXPID_AUTOTUNE_RECORD_SIZE + 9u)
#endif

// What a part leaves.
extern uint8_t program_bytes[PROGRAM_SIZE];

// Does one of them, into program_bytes.
void program_do(uint8_t part);

#endif
