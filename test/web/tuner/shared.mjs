// SPDX-License-Identifier: MIT
// The table of numbers that the page's mathematics and the Python package's are both held
// to, shared.json: here it is compared with what the page's modules compute in node, and
// python/test/tuner.py compares it with the package. `--update` writes it.
//
//   node test/web/tuner/shared.mjs FOLDER [--update]     FOLDER has the page's modules: see run
//
// More rows: another entry in RECORDINGS, HARDWARE or SCENES, or another list beside them in `table`,
// which python/test/tuner.py then reads.
import { readFileSync, writeFileSync } from 'node:fs';
import { isDeepStrictEqual } from 'node:util';

const [folder, ...options] = process.argv.slice(2);
const TABLE = 'test/web/tuner/shared.json';

const load = (name) => import(`${process.cwd()}/${folder}/${name}.js`);
const { EXPERIMENT, PARAM, PLANT, WORD } = await load('built');
const { experiment, run, startEngine } = await load('engine');
const { digits, percent, short, whole } = await load('format');
const { gainsOfRule } = await load('rules');
const { wholeHeaderOf } = await load('header');
const { marginsOf } = await load('margins');
const { metricsOf } = await load('metrics');
const { recordingOf, shapeAt } = await load('models');
const { adviceOf } = await load('advice');
const { plantOfModel } = await load('recorder');
const { PRESETS, fragmentOf, ownState, presetState, stateOfFragment } = await load('state');
await startEngine();

// --- Recordings, of a plant that is known ------------------------------------------

let seed = 20261126;

function draw() {
    seed = (seed * 48271) % 2147483647;
    return seed / 2147483647;
}

// `u` is the drive: [before, after] a step at the line `at`, and what it is at later lines.
// Without it the step is at the first line.
const HEATER = { kind: 'first', gain: 2.4, T1: 140, dead: 9, start: 21, seconds: 960, lines: 100, noise: 0.3, at: 8, u: [10, 40] };
const STEP = { kind: 'first', gain: 5, T1: 2, dead: 0, start: 0, seconds: 12, lines: 60, noise: 0 };
const SPRING = { kind: 'ringing', gain: 0.4, T1: 0.3, damping: 0.2, dead: 0.1, start: 10, seconds: 9, lines: 110, noise: 0.1, at: 10, u: [0, 50] };
const AXIS = { kind: 'integrating', gain: 0.7, T2: 0.8, dead: 0.3, start: 40, seconds: 12, lines: 90, noise: 0.05, at: 9, u: [0, 2] };
const RECORDINGS = [
    { name: 'heater', ...HEATER },
    { name: 'no dead time', ...STEP },
    { name: 'falls', ...STEP, gain: -38, T1: 0.4, dead: 0.15, start: 61, seconds: 3, lines: 90, noise: 0.2 },
    { name: 'long dead time', ...STEP, gain: 0.08, T1: 30, dead: 55, start: 1, seconds: 300, lines: 80, noise: 0.0005 },
    { name: 'two lags', ...HEATER, kind: 'second', gain: 1, T1: 20, T2: 9, dead: 2, start: 20, seconds: 200, lines: 140, noise: 0.2, u: [100, 0] },
    { name: 'milliseconds', ...STEP, gain: 900, T1: 0.012, dead: 0.003, start: 40, seconds: 0.08, lines: 70, noise: 2 },
    { name: 'integrates', ...AXIS },
    { name: 'rings', ...SPRING },
    { name: 'a lag that is far too long', ...HEATER, T1: 9000 },
    { name: 'a converter of few steps', ...HEATER, noise: 0, rounded: 2 },
    { name: 'a broken wire', ...HEATER, spikes: { 20: 900, 61: 77, 90: -50 } },
    { name: 'the drive moves again', ...HEATER, later: { 80: 25 } },
    { name: 'so many lines that means are taken', ...HEATER, lines: 90, dense: 25 },
    { name: 'flat', ...STEP, gain: 0, start: 5, lines: 20 },
    { name: 'noise', ...STEP, gain: 0, lines: 40, noise: 1 },
    { name: 'a step in its noise', ...HEATER, T1: 20, at: 50, noise: 47 },
    { name: 'a ramp that ends', ...STEP, kind: 'ramp', T1: 5, lines: 80, noise: 0.01 },
    { name: 'a load', ...HEATER, noise: 0.1, load: { from: 60, is: -40 } },
    { name: 'has not settled', ...HEATER, seconds: 240 },
    { name: 'a lag beyond the recording', ...HEATER, T1: 1500, noise: 0.02 },
    { name: 'swings on and on', ...SPRING, damping: 0.005 },
    { name: 'less than a swing', ...SPRING, T1: 1.9, lines: 80 },
    { name: 'no steady slope', ...AXIS, T2: 6 },
    { name: 'is over between two lines', ...HEATER, T1: 3, dead: 0 },
    { name: 'too few lines after the step', ...HEATER, lines: 40, asked: 800 },
    { name: 'a drive that moves all the time', ...HEATER, lines: 40, later: Object.fromEntries([12, 16, 20, 24, 28, 32, 36].map((i) => [i, 40 + i])) },
    { name: 'a drive that drifts', ...HEATER, lines: 40, later: { 12: 43, 20: 46, 28: 49 } },
    { name: 'a drive of many steps', ...HEATER, later: { 20: 10, 30: 40, 40: 10, 50: 40, 60: 10, 70: 40, 80: 10 } },
];

const figures = (count, x) => Number(x.toPrecision(count));

// Uneven in time, and rounded as a file has it. `dense` lines stand in the place of each.
function recorded(plant) {
    const { gain, start, seconds, lines, noise, at = 0, u, later = {}, rounded, spikes = {}, load, dense = 1 } = plant;
    const times = Array.from({ length: lines }, (_, i) => (i === 0 ? 0 : figures(4, (i + 0.6 * (draw() - 0.5)) / lines * seconds)));
    const stepAt = at === 0 ? 0 : (times[at - 1] + times[at]) / 2;
    const rise = gain * (u === undefined ? 1 : u[1] - u[0]);
    let now = 0;
    const drive = u === undefined ? null : times.map((_, i) => {
        now = later[i] ?? (i === at ? u[1] : i === 0 ? u[0] : now);
        return now;
    });
    const values = times.map((t, i) => {
        const value = start + rise * shapeAt(plant.kind, plant, t - stepAt) + noise * (2 * draw() - 1) + (i >= load?.from ? load.is : 0);
        return spikes[i] ?? (rounded === undefined ? figures(5, value) : rounded * Math.round(value / rounded));
    });
    return { times, drive, values, dense };
}

// As the page has them from the lines of a text. Between two lines of a recording are more,
// at even distances and with the same values, where it is dense.
function fitRow({ name, asked = null, ...plant }) {
    const { times, drive, values, dense } = recorded(plant);
    const lines = times.flatMap((t, i) => Array.from({ length: dense }, (_, k) =>
        [t + ((times[i + 1] ?? t) - t) * k / dense, ...(drive === null ? [] : [drive[i]]), values[i]].join()));
    const choices = { time: 0, drive: drive === null ? -1 : 1, value: drive === null ? 1 : 2, unit: 's', stepAt: asked ?? NaN };
    const parts = recordingOf(lines.slice(0, dense > 1 ? -dense : lines.length).join('\n'), choices);
    let part = parts.next();
    while (!part.done) {
        part = parts.next();
    }
    const { read, fit: { models, ...facts } } = part.value;
    const short = (model) => Object.fromEntries(Object.entries(model).map(([key, value]) => [key, typeof value === 'number' ? figures(8, value) : value]));
    const fit = models === undefined ? facts : { ...facts, models: models.map(short) };
    const { stepAt, every, outliers, jump } = read;
    return { name, times, drive, values, dense, asked, read: { stepAt, every, outliers, jump, points: read.times.length }, fit };
}

// --- The plant of a model, on hardware ---------------------------------------------------

const HARDWARE = [
    { SENSOR_BITS: 10, SENSOR_LOW: -40, SENSOR_RANGE: 300, OUTPUT_MIN: 0, OUTPUT_MAX: 255, RATE: 4 },
    { SENSOR_BITS: 15, SENSOR_LOW: 0, SENSOR_RANGE: 64, OUTPUT_MIN: -1000, OUTPUT_MAX: 800, RATE: 200 },
];
const OWN = ['PLANT', 'GAIN', 'T1', 'T2', 'DAMPING', 'DEAD', 'START', 'DURATION', 'SETPOINT', 'OPTIONS', 'KP', 'KI', 'KD', 'FILTER', 'WEIGHT', 'events'];

// Of each model that can be taken, as the page takes it; full drive is 100 in these recordings.
const TAKEN = ['heater', 'two lags', 'milliseconds', 'integrates', 'rings', 'the drive moves again'];

function plantRows({ name, read: { jump }, fit }) {
    const models = fit.models.filter(({ refused }) => refused === null);
    const [step, rest] = jump === null ? [1, 0] : [(jump.to - jump.from) / 100, jump.from / 100];
    return models.flatMap((model) => HARDWARE.map((hardware) => {
        const scene = ownState({ ...presetState('own'), ...hardware }, plantOfModel(model, { step, rest }));
        return { name, kind: model.kind, step, rest, hardware, scene: chosen(scene, OWN) };
    }));
}

// --- Scenes --------------------------------------------------------------------------

const preset = (id, more = {}) => {
    const { name, story, kept, CLOCK, ...state } = PRESETS.find((one) => one.preset === id);
    return { ...state, ...more };
};
const SCENES = [
    ...['oven', 'flow', 'spring', 'axis', 'motor', 'an937', 'an964'].map((id) => preset(id)),
    preset('flow', { SENSOR_BITS: 15, WEIGHT: 0.3, OPTIONS: 0x40, KD: 0.4, FILTER: 0, INTEGRAL_MIN: -50, INTEGRAL_MAX: 900,
        unit: 'm³/h', events: [{ at: 20, what: 'MANUAL', a: 300, b: 0 }, { at: 30, what: 'AUTO', a: 0, b: 0 },
            { at: 50, what: 'LIMITS', a: 100, b: 700 }, { at: 60.3, what: 'FEEDFORWARD', a: 55, b: 0 }] }),
    preset('flow', { GAIN: -80, START: 95, OPTIONS: 0x80, SETPOINT: 40, KP: 1.1, DEAD: 0, T2: 0, events: [] }),
    preset('flow', { KP: 4.5, KI: 2.2, DURATION: 40, events: [] }), // swings
    preset('flow', { KP: 0.05, KI: 0.0007, RATE: 0.5, DURATION: 900, OPTIONS: 0x20, WEIGHT: 0, SENSOR_BITS: 8 }),
    preset('axis', { T2: 0, DEAD: 0.035, KD: 0, OUTPUT_MAX: 400, SETPOINT: 500, DURATION: 6 }),
    preset('oven', { RATE: 50, DEAD: 3.01, DURATION: 500, KI: 30, SETPOINT: 430 }),
    preset('spring', { DAMPING: 0.9, KI: 120, DURATION: 6 }),
    preset('flow', { KP: 1.04, WEIGHT: 255 / 256, unit: '' }), preset('flow', { KP: 1.05 }), // on both sides of an Ms of 2.2
    ...[{ KP: 200 }, { KP: -1 }, { KI: 1e-9 }, { KD: 500 }, { OUTPUT_MAX: 0 }, { INTEGRAL_MIN: 5 }, { WEIGHT: 1.5 }, { FILTER: 9 }]
        .map((wrong) => preset('flow', wrong)),
    preset('an937', { KP: 300 }), preset('an964', { KI: 2000 }),
    preset('flow', { GAIN: -80, START: 95 }), // acts against its plant
    preset('motor', { RATE: 20000, DURATION: 0.1, KP: 60, KI: 0, events: [] }), // its delay margin is below 0.1 ms
];

const FIGURES = ['overshoot', 'rise', 'settled', 'load', 'meanError', 'moved', 'limited', 'travel'];
const MARGINS = ['ms', 'gainMargin', 'lowerGainMargin', 'phaseMargin', 'delayMargin', 'stable'];
const chosen = (from, names) => Object.fromEntries(names.filter((name) => name in from).map((name) => [name, from[name]]));
const sum = (series) => series.reduce((total, x) => total + x, 0);

function sceneRow(state) {
    const found = run(state);
    const linked = { ...presetState(state.preset), ...state };
    const good = found.n > 0;
    const margins = good ? marginsOf(state, found.results) : null;
    const more = good && {
        sums: Object.fromEntries(Object.entries(found.series).map(([name, series]) => [name, sum(series)])),
        metrics: { ...chosen(metricsOf(state, found), FIGURES), twin: metricsOf(state, found).twin },
        margins: { ...chosen(margins, MARGINS), curve: [0, 160, 320, 479].map((i) => margins.curve[i]) },
        fragment: fragmentOf(linked),
        header: wholeHeaderOf(linked, found.results, margins),
    };
    return { state, n: found.n, results: chosen(found.results, ['KP', 'KI', 'KD', 'FILTER', 'WEIGHT', 'OPTIONS', 'DEAD_S']),
        advice: adviceOf(state, found, margins), ...more };
}

// By each rule and each word: whether there are gains, and those that fold to the integers.
function ruleRow(state) {
    const found = experiment(state);
    const words = Object.values(WORD);
    const rows = found.rules.filter(({ robustness }) => words.includes(robustness));
    return { state, n: found.n, status: found.results.STATUS, rules: rows.map(({ rule, robustness, has, results }) =>
        ({ rule, robustness, has, reason: results.REASON, gains: has ? gainsOfRule(state, results) : null })) };
}

// A link that says all: opening it makes this state.
const NUMBERS = Object.keys(PARAM).filter((name) => name !== 'CONTROLLER' && name !== 'PLANT');

function linkRow(state) {
    const events = state.events.map(({ at, what, a = 0, b = 0 }) => [what.toLowerCase(), at, a, b].join('_')).join('~');
    const fragment = [`p=${state.preset}`, ...NUMBERS.map((name) => `${name.toLowerCase()}=${state[name]}`),
        `unit=${encodeURIComponent(state.unit)}`, `rule=${state.rule}`, `events=${events}`].join('&');
    const opened = stateOfFragment(fragment);
    const lost = [...NUMBERS, 'PLANT', 'CONTROLLER', 'unit', 'rule'].filter((name) => opened[name] !== state[name]);
    if (lost.length > 0 || opened.events.length !== state.events.length) {
        throw new Error(`the link of ${state.preset} loses ${lost}`);
    }
    return { state, fragment };
}

function numberRow(value) {
    return { value, text: String(value), short: short(value), digits: digits(value), percent: percent(value), whole: whole(value) };
}

const pids = SCENES.slice(0, 5);
const NUMBERS_SHOWN = [0, 1, -1, 0.1 + 0.2, 2.5, 1234.5, -0.0005, 12345678, 1e21, 1e-7, 123456.5, 0.000244140625, 99.95, 2 / 3, -1e6];
const fits = RECORDINGS.map(fitRow);
const table = {
    fits,
    plants: fits.filter(({ name }) => TAKEN.includes(name)).flatMap(plantRows),
    scenes: SCENES.map(sceneRow),
    rules: pids.filter(({ PLANT: plant }) => plant !== PLANT.MOTOR)
        .flatMap((state) => Object.values(EXPERIMENT).map((kind) => ruleRow({ ...state, EXPERIMENT: kind }))),
    links: [...pids, SCENES[7]].map(linkRow),
    numbers: NUMBERS_SHOWN.map(numberRow),
};

// --- Against the file ----------------------------------------------------------------

const list = (rows) => rows.map((row) => JSON.stringify(row, (_, x) => (Object.is(x, -0) ? 0 : x))).join(',\n');
const escaped = (string) => string.replace(/[\u0080-\uFFFF]/g, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, '0')}`);
const text = escaped(`{\n${Object.entries(table).map(([name, rows]) => `"${name}": [\n${list(rows)}]`).join(',\n')}\n}\n`);
if (options.includes('--update')) {
    writeFileSync(TABLE, text);
}
const kept = JSON.parse(readFileSync(TABLE, 'utf8'));
const now = JSON.parse(text);
const differing = (rows, others = []) => rows.filter((row, i) => !isDeepStrictEqual(row, others[i])).length +
    Math.max(0, others.length - rows.length);
let failed = 0;

function check(name, good, why) {
    console.log(good ? `ok ${name}` : `FAILED ${name}: ${why}`);
    failed += good ? 0 : 1;
}

for (const [name, rows] of Object.entries(now)) {
    const count = differing(rows, kept[name]);
    check(`table of ${name}: ${rows.length} rows`, count === 0,
        `${count} differ; to renew ${TABLE}: node test/web/tuner/shared.mjs ${folder} --update`);
}
check('table has these lists', isDeepStrictEqual(Object.keys(kept), Object.keys(now)), Object.keys(kept).join(' '));
const turned = kept.scenes.map((row, i) => (i === 3 ? { ...row, n: row.n + 1 } : row));
check('a number that differs is seen, and a row too many', differing(now.scenes, turned) === 1 &&
    differing(now.fits, [...kept.fits, {}]) === 1, 'it is not');
process.exit(failed > 0 ? 1 : 0);
