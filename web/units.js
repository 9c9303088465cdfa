// SPDX-License-Identifier: MIT
// What a count of a scene's sensor is in units.

// A function of counts, for many of them.
export function inUnits({ SENSOR_LOW: low, SENSOR_RANGE: range, SENSOR_BITS: bits }) {
    const top = 2 ** bits - 1;
    return (counts) => low + counts * range / top;
}

export const unitsOf = (s, counts) => inUnits(s)(counts);

export function unitsPerCount(s) {
    return s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1);
}
