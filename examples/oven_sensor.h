// SPDX-License-Identifier: MIT
// How the ovens' applications read their temperature.
#ifndef OVEN_SENSOR_H
#define OVEN_SENSOR_H
#include <stdbool.h>

#include "port.h"

// What four conversions of 8 and of 1015 counts add to: 2 C and 253.75 C,
// beyond which no oven is. A broken wire of the sensor reads full scale, as a
// resistor pulls it up there, and one that touches ground reads 0.
#define COLDEST_SENSED (4 * 8)
#define HOTTEST_SENSED (4 * 1015)

// Adding four conversions averages their noise. The sum, 0..4092, is in 1/16 of
// a degree.
static int16_t temperature(void)
{
    uint16_t sum = 0;
    for (uint8_t i = 0; i < 4u; i++) {
        sum = (uint16_t)(sum + port_read(PORT_TEMPERATURE));
    }
    return (int16_t)sum;
}

static bool sensed(int16_t temperature_counts)
{
    return (temperature_counts >= COLDEST_SENSED) &&
           (temperature_counts <= HOTTEST_SENSED);
}

// The set temperature is in the same counts.
static int16_t set_temperature(void)
{
    return (int16_t)(port_read(PORT_SETPOINT) << 2);
}

#endif
