// SPDX-License-Identifier: MIT
// How the ovens' applications read their temperature.
#ifndef OVEN_SENSOR_H
#define OVEN_SENSOR_H
#include "port.h"

// Four conversions, added, average their noise: 1/16 of a degree, 0..4092.
static int16_t temperature(void)
{
    uint16_t sum = 0;
    for (uint8_t i = 0; i < 4u; i++) {
        sum = (uint16_t)(sum + port_read(PORT_TEMPERATURE));
    }
    return (int16_t)sum;
}

// In the same counts.
static int16_t set_temperature(void)
{
    return (int16_t)(port_read(PORT_SETPOINT) << 2);
}

#endif
