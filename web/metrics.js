// SPDX-License-Identifier: MIT
// What a run is worth: how the first setpoint is reached, what a load does, and
// what the integers cost beside double precision.
import { CONTROLLER, PLANT } from './built.js';

export function unitsOf(s, counts) {
    return s.SENSOR_LOW + counts * s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1);
}

export function unitsPerCount(s) {
    return s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1);
}

// Steps from one thing that happens to the next.
function pieces(s, n) {
    const starts = s.events.filter((event) => event.at * s.RATE < n && event.at > 0)
        .sort((a, b) => a.at - b.at)
        .map((event) => ({ what: event.what, from: Math.floor(event.at * s.RATE + 0.5) }));
    const all = [{ what: 'START', from: 0 }, ...starts];
    return all.map((piece, i) => ({ ...piece, to: all[i + 1]?.from ?? n }));
}

// Of y from one place to another: how far it passes its goal on its way there (1 or -1), and
// the place from which on it stays within the band, or null.
export function settling(y, { goal, way, band }, from = 0, to = y.length) {
    let [over, settled] = [0, null];
    for (let i = from; i < to; i++) {
        over = Math.max(over, way * (y[i] - goal));
        if (Math.abs(y[i] - goal) > band) {
            settled = null;
        } else if (settled === null) {
            settled = i;
        }
    }
    return { over, settled };
}

// { overshoot (part of the step), rise, settled (seconds or null) }.
function stepResponse(s, { series }, piece) {
    const y = series.VALUE_TRUE;
    const from = y[0];
    const goal = unitsOf(s, series.SETPOINT[0]);
    const span = Math.abs(goal - from) || 1;
    const way = Math.sign(goal - from) || 1;
    const band = Math.max(0.02 * span, (1 + s.NOISE) * unitsPerCount(s));
    const { over, settled } = settling(y, { goal, way, band }, piece.from, piece.to);
    let rise = null;
    for (let i = piece.from; i < piece.to && rise === null; i++) {
        if (Math.abs(y[i] - from) >= 0.9 * span && way * (y[i] - from) > 0) {
            rise = i;
        }
    }
    return { overshoot: over / span, rise: rise === null ? null : rise / s.RATE,
        settled: settled === null ? null : settled / s.RATE };
}

function largestError(s, { series }, piece) {
    let most = 0;
    for (let i = piece.from; i < piece.to; i++) {
        const error = Math.abs(series.VALUE_TRUE[i] - unitsOf(s, series.SETPOINT[i]));
        most = Math.max(most, error);
    }
    return most;
}

// The difference to the twin, in counts of the sensor: the largest, and the
// root of the mean square.
function twinDifference(s, { n, series }) {
    const perUnit = 1 / unitsPerCount(s);
    let [most, sum] = [0, 0];
    for (let i = 0; i < n; i++) {
        const difference = (series.VALUE_TRUE[i] - series.VALUE_TWIN[i]) * perUnit;
        most = Math.max(most, Math.abs(difference));
        sum += difference * difference;
    }
    return { most, rms: Math.sqrt(sum / n) };
}

export function limitedSteps(s, { n, series }) {
    const limited = new Uint8Array(n);
    for (let i = 0; i < n; i++) {
        limited[i] = s.CONTROLLER === CONTROLLER.PID
            ? Number((series.FLAGS[i] & 3) !== 0)
            : Number(series.OUTPUT[i] >= s.OUTPUT_MAX || series.OUTPUT[i] <= s.OUTPUT_MIN);
    }
    return limited;
}

export function metricsOf(s, run) {
    const { n, series } = run;
    const all = pieces(s, n);
    const first = all.find((piece) => piece.to > piece.from);
    const load = all.find((piece) => piece.what === 'LOAD' && piece.to > piece.from);
    let [sum, moved] = [0, 0];
    for (let i = 0; i < n; i++) {
        sum += Math.abs(series.VALUE_TRUE[i] - unitsOf(s, series.SETPOINT[i]));
        moved += i > 0 ? Math.abs(series.OUTPUT[i] - series.OUTPUT[i - 1]) : 0;
    }
    const limited = limitedSteps(s, run).reduce((total, one) => total + one, 0);
    const found = {
        ...stepResponse(s, run, first),
        load: load ? largestError(s, run, load) : null,
        meanError: sum / n, iae: sum / s.RATE, moved: moved / n, limited: limited / n,
        get twin() { return twinDifference(s, run); }, // only where it is asked for
    };
    if (s.PLANT === PLANT.PENDULUM) {
        found.travel = series.VALUE_BASE.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    }
    return found;
}
