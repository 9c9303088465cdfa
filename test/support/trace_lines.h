// SPDX-License-Identifier: MIT
// The trace of random experiments, for a model in Ruby: what
// trace_lines.c and test/model/autotune/trace.c have of each other.
#ifndef TRACE_LINES_H
#define TRACE_LINES_H
#include <stdint.h>

// The program's own: one experiment, whose number chooses its kind, or that
// many of them. Each call is said.
void trace_experiment(uint32_t number);
void trace_experiments(long runs);

// A line: the kind of the call, what it was given and what it answered.
void trace_say(char kind, const int32_t values[], uint8_t count);

#endif
