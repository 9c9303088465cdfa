// SPDX-License-Identifier: MIT
// Experiments of fixpid_autotune alone, as a chip does them that is too small
// for the result.
#ifndef ALONE_H
#define ALONE_H
#include "fixpid_autotune.h"

#define ALONE_EXPERIMENTS 5
#define ALONE_SIZE (FIXPID_AUTOTUNE_RECORD_SIZE + 9u)

// What an experiment leaves: digests of all outputs and of all that progress
// has told, 4 bytes each, the low byte first; the record; and the status.
extern uint8_t alone_bytes[ALONE_SIZE];

// Does one of them, into alone_bytes.
void alone_do(uint8_t number);

#endif
