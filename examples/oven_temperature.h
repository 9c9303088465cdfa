// SPDX-License-Identifier: MIT
// How the ovens' applications read their temperature and their setpoint.
#ifndef OVEN_TEMPERATURE_H
#define OVEN_TEMPERATURE_H
#include <stdint.h>

#include "port.h"

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

// The set temperature is in the same counts.
static int16_t set_temperature(void)
{
    return (int16_t)(port_read(PORT_SETPOINT) << 2);
}

#endif
