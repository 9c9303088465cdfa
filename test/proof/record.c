// SPDX-License-Identifier: MIT
// fixpid_record against its header: what is packed is unpacked, and nothing
// else is. That a check notices every 1, 2 and 3 wrong bits is for its unit
// test.
#include "pid_config.h"

#include "fixpid_record.h"

struct fixpid_record nondet_record(void);

#include "record/fixpid_record.c"

// CRC-16 with the polynomial 0x1021, from 0xFFFF, bit by bit.
static uint16_t check_as_defined(const struct fixpid_record *record)
{
    uint16_t check = 0xFFFFu;

    for (unsigned bit = 0; bit < 8u * (FIXPID_RECORD_SIZE - 2u); bit++) {
        const unsigned in = (record->bytes[bit / 8u] >> (7u - (bit % 8u))) & 1u;
        const unsigned out = (check >> 15) & 1u;

        check =
            (uint16_t)(((check & 0x7FFFu) << 1) ^ ((in != out) ? 0x1021u : 0u));
    }
    return check;
}

void prove_pack(void)
{
    const struct fixpid_pid_config config = any_config();
    struct fixpid_record record = nondet_record();
    struct fixpid_pid_config back = any_config();

    fixpid_record_pack(&record, &config);
    claim(record.bytes[0] == FIXPID_RECORD_VERSION);
    claim(record.bytes[1] == (config.gains.kp_q8 & 0xFFu));
    claim(record.bytes[6] == (config.gains.ki_q24 >> 24));
    claim(record.bytes[20] ==
          ((config.reverse ? 0x80u : 0u) |
           (config.derivative_on_error ? 0x40u : 0u) |
           (config.proportional_on_measurement ? 0x20u : 0u)));
    claim(fixpid_record_unpack(&record, &back));
    claim(same_config(&back, &config));
}

void prove_unpack(void)
{
    const struct fixpid_record record = nondet_record();
    const struct fixpid_pid_config before = any_config();
    struct fixpid_pid_config config = before;
    const uint8_t *const last = &record.bytes[FIXPID_RECORD_SIZE - 2u];
    const bool legal = (record.bytes[0] == FIXPID_RECORD_VERSION) &&
                       (check_as_defined(&record) ==
                        ((unsigned)last[0] | ((unsigned)last[1] << 8))) &&
                       ((record.bytes[20] & 0x1Fu) == 0u);

    claim(fixpid_record_unpack(&record, &config) == legal);
    if (!legal) {
        claim(same_config(&config, &before));
    }
}
