// SPDX-License-Identifier: MIT
// What fixpid_guard takes for a loop whose plant a tuner has measured: band, patience
// and noisy are the library's.
import { setText } from './dom.js';

const INTEGRATING = 2 ** 32 - 1;
const SURE = 0.8; // of the way to where an end of the output would bring the plant

// The ends of what the output surely reaches, in counts; both 0, the sensor's range,
// where the plant integrates, `setpoint` is not known or they are too near.
function reachOf({ GAIN, HOLDING, BAND }, { outputMin, outputMax, reverse, low, high, setpoint }) {
    const rise = SURE * GAIN / 256 * (reverse ? -1 : 1);
    const ends = [outputMin, outputMax].map((output) => setpoint + rise * (output - HOLDING)).sort((a, b) => a - b);
    const [least, most] = [Math.max(low, Math.ceil(ends[0])), Math.min(high, Math.floor(ends[1]))];
    return GAIN === INTEGRATING || setpoint === null || most - least <= 2 * BAND ? [0, 0] : [least, most];
}

// All fields in their order, or null where there is no such guard. `results` are those of
// the experiment; `loop` is { outputMin, outputMax, reverse, top: the sensor's last count,
// rest: its reading with the plant at rest, setpoint in counts or null }.
export function guardOf(results, loop) {
    const low = loop.rest > 1 ? 1 : 0;
    const high = loop.rest < loop.top - 1 ? loop.top - 1 : loop.top;
    if (results.BAND === 0 || high - low <= 2 * results.BAND) {
        return null;
    }
    const [reachMin, reachMax] = reachOf(results, { ...loop, low, high });
    return { output_min: loop.outputMin, output_max: loop.outputMax, measurement_min: low, measurement_max: high,
        reach_min: reachMin, reach_max: reachMax, band: results.BAND, patience: results.PATIENCE,
        reverse: loop.reverse, noisy: results.NOISY === 1 };
}

// In C, as every compiler takes it.
export function guardText(config) {
    const rows = Object.entries(config).map(([name, value]) => [`${value},`, name]);
    const width = Math.max(...rows.map(([value]) => value.length));
    return ['#include "fixpid_guard.h"', '', 'static const struct fixpid_guard_config guard_config = {',
        ...rows.map(([value, name]) => `    ${value.padEnd(width)} /* ${name} */`), '};', ''].join('\n');
}

// Beside gains: the guard for the same loop, where the experiment has a model.
export function fillGuard(place, results, loop) {
    const config = results ? guardOf(results, loop) : null;
    place.hidden = config === null;
    const reach = config?.reach_max > 0 ? 'From the setpoint to where the ends of the output would bring the plant, it takes four fifths as surely within reach'
        : 'In place of reach_min and reach_max write the lowest and the highest setpoint of the loop; with 0 a setpoint that it cannot reach is an alarm';
    setText(place.querySelector('p'), config === null ? '' : 'The guard for this loop, by the rule of fixpid_guard.h: a reading outside ' +
        `measurement_min to measurement_max is a broken sensor’s. ${reach}.`);
    setText(place.querySelector('pre'), config === null ? '' : guardText(config));
}
