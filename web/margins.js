// SPDX-License-Identifier: MIT
// The sampled loop near its setpoint, in double precision: the plant behind a
// hold and its dead time, and the controller with the integers that it has.
// From it the margins, and whether the loop is stable.
import { CONTROLLER, OPTION, PLANT } from './built.js';

// --- Small matrices, as arrays of rows ------------------------------------

function times(a, b) {
    return a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
}

function scaled(a, factor) {
    return a.map((row) => row.map((x) => x * factor));
}

function plus(a, b) {
    return a.map((row, i) => row.map((x, j) => x + b[i][j]));
}

function identity(n) {
    return Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, j) => Number(i === j)));
}

// e^a by Taylor's series of a part of it, squared again.
function exponential(a) {
    const largest = Math.max(...a.map((row) => row.reduce((sum, x) => sum + Math.abs(x), 0)));
    const halvings = Math.max(0, Math.ceil(Math.log2(Math.max(largest, 1e-30))) + 3);
    const part = scaled(a, 2 ** -halvings);
    let sum = identity(a.length);
    for (let k = 18; k > 0; k--) {
        sum = plus(identity(a.length), scaled(times(part, sum), 1 / k));
    }
    for (let i = 0; i < halvings; i++) {
        sum = times(sum, sum);
    }
    return sum;
}

// --- The plant ------------------------------------------------------------

const DEGREES = 180 / Math.PI;

function processOf(s) {
    let [a2, a1, a0] = [s.T1 * s.T2, s.T1 + s.T2, 1];
    if (s.PLANT === PLANT.OSCILLATOR) {
        [a2, a1] = [s.T1 * s.T1, 2 * s.DAMPING * s.T1];
    } else if (s.PLANT === PLANT.INTEGRATOR) {
        [a2, a1, a0] = [s.T2, 1, 0];
    }
    if (a2 > 0) {
        return { a: [[0, 1], [-a0 / a2, -a1 / a2]], b: [0, s.GAIN / a2], c: [1, 0] };
    }
    return { a: [[-a0 / a1]], b: [s.GAIN / a1], c: [1] };
}

function ovenOf(s) {
    return {
        a: [[-1 / s.T2, 0], [s.GAIN / s.T1, -1 / s.T1]],
        b: [1 / s.T2, 0], c: [0, 1],
    };
}

// As plant_motor.c has it, without friction.
function motorOf(s) {
    const [resistance, inductance, constant, viscous] = [2.4, 0.4e-3, 0.05, 1e-5];
    const inertia = s.T1 * 1e-6;
    return {
        a: [[-resistance / inductance, -constant / inductance],
            [constant / inertia, -viscous / inertia]],
        b: [s.GAIN / inductance, 0], c: [0, 1],
    };
}

// As plant_pendulum.c has it, upright.
function pendulumOf(s) {
    const w = 1.2736 * 2 * Math.PI * 60;
    const [rod, lag] = [s.T2, s.T1];
    return {
        a: [[0, 1, 0, 0, 0],
            [9.81 / rod, 0, 1 / (lag * rod), 0, 0],
            [0, 0, -1 / lag, 0, 0],
            [0, 0, 0, 0, 1],
            [w * w, 0, 0, -w * w, -w / 0.5774]],
        b: [0, -s.GAIN / (lag * rod), s.GAIN / lag, 0, 0],
        c: [0, 0, 0, DEGREES, 0],
    };
}

function continuousOf(s) {
    switch (s.PLANT) {
    case PLANT.OVEN: return ovenOf(s);
    case PLANT.MOTOR: return motorOf(s);
    case PLANT.PENDULUM: return pendulumOf(s);
    default: return processOf(s);
    }
}

// x[n+1] = phi x[n] + now u[n - steps] + before u[n - steps - 1], in counts.
// The dead time is `steps` steps and a part of one.
export function sampledPlant(s, deadSeconds) {
    const { a, b, c } = continuousOf(s);
    const h = 1 / s.RATE;
    const n = a.length;
    const steps = Math.floor(deadSeconds / h + 1e-9);
    const late = Math.max(0, deadSeconds - steps * h);
    const most = Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN);
    const top = 2 ** s.SENSOR_BITS - 1;
    // With the input as a further state its integral comes along.
    const wide = (seconds) => exponential(scaled(
        [...a.map((row, i) => [...row, b[i]]), new Array(n + 1).fill(0)], seconds));
    const after = wide(h - late);
    const during = wide(late);
    const input = (m) => m.slice(0, n).map((row) => [row[n]]);
    const state = (m) => m.slice(0, n).map((row) => row.slice(0, n));
    const counts = (column) => column.map((row) => row[0] / most);
    return {
        phi: state(wide(h)),
        now: counts(input(after)),
        before: counts(times(state(after), input(during))),
        out: c.map((x) => x * top / s.SENSOR_RANGE),
        steps,
    };
}

// --- Frequencies ------------------------------------------------------------
// Complex numbers are [real, imaginary].

function multiply([a, b], [c, d]) {
    return [a * c - b * d, a * d + b * c];
}

function divide([a, b], [c, d]) {
    const size = c * c + d * d;
    return [(a * c + b * d) / size, (b * c - a * d) / size];
}

function add([a, b], [c, d]) {
    return [a + c, b + d];
}

// z^-n at the angle w.
function back(w, n) {
    return [Math.cos(w * n), -Math.sin(w * n)];
}

const ONE = [1, 0];
const minus = ([a, b]) => [-a, -b];
const times1 = (factor, [a, b]) => [factor * a, factor * b];

// (z - phi)^-1 b by elimination.
function solved(phi, w, b) {
    const n = phi.length;
    const rows = phi.map((row, i) => [...row.map((x, j) => (i === j
        ? [Math.cos(w) - x, Math.sin(w)] : [-x, 0])), b[i]]);
    for (let k = 0; k < n; k++) {
        let pivot = k;
        for (let i = k + 1; i < n; i++) {
            if (Math.hypot(...rows[i][k]) > Math.hypot(...rows[pivot][k])) {
                pivot = i;
            }
        }
        [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
        for (let i = k + 1; i < n; i++) {
            const factor = divide(rows[i][k], rows[k][k]);
            for (let j = k; j <= n; j++) {
                rows[i][j] = add(rows[i][j], minus(multiply(factor, rows[k][j])));
            }
        }
    }
    for (let k = n - 1; k >= 0; k--) {
        for (let j = k + 1; j < n; j++) {
            rows[k][n] = add(rows[k][n], minus(multiply(rows[k][j], rows[j][n])));
        }
        rows[k][n] = divide(rows[k][n], rows[k][k]);
    }
    return rows.map((row) => row[n]);
}

export function plantAt(plant, w) {
    const b = plant.now.map((x, i) => add([x, 0], times1(plant.before[i], back(w, 1))));
    const x = solved(plant.phi, w, b);
    const y = x.reduce((sum, one, i) => add(sum, times1(plant.out[i], one)), [0, 0]);
    return multiply(y, back(w, plant.steps));
}

// What the controller is made of, in output counts per measurement count:
// kp, ki per step, kd per step, and the derivative's shape.
export function controllerOf(s, results) {
    const sign = (s.OPTIONS & OPTION.REVERSE) !== 0 ? -1 : 1;
    if (s.CONTROLLER === CONTROLLER.AN937) {
        const q4 = errorPerCount(s) / 16;
        return { kp: results.KP * q4, ki: results.KI * q4, kd: results.KD * q4,
            kind: 'periodic', period: results.FILTER, sign };
    }
    if (s.CONTROLLER === CONTROLLER.AN964) {
        const all = results.KP / 1024;
        return { kp: all, ki: all * results.KI / 4096, kd: all * results.KD / 32,
            kind: 'three', sign: s.PLANT === PLANT.PENDULUM ? -1 : sign };
    }
    return {
        kp: results.KP / 256, ki: results.KI / 2 ** 24, kd: results.KD / 256,
        kind: 'filtered', keep: 1 - 2 ** -results.FILTER,
        sign,
    };
}

function derivativeAt(controller, w) {
    if (controller.kind === 'three') {
        return add(ONE, minus(back(w, 3)));
    }
    if (controller.kind === 'periodic') { // on average: held for its period
        let held = [0, 0];
        for (let i = 0; i < controller.period; i++) {
            held = add(held, times1(1 / controller.period, back(w, i)));
        }
        return multiply(held, add(ONE, minus(back(w, controller.period))));
    }
    return divide(add(ONE, minus(back(w, 1))), add(ONE, times1(-controller.keep, back(w, 1))));
}

export function controllerAt(controller, w) {
    const integral = divide([controller.ki, 0], add(ONE, minus(back(w, 1))));
    const terms = add(add([controller.kp, 0], integral), times1(controller.kd, derivativeAt(controller, w)));
    return times1(controller.sign, terms);
}

// --- In time ----------------------------------------------------------------

// The closed loop without limits and rounding, its gain times `factor`: the
// measurement of each step after a count on the first one, and after a step of
// `driven` output counts before it.
export function linearResponse(plant, controller, factor, n, driven = 0) {
    let x = plant.now.map((b) => b * driven);
    const outputs = new Float64Array(n + plant.steps + 2);
    const seen = new Float64Array(n);
    let [integral, derivative] = [0, 0];
    const periods = [0, 0]; // the last sample and the difference
    const y = (i) => (i < 0 ? 0 : seen[i]);
    for (let i = 0; i < n; i++) {
        seen[i] = plant.out.reduce((sum, c, k) => sum + c * x[k], i === 0 ? 1 : 0);
        integral += controller.ki * seen[i];
        if (controller.kind === 'three') {
            derivative = controller.kd * (y(i) - y(i - 3));
        } else if (controller.kind === 'periodic') {
            if (i % controller.period === 0) {
                periods[1] = y(i) - periods[0];
                periods[0] = y(i);
            }
            derivative = controller.kd * periods[1];
        } else {
            derivative = controller.keep * derivative + controller.kd * (y(i) - y(i - 1));
        }
        const at = i + plant.steps + 1;
        outputs[at] = -factor * controller.sign * (controller.kp * seen[i] + integral + derivative);
        const [u, u1] = [outputs[i + 1], outputs[i]];
        x = plant.phi.map((row, k) => row.reduce((sum, p, j) => sum + p * x[j], 0) +
            plant.now[k] * u + plant.before[k] * u1);
    }
    return seen;
}

function largest(seen, from, to) {
    let most = 0;
    for (let i = Math.floor(from); i < to; i++) {
        most = Math.max(most, Math.abs(seen[i]));
    }
    return Number.isFinite(most) ? most : Infinity;
}

// The loop is stable if what is left of a push goes on getting less.
export function isStable(plant, controller, factor, n) {
    const seen = linearResponse(plant, controller, factor, n, 1);
    const early = largest(seen, n / 4, n / 2);
    const late = largest(seen, 3 * n / 4, n);
    return Number.isFinite(late) && (late < early * 0.999 || late < 1e-9);
}

// --- Margins ------------------------------------------------------------------

const POINTS = 480;

function crossing(at, low, high, sign) {
    for (let i = 0; i < 50; i++) {
        const middle = Math.sqrt(low * high);
        if ((at(middle) > 0) === sign) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return Math.sqrt(low * high);
}

function peak(at, low, high) {
    for (let i = 0; i < 60; i++) {
        const [a, b] = [low * (high / low) ** 0.382, low * (high / low) ** 0.618];
        if (at(a) < at(b)) {
            low = a;
        } else {
            high = b;
        }
    }
    return Math.sqrt(low * high);
}

// How far a plant's gain may be off, as a part of it, for the worst case.
export const OFF = 0.2;

// The point's least distance from -1 for all gains from 1 - OFF to 1 + OFF times it.
function leastDistance([re, im]) {
    const nearest = Math.min(1 + OFF, Math.max(1 - OFF, -re / (re * re + im * im)));
    return Math.hypot(1 + nearest * re, nearest * im);
}

// The highest value of what is `of` a point, on the curve and between its points.
function highest(of, { curve, grid, loop }) {
    const values = curve.map(of);
    const best = values.reduce((most, value, i) => (value > values[most] ? i : most), 0);
    const at = (w) => of(loop(w));
    return at(peak(at, grid[Math.max(0, best - 1)], grid[Math.min(grid.length - 1, best + 1)]));
}

// { ms, gainMargin, lowerGainMargin, phaseMargin (degrees),
// delayMargin (seconds of further dead time), stable, crossover and turnover: where phase
// and gain margin are, in radians per step; off: { ms, stable } of the worst gain within
// OFF; curve: the loop's points at `angles`, and steps of dead time in them }.
// A margin that there is none of is null: no gain makes such a loop swing.
export function marginsOf(s, results) {
    const plant = sampledPlant(s, results.DEAD_S);
    const controller = controllerOf(s, results);
    const loop = (w) => multiply(controllerAt(controller, w), plantAt(plant, w));
    const scale = scaleSteps(s);
    const lowest = Math.min(0.01, 0.02 / scale);
    const grid = Array.from({ length: POINTS }, (_, i) => lowest * (Math.PI / lowest) ** ((i + 1) / POINTS));
    const curve = grid.map(loop);
    const size = (w) => Math.hypot(...loop(w));
    let [upper, lower, phase, delay] = [null, null, null, null];
    let [crossover, turnover] = [null, null];
    for (let i = 1; i < POINTS; i++) {
        const [a, b] = [curve[i - 1], curve[i]];
        const [wa, wb] = [grid[i - 1], grid[i]];
        if ((a[1] > 0) !== (b[1] > 0) && (a[0] < 0 || b[0] < 0)) {
            const w = crossing((x) => loop(x)[1], wa, wb, a[1] > 0);
            const margin = 1 / size(w);
            if (loop(w)[0] < 0 && margin >= 1) {
                turnover = margin < (upper ?? Infinity) ? w : turnover;
                upper = Math.min(upper ?? Infinity, margin);
            } else if (loop(w)[0] < 0) {
                lower = Math.max(lower ?? 0, margin);
            }
        }
        if ((Math.hypot(...a) > 1) !== (Math.hypot(...b) > 1)) {
            const w = crossing((x) => size(x) - 1, wa, wb, Math.hypot(...a) > 1);
            const [re, im] = loop(w);
            const away = Math.abs(Math.atan2(im, -re)); // from -180 degrees
            crossover = away * DEGREES < (phase ?? Infinity) ? w : crossover;
            phase = Math.min(phase ?? Infinity, away * DEGREES);
            // More dead time turns the curve back: from above the axis all the
            // way round.
            const left = im < 0 ? away : 2 * Math.PI - away;
            delay = Math.min(delay ?? Infinity, left / w / s.RATE);
        }
    }
    // The end of the band: a real number there is a crossing, too.
    const end = loop(Math.PI);
    if (end[0] < 0 && 1 / Math.hypot(...end) >= 1) {
        turnover = 1 / Math.hypot(...end) < (upper ?? Infinity) ? Math.PI : turnover;
        upper = Math.min(upper ?? Infinity, 1 / Math.hypot(...end));
    }
    // So is its start, where the loop has an end there.
    const [start, before] = [loop(lowest / 10), loop(lowest / 100)];
    if (before[0] < 0 && Math.abs(before[1]) < 0.1 * Math.abs(before[0]) && Math.abs(start[0] / before[0] - 1) < 0.05) {
        const margin = 1 / Math.hypot(...before);
        [upper, lower] = margin >= 1 ? [Math.min(upper ?? Infinity, margin), lower] : [upper, Math.max(lower ?? 0, margin)];
    }
    const stable = isStable(plant, controller, 1, responseSteps(s, results));
    return {
        ms: highest((point) => 1 / Math.hypot(...add(ONE, point)), { curve, grid, loop }),
        gainMargin: upper, lowerGainMargin: lower, phaseMargin: phase, delayMargin: delay, stable, crossover, turnover,
        off: { ms: highest((point) => 1 / leastDistance(point), { curve, grid, loop }),
            stable: stable && 1 + OFF < (upper ?? Infinity) && 1 - OFF > (lower ?? 0) },
        curve, angles: grid, steps: plant.steps,
    };
}

// What AN937's loop passes on of one count: its motor's 1023 counts are 4000.
export function errorPerCount(s) {
    return s.PLANT === PLANT.MOTOR ? 4 : 1;
}

// How long to look at a loop's answer to a push, in steps.
export function responseSteps(s, results) {
    const perStep = controllerOf(s, results);
    const reset = perStep.ki > 0 ? perStep.kp / perStep.ki : 0;
    const wanted = 60 * Math.max(scaleSteps(s), Math.min(reset, 20 * scaleSteps(s)));
    return Math.round(Math.min(30000, Math.max(1500, wanted)));
}

// The time that matters to the controller, in steps: dead time and lags.
export function scaleSteps(s) {
    return scaleSeconds(s) * s.RATE;
}

export function scaleSeconds(s) {
    switch (s.PLANT) {
    case PLANT.MOTOR: return 2.4 * s.T1 * 1e-6 / 0.0025;
    case PLANT.PENDULUM: return Math.sqrt(s.T2 / 9.81);
    case PLANT.INTEGRATOR: return 2 * (s.DEAD + s.T2) + 4 / s.RATE;
    case PLANT.OSCILLATOR: return s.T1 / Math.max(s.DAMPING, 0.05) + s.DEAD;
    default: return s.T1 + s.T2 + s.DEAD;
    }
}

// Counts of measurement per count of output, at rest; of an integrator, after
// the time that matters.
export function countsGain(s) {
    const most = Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN);
    const top = 2 ** s.SENSOR_BITS - 1;
    const perDrive = { [PLANT.MOTOR]: s.GAIN / 0.05, [PLANT.PENDULUM]: 60,
        [PLANT.INTEGRATOR]: s.GAIN * scaleSeconds(s) }[s.PLANT] ?? s.GAIN;
    return Math.abs(perDrive * top / s.SENSOR_RANGE / most);
}
