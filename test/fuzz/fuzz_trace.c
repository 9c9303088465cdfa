// SPDX-License-Identifier: MIT
// The autotuner: the input is an experiment. What was asked and answered is
// printed, after the input itself, for the model of the definition in Ruby
// (test/model/autotune), which stops at the first difference.
#include <setjmp.h>
#include <stdio.h>

#include "fuzz.h"
#include "numbers.h"
#include "trace_lines.h"

// A longer experiment is broken off: few things are new so late.
#define LINES_MAX 4000u

static jmp_buf too_long;
static uint32_t lines;

void trace_say(char kind, const int32_t values[], uint8_t count)
{
    if (lines == LINES_MAX) {
        longjmp(too_long, 1);
    }
    lines++;
    printf("%c", kind);
    for (uint8_t at = 0; at < count; at++) {
        printf(" %ld", (long)values[at]);
    }
    printf("\n");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    printf("x ");
    for (size_t at = 0; at < size; at++) {
        printf("%02x", data[at]);
    }
    printf("\n");
    numbers_from(data, size);
    lines = 0;
    if (setjmp(too_long) == 0) {
        trace_experiment(numbers_below(256));
    }
    fflush(stdout); // before anything stops this program
    return 0;
}
