// SPDX-License-Identifier: MIT
// `trace RUNS` prints the lines. Built with -DTRACE_RUNS=COUNT, for a machine
// without arguments and files, it prints a digest of all that instead.
#include "trace_lines.h"

#include <stdio.h>

#ifdef TRACE_RUNS

static uint32_t digest = UINT32_C(2166136261);

// FNV-1a over the bytes.
void trace_say(char kind, const int32_t values[], uint8_t count)
{
    digest = (digest ^ (uint8_t)kind) * UINT32_C(16777619);
    for (uint8_t at = 0; at < count; at++) {
        for (uint8_t shift = 0; shift < 32; shift = (uint8_t)(shift + 8u)) {
            const uint8_t byte = (uint8_t)((uint32_t)values[at] >> shift);

            digest = (digest ^ byte) * UINT32_C(16777619);
        }
    }
}

int main(void)
{
    trace_experiments(TRACE_RUNS);
    for (uint8_t digit = 0; digit < 8u; digit++) {
        putchar("0123456789abcdef"[(digest >> (28u - 4u * digit)) & 15u]);
    }
    putchar('\n');
    return 0;
}

#else

#include <stdlib.h>

void trace_say(char kind, const int32_t values[], uint8_t count)
{
    printf("%c", kind);
    for (uint8_t at = 0; at < count; at++) {
        printf(" %ld", (long)values[at]);
    }
    printf("\n");
}

int main(int argc, char *argv[])
{
    const long runs = argc == 2 ? strtol(argv[1], NULL, 10) : 0;

    trace_experiments(runs);
    return runs > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
