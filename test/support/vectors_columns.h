// SPDX-License-Identifier: MIT
// Columns of the recorded files; those of fixpid_pid's are in vectors_pid.h.
#ifndef VECTORS_COLUMNS_H
#define VECTORS_COLUMNS_H

// Columns of an937_firmware.csv; the terms are magnitudes.
enum {
    AN937_RUN,
    AN937_KP,
    AN937_KI,
    AN937_KD,
    AN937_ERROR,
    AN937_TICK,
    AN937_PID_OUT,
    AN937_A_ERROR,
    AN937_D_ERROR,
    AN937_PROP,
    AN937_INTEG,
    AN937_DERIV,
    AN937_COLUMNS = AN937_DERIV + 3 // two more: the firmware's own cost
};

// Columns of an964_firmware.csv.
enum {
    AN964_RUN,
    AN964_KP,
    AN964_KI,
    AN964_KD,
    AN964_ERROR,
    AN964_SUM,
    AN964_INTEGRAL,
    AN964_DERIVATIVE,
    AN964_OUT,
    AN964_COLUMNS
};

// Columns of slew.csv.
enum {
    SLEW_RUN,
    SLEW_EVENT,
    SLEW_RISE,
    SLEW_FALL,
    SLEW_SEED,
    SLEW_TARGET,
    SLEW_OUTPUT,
    SLEW_VALUE,
    SLEW_COLUMNS
};

// Columns of tpo.csv.
enum {
    TPO_RUN,
    TPO_EVENT,
    TPO_ACCEPTED,
    TPO_FULL,
    TPO_WINDOW,
    TPO_MINIMUM_ON,
    TPO_MINIMUM_OFF,
    TPO_DUTY,
    TPO_ON,
    TPO_CARRY, // the definition's
    TPO_COLUMNS
};

// Columns of guard.csv.
enum {
    GUARD_RUN,
    GUARD_EVENT,
    GUARD_ACCEPTED,
    GUARD_OUTPUT_MIN,
    GUARD_OUTPUT_MAX,
    GUARD_MEASUREMENT_MIN,
    GUARD_MEASUREMENT_MAX,
    GUARD_REACH_MIN,
    GUARD_REACH_MAX,
    GUARD_BAND,
    GUARD_PATIENCE,
    GUARD_OPTIONS,
    GUARD_FLAGS_BEFORE,
    GUARD_SETPOINT,
    GUARD_MEASUREMENT,
    GUARD_OUTPUT,
    GUARD_REPEAT,
    GUARD_FLAGS,
    GUARD_COLUMNS
};

// Columns of gains.csv.
enum {
    GAINS_KP_MILLI,
    GAINS_KI_MILLI,
    GAINS_KD_MILLI,
    GAINS_RATE,
    GAINS_FILTER,
    GAINS_ACCEPTED,
    GAINS_KP,
    GAINS_KI,
    GAINS_KD,
    GAINS_BACK_ACCEPTED,
    GAINS_KP_BACK,
    GAINS_KI_BACK,
    GAINS_KD_BACK,
    GAINS_COLUMNS
};

// Columns of table.csv, and its kinds of rows.
enum { TABLE_TABLE, TABLE_KIND, TABLE_X, TABLE_Y, TABLE_COLUMNS };
enum { TABLE_POINT, TABLE_VERDICT, TABLE_LOOKUP };

#endif
