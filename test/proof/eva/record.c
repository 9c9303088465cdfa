// SPDX-License-Identifier: MIT
#include "eva.h"

#include "record/fixpid_record.c"

void eva(void)
{
    const struct fixpid_pid_config config = ANY_CONFIG;
    struct fixpid_record record;
    struct fixpid_pid_config unpacked;
    uint8_t at;

    fixpid_record_pack(&record, &config);
    for (at = 0; at < FIXPID_RECORD_SIZE; at++) {
        if (GOES_ON) {
            record.bytes[at] = ANY_UINT8;
        }
    }
    (void)fixpid_record_unpack(&record, &unpacked);
}
