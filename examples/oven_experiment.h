// SPDX-License-Identifier: MIT
// The experiment on an oven, for the applications that do it.
#ifndef OVEN_EXPERIMENT_H
#define OVEN_EXPERIMENT_H
#include "fixpid_autotune.h"
#include "port.h"

#define CONTROL_PERIOD_TICKS 100u

// These are in counts of temperature, of which a degree has 16.
#define COLDEST 16
#define HOTTEST 4000 // 250 C; the sensor ends at 256
#define SWING 160u
#define TIMEOUT_STEPS 600u // a minute for half a cycle
#define CYCLES 2u

static inline void start_experiment(FIXPID_DATA struct fixpid_autotune *self)
{
    static const struct fixpid_autotune_config experiment = {
        .output_min = 0,
        .output_max = PORT_DRIVE_FULL,
        .output_rest = 0,
        .measurement_min = COLDEST,
        .measurement_max = HOTTEST,
        .swing = SWING,
        .timeout_steps = TIMEOUT_STEPS,
        .cycles = CYCLES,
    };

    (void)fixpid_autotune_init(self, &experiment);
}

#endif
