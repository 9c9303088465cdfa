// SPDX-License-Identifier: MIT
// What the oven's and the thermostat's guard knows of their plant,
// sim/plant/plant_oven.h, in 1/16 of a degree: what fixpid_guard_from_model
// makes of it, as constants, which take no code to compute.
#ifndef OVEN_GUARD_H
#define OVEN_GUARD_H
#include "fixpid_guard.h"
#include "port.h"

#include "oven_sensor.h"

// Full power, 1023 counts, raises 400 C: K is 6.3 counts for one of them. The
// sum of four conversions has 0.8 counts of noise. 2 K is more than 8 s + 4.
#define GUARD_BAND 13u

// The dead time L is 0.35 s and a second of the element, and full power warms
// by 67 C/s, 1067 counts: 2 L + 20 bands / 1067 is 2.95 s.
#define GUARD_PATIENCE_MS 3000u

// An oven that is off comes down to 40 C in the warmest room, and one at full
// power leaves the sensor's range even at 80 % of its voltage.
#define GUARD_REACH_MIN (40 * 16)

#define OVEN_GUARD(PATIENCE_STEPS)                                             \
    {                                                                          \
        .output_min = 0, .output_max = PORT_DRIVE_FULL,                        \
        .measurement_min = COLDEST_SENSED, .measurement_max = HOTTEST_SENSED,  \
        .reach_min = GUARD_REACH_MIN, .reach_max = HOTTEST_SENSED,             \
        .band = GUARD_BAND, .patience = (PATIENCE_STEPS),                      \
    }

#endif
