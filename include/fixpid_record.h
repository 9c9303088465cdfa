/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_record: a tuning of fixpid_pid as bytes, to keep in an EEPROM or in
// flash, or to send: a version, the configuration and a check.
//
// A record is the same on every machine: numbers are little-endian, in the
// order of struct fixpid_pid_config, without padding.
//
//   byte 0       version: FIXPID_RECORD_VERSION
//        1..9    gains: kp_q8 2 bytes, ki_q24 4, kd_q8 2, derivative_filter 1
//       10..17   output_min, output_max, integral_min, integral_max, 2 each
//       18..20   setpoint_weight_q8 2, options 1: the bits below
//       21..22   check: CRC-16 of all before it, polynomial 0x1021, from 0xFFFF
//
// Any 1, 2 or 3 wrong bits are noticed. Larger errors pass with a probability
// of 1/65536. Erased memory, all 0xFF, is not a record, and neither is memory
// that is all 0.
//
// At power-on, read the bytes, and start with them only if fixpid_record_unpack
// and then fixpid_pid_init accept them; otherwise start with the program's own
// configuration.
#ifndef FIXPID_RECORD_H
#define FIXPID_RECORD_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_pid.h"

FIXPID_C_BEGIN

// Another layout of the bytes will have another version, which refuses records
// of this one.
#define FIXPID_RECORD_VERSION 1u

#define FIXPID_RECORD_SIZE 23u // bytes

// Bits of byte 20: the configuration's fields of the same names.
#define FIXPID_RECORD_REVERSE 0x80u
#define FIXPID_RECORD_DERIVATIVE_ON_ERROR 0x40u
#define FIXPID_RECORD_PROPORTIONAL_ON_MEASUREMENT 0x20u

struct fixpid_record {
    uint8_t bytes[FIXPID_RECORD_SIZE];
};

// Makes a record of any configuration, legal or not.
void fixpid_record_pack(struct fixpid_record *record,
                        const struct fixpid_pid_config *config);

// The configuration as it was packed; fixpid_pid_init checks its values. False,
// and *config untouched, for another version, a wrong check or an unknown bit
// in the options.
bool fixpid_record_unpack(const struct fixpid_record *record,
                          struct fixpid_pid_config *config);

FIXPID_C_END

#endif
