// SPDX-License-Identifier: MIT
#include "fixpid_record.h"

#include "../common/fixpid_bytes.h"
#include "../common/fixpid_check.h"

// Where each number begins.
#define VERSION_AT 0u
#define KP_AT 1u
#define KI_AT 3u
#define KD_AT 7u
#define FILTER_AT 9u
#define OUTPUT_MIN_AT 10u
#define OUTPUT_MAX_AT 12u
#define INTEGRAL_MIN_AT 14u
#define INTEGRAL_MAX_AT 16u
#define WEIGHT_AT 18u
#define OPTIONS_AT 20u
#define CHECK_AT 21u

#define OPTIONS                                                                \
    (FIXPID_RECORD_REVERSE | FIXPID_RECORD_DERIVATIVE_ON_ERROR |               \
     FIXPID_RECORD_PROPORTIONAL_ON_MEASUREMENT)

static uint8_t options_of(const struct fixpid_pid_config *config)
{
    uint8_t options = 0;

    if (config->reverse) {
        options |= FIXPID_RECORD_REVERSE;
    }
    if (config->derivative_on_error) {
        options |= FIXPID_RECORD_DERIVATIVE_ON_ERROR;
    }
    if (config->proportional_on_measurement) {
        options |= FIXPID_RECORD_PROPORTIONAL_ON_MEASUREMENT;
    }
    return options;
}

void fixpid_record_pack(struct fixpid_record *record,
                        const struct fixpid_pid_config *config)
{
    uint8_t *bytes;

    FIXPID_ASSERT(record != 0);
    FIXPID_ASSERT(config != 0);
    bytes = record->bytes;
    bytes[VERSION_AT] = FIXPID_RECORD_VERSION;
    put(&bytes[KP_AT], config->gains.kp_q8);
    put32(&bytes[KI_AT], config->gains.ki_q24);
    put(&bytes[KD_AT], config->gains.kd_q8);
    bytes[FILTER_AT] = config->gains.derivative_filter;
    put(&bytes[OUTPUT_MIN_AT], (uint16_t)config->output_min);
    put(&bytes[OUTPUT_MAX_AT], (uint16_t)config->output_max);
    put(&bytes[INTEGRAL_MIN_AT], (uint16_t)config->integral_min);
    put(&bytes[INTEGRAL_MAX_AT], (uint16_t)config->integral_max);
    put(&bytes[WEIGHT_AT], config->setpoint_weight_q8);
    bytes[OPTIONS_AT] = options_of(config);
    put(&bytes[CHECK_AT], check_of(bytes, CHECK_AT));
}

bool fixpid_record_unpack(const struct fixpid_record *record,
                          struct fixpid_pid_config *config)
{
    const uint8_t *bytes;

    FIXPID_ASSERT(record != 0);
    FIXPID_ASSERT(config != 0);
    bytes = record->bytes;
    if (bytes[VERSION_AT] != FIXPID_RECORD_VERSION) {
        return false;
    }
    if (get(&bytes[CHECK_AT]) != check_of(bytes, CHECK_AT)) {
        return false;
    }
    if ((bytes[OPTIONS_AT] & (uint8_t)~OPTIONS) != 0u) {
        return false;
    }
    config->gains.kp_q8 = get(&bytes[KP_AT]);
    config->gains.ki_q24 = get32(&bytes[KI_AT]);
    config->gains.kd_q8 = get(&bytes[KD_AT]);
    config->gains.derivative_filter = bytes[FILTER_AT];
    config->output_min = (int16_t)get(&bytes[OUTPUT_MIN_AT]);
    config->output_max = (int16_t)get(&bytes[OUTPUT_MAX_AT]);
    config->integral_min = (int16_t)get(&bytes[INTEGRAL_MIN_AT]);
    config->integral_max = (int16_t)get(&bytes[INTEGRAL_MAX_AT]);
    config->setpoint_weight_q8 = get(&bytes[WEIGHT_AT]);
    config->reverse = (bytes[OPTIONS_AT] & FIXPID_RECORD_REVERSE) != 0u;
    config->derivative_on_error =
        (bytes[OPTIONS_AT] & FIXPID_RECORD_DERIVATIVE_ON_ERROR) != 0u;
    config->proportional_on_measurement =
        (bytes[OPTIONS_AT] & FIXPID_RECORD_PROPORTIONAL_ON_MEASUREMENT) != 0u;
    return true;
}
