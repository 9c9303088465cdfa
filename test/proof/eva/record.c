// SPDX-License-Identifier: MIT
#include "eva.h"

#include "record/fixpid_record.c"

void eva(void)
{
    const struct fixpid_pid_config config = {
        .gains = {ANY_UINT16, ANY_UINT32, ANY_UINT16, ANY_UINT8},
        .output_min = ANY_INT16,
        .output_max = ANY_INT16,
        .integral_min = ANY_INT16,
        .integral_max = ANY_INT16,
        .setpoint_weight_q8 = ANY_UINT16,
        .reverse = GOES_ON,
        .derivative_on_error = GOES_ON,
        .proportional_on_measurement = GOES_ON,
    };
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
