// SPDX-License-Identifier: MIT
// What a count of a scene's sensor is in units.

export function unitsOf(s, counts) {
    return s.SENSOR_LOW + counts * s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1);
}

export function unitsPerCount(s) {
    return s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1);
}
