// SPDX-License-Identifier: MIT
// What stands beside a controller against its definition: the calls of
// test/chips/modules, which the input chooses.
#include <stdio.h>
#include <stdlib.h>

#include "calls.h"
#include "fuzz.h"

#define BYTES_OF_A_CALL 8u // about: with some more, the last ones are random

void calls_answer(uint32_t given, uint32_t defined)
{
    if (given != defined) {
        fprintf(stderr, "%lu, defined as %lu\n", (unsigned long)given,
                (unsigned long)defined);
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    numbers_from(data, size);
    calls_random((uint32_t)size / BYTES_OF_A_CALL + 1u);
    return 0;
}
