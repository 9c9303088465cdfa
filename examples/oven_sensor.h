// SPDX-License-Identifier: MIT
// Whether the ovens' sensor is there.
#ifndef OVEN_SENSOR_H
#define OVEN_SENSOR_H
#include <stdbool.h>

#include "oven_temperature.h"

// What four conversions of 8 and of 1015 counts add to: 2 C and 253.75 C,
// beyond which no oven is. A broken wire of the sensor reads full scale, as a
// resistor pulls it up there, and one that touches ground reads 0. From the
// first such reading on a heater is off.
#define COLDEST_SENSED (4 * 8)
#define HOTTEST_SENSED (4 * 1015)

static bool sensed(int16_t temperature_counts)
{
    return (temperature_counts >= COLDEST_SENSED) &&
           (temperature_counts <= HOTTEST_SENSED);
}

#endif
