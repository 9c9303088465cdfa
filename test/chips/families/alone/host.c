// SPDX-License-Identifier: MIT
// What a chip's experiments left, beside the same on this machine:
//
//   host RESULTS
//
// Prints
//
//   experiments 5 different 0 gains 3
//
// how many are not the same, and of how many records this machine makes gains.
#include <stdio.h>
#include <string.h>

#include "program.h"

// How the five end: what comes out of it must be something.
static const uint8_t ends[PROGRAM_PARTS] = {
    FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_DONE,
    FIXPID_AUTOTUNE_NO_OSCILLATION, FIXPID_AUTOTUNE_SATURATED};

static bool has_gains(const uint8_t *bytes)
{
    struct fixpid_autotune_record record;
    struct fixpid_autotune tuner;
    struct fixpid_pid_config config = {.output_max = 1};

    (void)memcpy(record.bytes, bytes + 8, sizeof(record.bytes));
    return fixpid_autotune_unpack(&tuner, &record) &&
           fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                  FIXPID_AUTOTUNE_SAFE, &config);
}

int main(int count, char **arguments)
{
    uint8_t of_chip[PROGRAM_SIZE];
    unsigned different = 0;
    unsigned gains = 0;
    FILE *results = (count == 2) ? fopen(arguments[1], "rb") : NULL;

    if (results == NULL) {
        (void)fprintf(stderr, "usage: host RESULTS\n");
        return 2;
    }
    for (uint8_t i = 0; i < PROGRAM_PARTS; i++) {
        (void)memset(of_chip, 0, sizeof(of_chip));
        (void)fread(of_chip, 1, sizeof(of_chip), results);
        program_do(i);
        if (program_bytes[PROGRAM_SIZE - 1u] != ends[i]) {
            (void)fprintf(
                stderr, "experiment %u ends with %u, not %u\n", (unsigned)i,
                (unsigned)program_bytes[PROGRAM_SIZE - 1u], (unsigned)ends[i]);
            return 2;
        }
        different +=
            (memcmp(of_chip, program_bytes, PROGRAM_SIZE) != 0) ? 1u : 0u;
        gains += has_gains(of_chip) ? 1u : 0u;
    }
    (void)fclose(results);
    (void)printf("experiments %d different %u gains %u\n", PROGRAM_PARTS,
                 different, gains);
    return 0;
}
