// SPDX-License-Identifier: MIT
// A recorded step response as gain, lag and dead time: first by the times at
// 28.3 and 63.2 %, then by the least sum of squares.
import { OPTION } from './built.js';

// Lines of two numbers, apart by commas, semicolons, tabs or spaces; others,
// such as a head, are skipped. { times, values } or null.
export function readRecording(text) {
    const rows = text.split(/\r?\n/).map((line) => line.trim().split(/[\s,;]+/).map(Number))
        .filter((row) => row.length >= 2 && row.slice(0, 2).every(Number.isFinite))
        .sort((a, b) => a[0] - b[0]);
    if (rows.length < 8 || rows.at(-1)[0] <= rows[0][0]) {
        return null;
    }
    const start = rows[0][0];
    return { times: rows.map((row) => row[0] - start), values: rows.map((row) => row[1]) };
}

function mean(values) {
    return values.reduce((sum, one) => sum + one, 0) / values.length;
}

function timeAt({ times, values }, level, up) {
    for (let i = 1; i < values.length; i++) {
        if (up ? values[i] >= level : values[i] <= level) {
            const part = (level - values[i - 1]) / (values[i] - values[i - 1] || 1);
            return times[i - 1] + (times[i] - times[i - 1]) * Math.min(1, Math.max(0, part));
        }
    }
    return null;
}

function shape(t, lag, dead) {
    return t <= dead ? 0 : 1 - Math.exp(-(t - dead) / lag);
}

// The start and the rise that fit best with this lag and dead time: a line
// through the points (shape, value).
function straightened({ times, values }, lag, dead) {
    const n = times.length;
    const x = times.map((t) => shape(t, lag, dead));
    const [mx, my] = [mean(x), mean(values)];
    const sxx = x.reduce((sum, one) => sum + (one - mx) ** 2, 0) || 1e-12;
    const sxy = x.reduce((sum, one, i) => sum + (one - mx) * (values[i] - my), 0);
    const rise = sxy / sxx;
    const start = my - rise * mx;
    const squares = values.reduce((sum, one, i) => sum + (one - start - rise * x[i]) ** 2, 0);
    return { start, rise, error: Math.sqrt(squares / n) };
}

// { start, rise, lag, dead, error } of a recording, or null where it shows no
// step.
export function fitStep(recording) {
    const { times, values } = recording;
    const tail = Math.max(3, Math.floor(values.length / 12));
    const [start, end] = [values[0], mean(values.slice(-tail))];
    if (Math.abs(end - start) < 1e-9 * Math.max(1, Math.abs(end))) {
        return null;
    }
    const up = end > start;
    const early = timeAt(recording, start + 0.283 * (end - start), up);
    const late = timeAt(recording, start + 0.632 * (end - start), up);
    if (early === null || late === null || late <= early) {
        return null;
    }
    let lag = 1.5 * (late - early);
    let dead = Math.max(0, late - lag);
    // Both are moved while that makes the error less, by ever smaller steps.
    let best = straightened(recording, lag, dead);
    for (let move = 0.2; move > 1e-4; ) {
        const tried = [[lag * (1 + move), dead], [lag / (1 + move), dead],
            [lag, dead + move * lag], [lag, Math.max(0, dead - move * lag)],
            [lag * (1 + move), Math.max(0, dead - move * lag)], [lag / (1 + move), dead + move * lag]]
            .map(([a, b]) => ({ lag: a, dead: b, ...straightened(recording, a, b) }))
            .reduce((least, one) => (one.error < least.error ? one : least));
        if (tried.error < best.error * (1 - 1e-9)) {
            best = tried;
            ({ lag, dead } = tried);
        } else {
            move /= 2;
        }
    }
    return { start: best.start, rise: best.rise, lag, dead, error: best.error, seconds: times.at(-1) };
}

export function fittedAt(fit, t) {
    return fit.start + fit.rise * shape(t, fit.lag, fit.dead);
}

// What of the state becomes another one with this fit; `step` is the part of
// full drive that the recording was made with.
export function stateOfFit(s, fit, step, unit) {
    const round = (x) => Number(x.toPrecision(4));
    const gain = fit.rise / step;
    const all = Math.abs(gain) + Math.abs(fit.start);
    const range = 10 ** Math.ceil(Math.log10(all));
    const tidy = [0.2, 0.25, 0.5, 1].map((part) => part * range).find((one) => one >= all) ?? range;
    const low = Math.min(0, fit.start, fit.start + gain) < 0 ? -tidy : 0;
    const wanted = 40 / (fit.lag + fit.dead); // steps per second
    const power = 10 ** Math.floor(Math.log10(wanted));
    const rate = power * [5, 2, 1].find((one) => one * power <= wanted);
    const seconds = round(12 * (fit.lag + fit.dead));
    return {
        GAIN: round(gain), T1: round(fit.lag), T2: 0, DEAD: round(fit.dead), START: round(fit.start),
        SENSOR_LOW: low, SENSOR_RANGE: tidy - low, RATE: Math.max(0.01, rate), NOISE: 0,
        DURATION: seconds, SETPOINT: round(fit.start + gain / 2),
        OPTIONS: gain < 0 ? OPTION.REVERSE : 0, unit,
        KP: round(0.4 * fit.lag / (fit.lag / 10 + fit.dead) * (tidy - low) / 4.095 / Math.abs(gain)),
        KI: round(0.4 / (fit.lag / 10 + fit.dead) * (tidy - low) / 4.095 / Math.abs(gain)),
        KD: 0, FILTER: 0, WEIGHT: 1, INTEGRAL_MIN: 0, INTEGRAL_MAX: 0,
        events: [{ at: round(0.4 * seconds), what: 'SETPOINT', a: round(fit.start + 0.65 * gain) },
            { at: round(0.72 * seconds), what: 'LOAD', a: -0.1 }],
    };
}
