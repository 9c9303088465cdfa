// SPDX-License-Identifier: MIT
// An autotuner: the input is an experiment. What was asked and answered is
// printed, after the input itself, for the model of the definition in Ruby
// (test/relay, test/autotune), which stops at the first difference.
#include <stdio.h>

#include "fuzz.h"
#include "numbers.h"
#include "trace_lines.h"

void trace_say(char kind, const int32_t values[], uint8_t count)
{
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
    trace_experiment(numbers_below(256));
    fflush(stdout); // before anything stops this program
    return 0;
}
