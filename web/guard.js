// SPDX-License-Identifier: MIT
// What fixpid_guard takes for a loop whose plant the autotuner has measured: the rule
// of fixpid_guard.h, as fixpid.guard_config has it in Python.

const INTEGRATING = 2 ** 32 - 1;
const MOST = 32767;
const SURE = 0.8; // of the way to where an end of the output would bring the plant

// { band, patience, noisy }, or null where there is no such guard. `model` is
// { GAIN, DEAD, SLOPE, NOISE }, as fixpid_autotune_model has them.
export function guardRule({ GAIN, DEAD, SLOPE, NOISE }, outputMin, outputMax) {
    const [noise, slope] = [NOISE / 16, SLOPE / 2 ** 24];
    if (slope <= 0 || outputMin >= outputMax) {
        return null;
    }
    const band = Math.ceil(Math.max(8 * noise + 4, GAIN === INTEGRATING ? 0 : 2 * GAIN / 256));
    const way = 20 * band / (slope * (outputMax - outputMin));
    const patience = Math.max(Math.ceil(2 * DEAD / 16 + way), 4);
    return band > MOST || patience > MOST ? null : { band, patience, noisy: noise >= 1 && patience >= 16 };
}

// The ends of what the output surely reaches, in counts; both 0, the sensor's range,
// where the plant integrates, `setpoint` is not known or they are too near.
function reachOf({ GAIN, HOLDING }, { band, outputMin, outputMax, reverse, low, high, setpoint }) {
    const rise = SURE * GAIN / 256 * (reverse ? -1 : 1);
    const ends = [outputMin, outputMax].map((output) => setpoint + rise * (output - HOLDING)).sort((a, b) => a - b);
    const [least, most] = [Math.max(low, Math.ceil(ends[0])), Math.min(high, Math.floor(ends[1]))];
    return GAIN === INTEGRATING || setpoint === null || most - least <= 2 * band ? [0, 0] : [least, most];
}

// All fields in their order, or null. `loop` is { outputMin, outputMax, reverse, top: the
// sensor's last count, rest: its reading with the plant at rest, setpoint in counts or null }.
export function guardOf(model, loop) {
    const rule = guardRule(model, loop.outputMin, loop.outputMax);
    const low = loop.rest > 1 ? 1 : 0;
    const high = loop.rest < loop.top - 1 ? loop.top - 1 : loop.top;
    if (rule === null || high - low <= 2 * rule.band) {
        return null;
    }
    const [reachMin, reachMax] = reachOf(model, { ...loop, low, high, band: rule.band });
    return { output_min: loop.outputMin, output_max: loop.outputMax, measurement_min: low, measurement_max: high,
        reach_min: reachMin, reach_max: reachMax, band: rule.band, patience: rule.patience,
        reverse: loop.reverse, noisy: rule.noisy };
}

// In C, as every compiler takes it.
export function guardText(config) {
    const rows = Object.entries(config).map(([name, value]) => [`${value},`, name]);
    const width = Math.max(...rows.map(([value]) => value.length));
    return ['#include "fixpid_guard.h"', '', 'static const struct fixpid_guard_config guard_config = {',
        ...rows.map(([value, name]) => `    ${value.padEnd(width)} /* ${name} */`), '};', ''].join('\n');
}
