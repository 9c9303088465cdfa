// SPDX-License-Identifier: MIT
// Records from outside: any bytes, and any bytes with a check that is right.
// What fixpid_record_unpack takes is what its header says, fixpid_pid_init
// takes of that what its definition takes, and a controller that was started so
// stays within its limits.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_record.h"
#include "fuzz.h"
#include "numbers.h"
#include "reference_pid.h"

#define CHECK_BIT (8u * (FIXPID_RECORD_SIZE - 2u))
#define STEPS 4

static struct fixpid_record record;

static void demand(bool fact, const char *sentence)
{
    if (!fact) {
        fprintf(stderr, "%s, defined as so\n", sentence);
        abort();
    }
}

// The remainder of the division by x^16 + x^12 + x^5 + 1, bit by bit.
static unsigned defined_check(void)
{
    unsigned rest = 0xFFFF;

    for (unsigned bit = 0; bit < CHECK_BIT; bit++) {
        const unsigned in = record.bytes[bit / 8u] >> (7u - bit % 8u) & 1u;

        const unsigned out = (rest >> 15 ^ in) & 1u;

        rest = (rest << 1 & 0xFFFFu) ^ (out != 0u ? 0x1021u : 0u);
    }
    return rest;
}

static void fill(void)
{
    const uint32_t kind = numbers_below(8);
    unsigned check;

    for (unsigned at = 0; at < FIXPID_RECORD_SIZE; at++) {
        record.bytes[at] = (uint8_t)numbers_below(256);
    }
    if (kind < 6u) {
        record.bytes[0] = FIXPID_RECORD_VERSION;
    }
    if (kind < 5u) {
        record.bytes[20] &= 0xE0u;
    }
    if (kind < 7u) {
        check = defined_check();
        record.bytes[21] = (uint8_t)(check & 0xFFu);
        record.bytes[22] = (uint8_t)(check >> 8);
    }
}

static void start(const struct fixpid_pid_config *config)
{
    struct fixpid_pid pid;
    struct reference_pid definition;
    bool accepted;

    memset(&pid, 0xA5, sizeof pid);
    accepted = fixpid_pid_init(&pid, config);
    demand(accepted == reference_pid_init(&definition, config), "accepted");
    demand(accepted == (fixpid_pid_check(config) == FIXPID_PID_OK), "checked");
    for (unsigned step = 0; step < STEPS; step++) {
        const int16_t setpoint = numbers_int16();
        const int16_t measurement = numbers_int16();
        const int16_t output = fixpid_pid_step(&pid, setpoint, measurement);

        demand(output == reference_pid_step(&definition, setpoint, measurement),
               "output");
        demand(accepted ? output >= config->output_min &&
                              output <= config->output_max
                        : output == 0,
               "output within its limits, or 0");
    }
}

static void unpack(void)
{
    static struct fixpid_pid_config config, untouched;
    const unsigned check = record.bytes[21] | record.bytes[22] * 256u;
    const bool good = record.bytes[0] == 1 && check == defined_check() &&
                      (record.bytes[20] & 0x1Fu) == 0;
    struct fixpid_record again;

    memset(&config, 0xA5, sizeof config);
    memset(&untouched, 0xA5, sizeof untouched);
    demand(fixpid_record_unpack(&record, &config) == good, "unpacked");
    if (!good) {
        demand(memcmp(&config, &untouched, sizeof config) == 0, "untouched");
        return;
    }
    fixpid_record_pack(&again, &config);
    demand(memcmp(&again, &record, sizeof again) == 0, "the same bytes again");
    start(&config);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    numbers_from(data, size);
    while (numbers_are_left()) {
        fill();
        unpack();
    }
    return 0;
}
