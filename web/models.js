// SPDX-License-Identifier: MIT
// Models of a recorded step: a lag, two lags, an integrator and an oscillator,
// each with dead time. They are fitted by least squares that far values move little, and one
// is chosen, or all are refused with the reason.
import { median, thinned, understood } from './columns.js';
import { digits, percent } from './format.js';

const FEW_POINTS = 300; // points that a search looks at first
const FITS_WELL = 0.015; // residual as a part of the rise
const FITS_BADLY = 0.04;
const SETTLED = 0.8; // the part of the rise that must be seen
const SWINGS = 0.85; // what is damped more overshoots by less than 1 %
export const KIND_NAMES = { first: 'One lag', second: 'Two lags', integrating: 'Integrating', ringing: 'Ringing' };

// --- Shapes ---------------------------------------------------------------------
// What a step of 1 makes of a plant with gain 1, t seconds after its dead time.

function twoLags(t, T1, T2) {
    const [a, b] = [T1, Math.min(T2, 0.999 * T1)]; // equal ones by ones that nearly are
    return b < 1e-6 * a ? 1 - Math.exp(-t / a) : 1 - (a * Math.exp(-t / a) - b * Math.exp(-t / b)) / (a - b);
}

function ringing(t, T, damping) {
    const [fall, turn] = [damping / T, Math.sqrt(1 - damping * damping) / T];
    return 1 - Math.exp(-fall * t) * (Math.cos(turn * t) + fall / turn * Math.sin(turn * t));
}

const SHAPES = {
    first: (t, { T1 }) => 1 - Math.exp(-t / T1),
    second: (t, { T1, T2 }) => twoLags(t, T1, T2),
    integrating: (t, { T2 }) => t - T2 * (1 - Math.exp(-t / T2)),
    ringing: (t, { T1, damping }) => ringing(t, T1, damping),
    ramp: (t, { T1 }) => Math.min(1, t / T1), // one that ends: it is only refused
};

export function shapeAt(kind, numbers, t) {
    return t <= numbers.dead ? 0 : SHAPES[kind](t - numbers.dead, numbers);
}

export function modelAt(model, t) {
    return model.start + model.rise * shapeAt(model.kind, model, t);
}

// What a search moves, any real numbers, and the plant's numbers of them.
const limited = (x, low, high) => Math.min(high, Math.max(low, x));
const NUMBERS_OF = {
    first: ([a, dead]) => ({ T1: Math.exp(a), dead: Math.abs(dead) }),
    second: ([a, dead, b]) => ({ T1: Math.exp(a), T2: Math.exp(a) / (1 + Math.exp(limited(b, -30, 30))), dead: Math.abs(dead) }),
    integrating: ([a, dead]) => ({ T2: Math.exp(a), dead: Math.abs(dead) }),
    ringing: ([a, dead, b]) => ({ T1: Math.exp(a), damping: 0.97 / (1 + Math.exp(limited(b, -30, 30))), dead: Math.abs(dead) }),
    ramp: ([a, dead]) => ({ T1: Math.exp(a), dead: Math.abs(dead) }),
};

// --- Least squares --------------------------------------------------------------

// The start and the rise that fit these numbers best, and what is left: a weighted
// line through the points (shape, value).
function projected({ times, values, weights }, kind, numbers) {
    const n = times.length;
    const shape = new Float64Array(n);
    let [sw, sx, sy] = [0, 0, 0];
    for (let i = 0; i < n; i++) {
        shape[i] = shapeAt(kind, numbers, times[i]);
        const w = weights[i];
        sw += w;
        sx += w * shape[i];
        sy += w * values[i];
    }
    const [mx, my] = [sx / sw, sy / sw];
    let [xx, xy, yy] = [0, 0, 0];
    for (let i = 0; i < n; i++) {
        const [dx, dy] = [shape[i] - mx, values[i] - my];
        xx += weights[i] * dx * dx;
        xy += weights[i] * dx * dy;
        yy += weights[i] * dy * dy;
    }
    const rise = xx > 0 ? xy / xx : 0;
    const left = Math.max(0, yy - rise * xy);
    return { kind, ...numbers, rise, start: my - rise * mx, error: Math.sqrt(left / sw), r2: yy > 0 ? 1 - left / yy : 0 };
}

// Nelder and Mead's simplex from a place, with the first sides of it.
export function lowest(f, start, sides, turns) {
    const at = (x) => ({ x, f: f(x) });
    let corners = [at(start), ...sides.slice(0, start.length).map((side, i) => at(start.map((one, k) => one + (k === i ? side : 0))))];
    for (let turn = 0; turn < turns; turn++) {
        corners.sort((a, b) => a.f - b.f);
        const worst = corners.at(-1);
        if (worst.f - corners[0].f <= 1e-10 * Math.abs(corners[0].f)) {
            break;
        }
        const middle = start.map((_, k) => corners.slice(0, -1).reduce((sum, one) => sum + one.x[k], 0) / start.length);
        const along = (far) => at(middle.map((one, k) => one + far * (one - worst.x[k])));
        const mirrored = along(1);
        const tried = mirrored.f < corners[0].f ? [mirrored, along(2)]
            : mirrored.f < corners.at(-2).f ? [mirrored]
                : [along(mirrored.f < worst.f ? 0.5 : -0.5)].filter((one) => one.f < Math.min(mirrored.f, worst.f));
        if (tried.length > 0) {
            corners[corners.length - 1] = tried.reduce((best, one) => (one.f < best.f ? one : best));
        } else {
            corners = corners.map((one) => (one === corners[0] ? one : at(one.x.map((x, k) => (x + corners[0].x[k]) / 2))));
        }
    }
    return corners.reduce((best, one) => (one.f < best.f ? one : best)).x;
}

// Where searches begin: lags as parts of the time after the step, dead times, and
// the third number.
const GRID = {
    first: [[0.003, 0.01, 0.03, 0.08, 0.2, 0.5, 2], [0, 0.02, 0.06, 0.15, 0.4], [0]],
    second: [[0.003, 0.01, 0.03, 0.08, 0.2, 0.5, 2], [0, 0.02, 0.06, 0.15, 0.4], [0.1, 2.5]],
    integrating: [[0.003, 0.03, 0.1, 0.3], [0, 0.02, 0.06, 0.15, 0.4], [0]],
    ringing: [Array.from({ length: 26 }, (_, i) => 0.002 * 1.25 ** i), [0, 0.02, 0.06, 0.15, 0.4], [-0.5, 1, 3]],
    ramp: [[0.02, 0.05, 0.1, 0.2, 0.4, 0.7], [0, 0.02, 0.06, 0.15, 0.4], [0]],
};

// A kind's best fit: by a grid and a search over few points, once more with the
// weights of what is left, and a last time over all.
function* fitted(kind, data, span) {
    const few = { ...thinned(data.times, data.values, FEW_POINTS) };
    few.weights = new Float64Array(few.times.length).fill(1);
    const size = kind === 'second' || kind === 'ringing' ? 3 : 2;
    const errorOf = (points) => (x) => projected(points, kind, NUMBERS_OF[kind](x)).error;
    const [lags, deads, thirds] = GRID[kind];
    const places = lags.flatMap((lag) => deads.flatMap((dead) => thirds.map((third) =>
        [Math.log(lag * span), dead * span, third].slice(0, size))));
    const judged = [];
    for (const [at, x] of places.entries()) {
        judged.push({ x, f: errorOf(few)(x) });
        if (at % 20 === 19) {
            yield;
        }
    }
    judged.sort((a, b) => a.f - b.f);
    let x = judged[0].x;
    let best = Infinity;
    for (const start of judged.slice(0, 3)) {
        const found = lowest(errorOf(few), start.x, [0.3, 0.03 * span, 0.5], 150);
        const f = errorOf(few)(found);
        [x, best] = f < best ? [found, f] : [x, best];
        yield;
    }
    const all = { ...data, weights: new Float64Array(data.times.length).fill(1) };
    for (const points of [few, few, all, all]) {
        for (let i = 0; i < 6; i++) { // the start and the rise move with the weights
            points.weights = weightsOf(points, projected(points, kind, NUMBERS_OF[kind](x)));
        }
        x = lowest(errorOf(points), x, [0.02, 0.003 * span, 0.05], 60);
        yield;
    }
    return projected(all, kind, NUMBERS_OF[kind](x));
}

// Huber's: what is far from the model counts by its distance, not by its square.
function weightsOf({ times, values }, model) {
    const left = values.map((value, i) => Math.abs(value - modelAt(model, times[i])));
    const far = 2.5 * 1.4826 * median(left);
    return Float64Array.from(left, (one) => (one > far && far > 0 ? far / one : 1));
}

// The noise of neighbours, or what a step of the converter makes of it.
function noiseOf(values) {
    const bends = values.slice(2).map((value, i) => Math.abs(value - 2 * values[i + 1] + values[i]));
    const steps = values.slice(1).map((value, i) => Math.abs(value - values[i])).filter((one) => one > 0);
    const step = steps.length > 0 ? steps.reduce((least, one) => Math.min(least, one)) : 0;
    return Math.max(1.4826 * median(bends) / Math.sqrt(6), Math.min(step, median(steps.length > 0 ? steps : [0])) / Math.sqrt(12));
}

// --- Which one, or none ---------------------------------------------------------

// How far it came while it was recorded, in its unit.
function seenRise(model, span) {
    return Math.abs(model.rise * shapeAt(model.kind, model, span));
}

function isTooLong(model, span) {
    return (model.kind === 'first' || model.kind === 'second') && model.T1 > 1.2 * (span - model.dead);
}

// The one that explains most; another number has to earn its place.
function chosenOf(models, span, noise, n) {
    const scale = Math.max(...models.map((one) => Math.min(seenRise(one, span), 1e300)));
    const floor = (0.3 * noise) ** 2 + (1e-4 * scale) ** 2;
    const score = ({ kind, error }) => Math.min(n, 200) * Math.log(error ** 2 + floor) + (kind === 'second' || kind === 'ringing' ? 12 : 0);
    const straight = models.find(({ kind }) => kind === 'integrating');
    // A lag that is far too long for the recording has to be seen; an oscillator that
    // hardly swings is two lags.
    const kinds = models.filter((one) => !(isTooLong(one, span) && score(straight) < score(one) + 8) &&
        !(one.kind === 'ringing' && one.damping > SWINGS));
    return kinds.reduce((best, one) => (score(one) < score(best) ? one : best));
}

// Why a model is not to be used, or null.
function refusalOfModel(model, ramp, { span, noise, every, times }) {
    const seen = seenRise(model, span);
    const after = span - model.dead;
    const part = model.error / seen;
    const least = Math.min(noise, model.error);
    if (!(seen > 0) || model.r2 < 0.5 || seen < 3 * least) {
        return 'There is no step here: the measurement moves no further than its noise.';
    }
    if (model.kind !== 'integrating' && ramp.error < 0.6 * model.error && model.error > 1.5 * noise && ramp.T1 < 0.9 * (span - ramp.dead) && ramp.T1 > 4 * every) {
        return `The measurement is a ramp that ends after ${digits(ramp.dead + ramp.T1)} s: it ran into an end of its range, or the drive did. Record a smaller step.`;
    }
    if (part > FITS_BADLY && (model.error > 3 * noise || part > 0.25)) {
        return `Nothing fits: the best is ${percent(part)} of the rise away. Was there one step only, and no load?`;
    }
    if (isTooLong(model, span)) {
        const lag = model.T1 < 5 * after ? `The lag of about ${digits(model.T1, 2)} s` : 'The lag';
        return `${lag} is beyond the recording, which has ${digits(after)} s after the dead time: record until the measurement stands still.`;
    }
    const settled = shapeAt(model.kind, model, span);
    if ((model.kind === 'first' || model.kind === 'second') && settled < SETTLED) {
        return `It has not settled: ${percent(settled, 0)} of its rise is recorded. Record at least ${digits(3 * model.T1)} s after the step.`;
    }
    if (model.kind === 'ringing' && model.damping > SWINGS) {
        return 'It does not swing: see two lags.';
    }
    if (model.kind === 'ringing' && model.damping < 0.02) {
        return 'It swings on and on: that is no answer to a step.';
    }
    if (model.kind === 'ringing' && after < 6 * model.T1) {
        return `It has not settled: less than one swing is recorded. Record at least ${digits(15 * model.T1)} s.`;
    }
    if (model.kind === 'integrating' && after < 3 * model.T2) {
        return `It has not come to a steady slope. Record at least ${digits(6 * model.T2)} s after the step.`;
    }
    const main = model.kind === 'integrating' ? model.dead + after / 4 : model.kind === 'second' ? model.T1 + model.T2 : model.T1;
    if (main < 0.7 * every || times.filter((t) => t > model.dead).length < 6) {
        return `It is over within ${digits(main)} s, and lines are ${digits(every)} s apart: record faster.`;
    }
    return null;
}

// The worth of a fit in words. What noise does not explain is told apart.
function worthOf(model, span, noise) {
    const part = model.error / seenRise(model, span);
    const close = part <= FITS_WELL && (model.error <= 2 * noise || part <= FITS_WELL / 3);
    const word = close ? 'fits well' : part <= FITS_BADLY ? 'fits roughly' : 'fits in much noise';
    return { part, word };
}

// All models of a recording as `understood` gives it, by and by: { models: each with
// refused: the reason or null, chosen: the kind, span, noise }, or { refused }.
export function* fitModels({ times, values, stepAt, every }) {
    const data = { times: times.map((t) => t - stepAt), values };
    const span = data.times.at(-1);
    const after = data.times.filter((t) => t > 0).length;
    if (after < 8) {
        return { refused: `Only ${after} lines are after the step at ${digits(stepAt)} s; at least 8 are needed.` };
    }
    const facts = { span, noise: noiseOf(values), every, times: data.times };
    const found = {};
    for (const kind of Object.keys(GRID)) {
        found[kind] = yield* fitted(kind, data, span);
    }
    const { ramp, ...others } = found;
    // What is far shorter than the time between lines is none.
    const none = (seconds) => (seconds < every / 100 ? 0 : seconds);
    const models = Object.values(others).map((one) => ({ ...one, dead: none(one.dead), ...(one.T2 === undefined ? {} : { T2: none(one.T2) }) }))
        .map((one) => ({ ...one, refused: refusalOfModel(one, ramp, facts), ...worthOf(one, span, facts.noise) }));
    const best = chosenOf(models, span, facts.noise, after);
    return { models, chosen: best.kind, span, noise: facts.noise };
}

// What is understood of a text, and the models of it: { read, fit }, by and by.
export function* recordingOf(text, choices) {
    const read = yield* understood(text, choices);
    return { read, fit: read.refused === undefined ? yield* fitModels(read) : null };
}

// --- Words -----------------------------------------------------------------------

// A model's numbers, for a step of this part of full drive.
export function modelText(model, step, unit) {
    const per = digits(model.rise / step);
    const dead = `dead time ${digits(model.dead)} s`;
    switch (model.kind) {
    case 'integrating': return `Slope ${per} ${unit}/s at full drive, lag ${digits(model.T2)} s, ${dead}`;
    case 'second': return `Gain ${per} ${unit} at full drive, lags ${digits(model.T1)} s and ${digits(model.T2)} s, ${dead}`;
    case 'ringing': return `Gain ${per} ${unit} at full drive, rings every ${digits(2 * Math.PI * model.T1 / Math.sqrt(1 - model.damping ** 2))} s with damping ${digits(model.damping)}, ${dead}`;
    default: return `Gain ${per} ${unit} at full drive, lag ${digits(model.T1)} s, ${dead}`;
    }
}
