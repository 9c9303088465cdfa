// SPDX-License-Identifier: MIT
// The table of what the page and the Python package both say of a scene, in numbers and
// words, shared.json: here it is compared with what the page's modules compute in node, and
// python/test/tuner.py compares it with the package. `--update` writes it.
//
//   node test/web/tuner/shared.mjs FOLDER [--update]     FOLDER has the page's modules: see run
//
// More rows: another entry in SCENES, or another list beside them in `table`, which
// python/test/tuner.py then reads.
import { readFileSync, writeFileSync } from 'node:fs';
import { isDeepStrictEqual } from 'node:util';

const [folder, ...options] = process.argv.slice(2);
const TABLE = 'test/web/tuner/shared.json';

const load = (name) => import(`${process.cwd()}/${folder}/${name}.js`);
const { EXPERIMENT, PARAM, WORD } = await load('built');
const { experiment, run, startEngine } = await load('engine');
const { digits, percent, short } = await load('format');
const { gainsOfRule } = await load('rules');
const { wholeHeaderOf } = await load('header');
const { marginsOf } = await load('margins');
const { adviceOf } = await load('advice');
const { PRESETS, fragmentOf, presetState, stateOfFragment } = await load('state');
await startEngine();

// --- Scenes --------------------------------------------------------------------------

const preset = (id, more = {}) => {
    const { name, story, kept, CLOCK, ...state } = PRESETS.find((one) => one.preset === id);
    return { ...state, ...more };
};
// fixpid_pid with the plants that Python's Plant has.
const SCENES = [
    ...['oven', 'flow', 'spring', 'axis'].map((id) => preset(id)),
    preset('flow', { SENSOR_BITS: 15, WEIGHT: 0.3, OPTIONS: 0x40, KD: 0.4, FILTER: 0, INTEGRAL_MIN: -50, INTEGRAL_MAX: 900,
        unit: 'm³/h', events: [{ at: 20, what: 'MANUAL', a: 300, b: 0 }, { at: 30, what: 'AUTO', a: 0, b: 0 },
            { at: 50, what: 'LIMITS', a: 100, b: 700 }, { at: 60.3, what: 'FEEDFORWARD', a: 55, b: 0 }] }),
    preset('flow', { GAIN: -80, START: 95, OPTIONS: 0x80, SETPOINT: 40, KP: 1.1, DEAD: 0, T2: 0, events: [] }),
    preset('flow', { KP: 4.5, KI: 2.2, DURATION: 40, events: [] }), // swings
    preset('flow', { KP: 0.05, KI: 0.0007, RATE: 0.5, DURATION: 900, OPTIONS: 0x20, WEIGHT: 0, SENSOR_BITS: 8 }),
    preset('axis', { T2: 0, DEAD: 0.035, KD: 0, OUTPUT_MAX: 400, SETPOINT: 390, DURATION: 6 }),
    preset('oven', { RATE: 50, DEAD: 3.01, DURATION: 400, KI: 30, SETPOINT: 400 }),
    preset('spring', { DAMPING: 0.9, KI: 120, DURATION: 6 }),
    preset('flow', { KP: 1.04, WEIGHT: 255 / 256, unit: '' }), preset('flow', { KP: 1.05 }), // on both sides of an Ms of 2.2
    preset('flow', { KP: 200 }), // refused
    preset('flow', { loop: 'Zone_2' }),
    preset('flow', { GAIN: -80, START: 95 }), // acts against its plant
    preset('flow', { RATE: 20000, DURATION: 0.1, T1: 0.002, T2: 0, DEAD: 0, KP: 8, KI: 0, KD: 0, events: [] }), // its delay margin is below 0.1 ms
];

const chosen = (from, names) => Object.fromEntries(names.filter((name) => name in from).map((name) => [name, from[name]]));
const sum = (series) => series.reduce((total, x) => total + x, 0);

function sceneRow(state) {
    const found = run(state);
    const linked = { ...presetState(state.preset), ...state };
    const good = found.n > 0;
    const margins = good ? marginsOf(state, found.results) : null;
    const more = good && {
        sums: Object.fromEntries(Object.entries(found.series).map(([name, series]) => [name, sum(series)])),
        fragment: fragmentOf(linked),
        header: wholeHeaderOf(linked, found.results, margins),
    };
    return { state, n: found.n, results: chosen(found.results, ['KP', 'KI', 'KD', 'FILTER', 'WEIGHT', 'OPTIONS', 'DEAD_S']),
        warnings: adviceOf(state, found, margins).warnings, ...more };
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
    return { value, text: String(value), short: short(value), digits: digits(value), percent: percent(value) };
}

const pids = SCENES.slice(0, 4);
const NUMBERS_SHOWN = [0, 1, -1, 0.1 + 0.2, 2.5, 1234.5, -0.0005, 12345678, 1e21, 1e-7, 123456.5, 0.000244140625, 99.95, 2 / 3, -1e6];
const table = {
    scenes: SCENES.map(sceneRow),
    rules: pids.flatMap((state) => Object.values(EXPERIMENT).map((kind) => ruleRow({ ...state, EXPERIMENT: kind }))),
    links: [...pids, SCENES[4]].map(linkRow),
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
let failed = 0;
for (const name of Object.keys({ ...kept, ...now })) {
    const differ = (now[name] ?? []).filter((row, i) => !isDeepStrictEqual(row, kept[name]?.[i])).length;
    const same = differ === 0 && kept[name]?.length === now[name]?.length;
    console.log(same ? `ok table of ${name}` : `FAILED table of ${name}: ${differ} rows differ; to renew ${TABLE}: node test/web/tuner/shared.mjs ${folder} --update`);
    failed += same ? 0 : 1;
}
process.exit(failed > 0 ? 1 : 0);
