// SPDX-License-Identifier: MIT
// A row has the three bools of a configuration as bits of one byte, its
// options. The rows of fixpid_pid's definition are older than two things of
// today: a weight of 0 was what a bool says now, and they know only these
// flags.
#ifndef VECTORS_PID_H
#define VECTORS_PID_H
#include <stdint.h>

#include "fixpid_pid.h"

#define VECTORS_PID_FLAGS                                                      \
    (FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN | FIXPID_PID_FIRST |                \
     FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)

#define VECTORS_PID_REVERSE 0x80u
#define VECTORS_PID_DERIVATIVE_ON_ERROR 0x40u
#define VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT 0x20u
#define VECTORS_PID_OPTIONS 0xE0u

// Columns of pid_definition.csv.
enum {
    PID_RUN,
    PID_KP,
    PID_KI,
    PID_KD,
    PID_FILTER,
    PID_OUTPUT_MIN,
    PID_OUTPUT_MAX,
    PID_INTEGRAL_MIN,
    PID_INTEGRAL_MAX,
    PID_WEIGHT,
    PID_OPTIONS,
    PID_EVENT,
    PID_VALUE,
    PID_SETPOINT,
    PID_MEASUREMENT,
    PID_OUTPUT,
    PID_P,
    PID_I,
    PID_D,
    PID_STATUS,
    PID_COLUMNS
};

// What was called before the row's step: in PID_EVENT or TRACK_EVENT.
enum {
    PID_NOTHING,
    PID_INIT,
    PID_RESET,
    PID_SET_GAINS,
    PID_SET_LIMITS,
    PID_SET_INTEGRAL_LIMITS,
    PID_SET_FEEDFORWARD,
    PID_SET_MANUAL,
    PID_SET_AUTO,
    PID_SEED,
    PID_TRACK // of track.csv
};

// Columns of track.csv from the event on; those before are the same.
enum {
    TRACK_EVENT = PID_EVENT,
    TRACK_VALUE,
    TRACK_VALUE2,
    TRACK_ACCEPTED,
    TRACK_SETPOINT,
    TRACK_MEASUREMENT,
    TRACK_OUTPUT,
    TRACK_EVENT2, // after the step
    TRACK_VALUE3,
    TRACK_TRACKED,
    TRACK_APPLIED,
    TRACK_SHIFT,
    TRACK_LAST_OUTPUT,
    TRACK_P,
    TRACK_I,
    TRACK_D,
    TRACK_STATUS,
    TRACK_COLUMNS
};

// Columns of step_error.csv from by_error on; those before are the same as in
// track.csv.
enum {
    BY_ERROR = TRACK_SETPOINT,
    BY_ERROR_FIRST,
    BY_ERROR_SECOND,
    BY_ERROR_OUTPUT,
    BY_ERROR_TRACKED,
    BY_ERROR_APPLIED,
    BY_ERROR_SHIFT,
    BY_ERROR_LAST_OUTPUT,
    BY_ERROR_P,
    BY_ERROR_I,
    BY_ERROR_D,
    BY_ERROR_STATUS,
    BY_ERROR_COLUMNS
};

// The options of an older row.
static inline uint8_t vectors_pid_options(int32_t options, int32_t weight)
{
    const unsigned weightless =
        (weight == 0) ? VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT : 0u;

    return (uint8_t)((unsigned)options | weightless);
}

// A row with any other bit stands for a configuration that is refused.
static inline void vectors_pid_set_options(struct fixpid_pid_config *config,
                                           unsigned options)
{
    config->reverse = (options & VECTORS_PID_REVERSE) != 0u;
    config->derivative_on_error =
        (options & VECTORS_PID_DERIVATIVE_ON_ERROR) != 0u;
    config->proportional_on_measurement =
        (options & VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT) != 0u;
    if ((options & ~VECTORS_PID_OPTIONS) != 0u) {
        config->setpoint_weight_q8 = UINT16_MAX;
    }
}

static inline void vectors_pid_config(struct fixpid_pid_config *config,
                                      const int32_t row[])
{
    config->gains.kp_q8 = (uint16_t)row[PID_KP];
    config->gains.ki_q24 = (uint32_t)row[PID_KI];
    config->gains.kd_q8 = (uint16_t)row[PID_KD];
    config->gains.derivative_filter = (uint8_t)row[PID_FILTER];
    config->output_min = (int16_t)row[PID_OUTPUT_MIN];
    config->output_max = (int16_t)row[PID_OUTPUT_MAX];
    config->integral_min = (int16_t)row[PID_INTEGRAL_MIN];
    config->integral_max = (int16_t)row[PID_INTEGRAL_MAX];
    config->setpoint_weight_q8 = (uint16_t)row[PID_WEIGHT];
    vectors_pid_set_options(config, (unsigned)row[PID_OPTIONS]);
}

static inline uint8_t vectors_pid_options_of(
    const struct fixpid_pid_config *config)
{
    return (uint8_t)((config->reverse ? VECTORS_PID_REVERSE : 0u) |
                     (config->derivative_on_error
                          ? VECTORS_PID_DERIVATIVE_ON_ERROR
                          : 0u) |
                     (config->proportional_on_measurement
                          ? VECTORS_PID_PROPORTIONAL_ON_MEASUREMENT
                          : 0u));
}

#endif
