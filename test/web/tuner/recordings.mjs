// SPDX-License-Identifier: MIT
// Recordings of plants that are known, written as loggers and people write them: how
// the page's modules read and fit them, without a browser.
// recordings.json has them, row by row, with what has to come out.
//
//   node test/web/tuner/recordings.mjs [words of a row's name]
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, random, WORK } from './harness.mjs';
import { record, written } from './made.mjs';

const moduleOf = (name) => import(`${process.cwd()}/${WORK}/modules/${name}.js`);
const { readCell } = await moduleOf('cells');
const { modelAt, recordingOf } = await moduleOf('models');
const { simcGains } = await moduleOf('own');
const { PLANT } = await moduleOf('built');

const { recordings, rows, clocks, gains } = JSON.parse(readFileSync('test/web/tuner/recordings.json', 'utf8'));
const only = process.argv[2] ?? '';
const TIME_MAX = 20; // seconds of the processor for all rows
const seconds = () => process.cpuUsage().user / 1e6;

function textOf(name, how) {
    if (name.startsWith('text: ')) {
        return name.slice(6);
    }
    const text = written(record(random, recordings[name]), how);
    return how.replace ? text.replaceAll(...how.replace) : text;
}

function finished(parts) {
    for (;;) {
        const { done, value } = parts.next();
        if (done) {
            return value;
        }
    }
}

// --- Rows -----------------------------------------------------------------------

const STEP = 0.3;
const near = (value, wanted, part) => {
    const [goal, away] = Array.isArray(wanted) ? wanted : [wanted, part * Math.abs(wanted)];
    return Math.abs(value - goal) <= away;
};

// What of a row is not as wanted.
function wrongOf(text, choices, want) {
    const { read, fit } = finished(recordingOf(text, choices));
    const model = fit?.models?.find(({ kind }) => kind === fit.chosen) ?? {};
    const refused = read.refused ?? fit.refused ?? model.refused ?? null;
    const notes = read.notes ?? [];
    const found = { ...model, refused, gain: model.rise / STEP, sum: model.T1 + model.T2, sum2: model.dead + model.T2, chosen: fit?.chosen,
        roles: Object.values(read.roles ?? {}).join(' '), names: read.names?.join('|'), unit: read.unit, stepAt: read.stepAt, by: read.by,
        outliers: read.outliers?.length, points: read.times?.length, span: read.times?.at(-1), jump: read.jump };
    const sentence = notes.join(' ');
    const wrong = [];
    const say = (yes, name) => yes && wrong.push(`${name} is ${JSON.stringify(found[name])} instead of ${JSON.stringify(want[name])}`);
    say(want.refused === undefined ? refused !== null : refused === null || !refused.includes(want.refused), 'refused');
    for (const name of ['chosen', 'roles', 'names', 'unit', 'by', 'outliers', 'word', 'points']) {
        say(want[name] !== undefined && want[name] !== found[name], name);
    }
    for (const name of ['gain', 'T1', 'T2', 'dead', 'damping', 'sum', 'sum2', 'start', 'stepAt', 'span']) {
        say(want[name] !== undefined && !near(found[name], want[name], 0.03), name);
    }
    if (want.jump) {
        say(want.jump.join() !== [read.jump.from, read.jump.to].join(), 'jump');
    }
    for (const note of want.notes ?? []) {
        const not = note.startsWith('!');
        if (sentence.includes(not ? note.slice(1) : note) === not) {
            wrong.push(`“${sentence}” ${not ? 'has' : 'has not'} “${note}”`);
        }
    }
    if (want.why && !refused?.includes(want.why)) {
        wrong.push(`“${refused}” has not “${want.why}”`);
    }
    return wrong;
}

let [count, slowest, all] = [0, ['', 0], 0];
for (const [name, recording, how, choices, want] of rows.filter(([title]) => title.includes(only))) {
    const text = textOf(recording, how);
    const start = seconds();
    checkNone(`${name}`, wrongOf(text, choices, want));
    const took = seconds() - start;
    slowest = took > slowest[1] ? [name, took] : slowest;
    all += took;
    count += 1;
}
check(`${count} rows in ${all.toFixed(1)} s, the slowest ${slowest[0]} in ${slowest[1].toFixed(1)} s`, all < TIME_MAX, `more than ${TIME_MAX} s`);

// What is wanted wrongly is reported, each by itself.
{
    const text = textOf('oven', {});
    const planted = { chosen: 'first', roles: '1 -1 0', names: 'a|b', unit: 'ms', by: 'drive', outliers: 1, word: 'fits roughly', points: 399, gain: 250, T1: 150, T2: 14,
        dead: [14, 2], start: 25, stepAt: [5, 1], span: 700, refused: 'no step', notes: ['an egg'] };
    checkNone('a wrong answer is reported', [...Object.entries(planted), ['notes', ['!Time is in s']], ['why', 'an egg']]
        .filter(([key, value]) => wrongOf(text, {}, { [key]: value }).length !== 1).map(([key, value]) => `${key} ${value}`));
}

// --- Cells ------------------------------------------------------------------------

checkNone('clocks and dates', Object.entries(clocks).flatMap(([text, wanted]) => {
    const half = text.replace(/ ([ap])\.?m\.?$/i, '$1m');
    const { kind, value } = readCell(half, '.');
    return (wanted === null ? kind === 'text' : Math.abs(value - wanted) < 1e-6) ? [] : [`“${text}” is ${kind} ${value} instead of ${wanted}`];
}));

// Nothing that is no text of a recording ends in an exception.
checkNone('what makes no sense is refused or read, without an exception', ['\u0000', ',,,,\n,,,', '1e999,1e999\n'.repeat(20), '0,0\n'.repeat(20),
    `${'9'.repeat(400)},1\n`.repeat(20), '"'.repeat(99), '1,"2\n'.repeat(20), ';;1;;\n'.repeat(12), 'é\n'.repeat(9), '1 2 3 4 5\n'.repeat(30), `${'1,'.repeat(5000)}2\n`.repeat(10),
    Array.from({ length: 20 }, (_, i) => `${i},1e308`).join('\n'), Array.from({ length: 20 }, (_, i) => `${i},${i % 2 ? '-' : ''}1e308`).join('\n')]
    .flatMap((text) => {
        try {
            const { read, fit } = finished(recordingOf(text, {}));
            const chosen = fit?.models?.find(({ kind }) => kind === fit.chosen);
            const refused = read.refused ?? fit.refused ?? chosen.refused;
            return typeof refused === 'string' ? [] : [`“${text.slice(0, 20)}” is taken: ${JSON.stringify(chosen)}`];
        } catch (error) {
            return [`“${text.slice(0, 20)}”: ${error.message}`];
        }
    }));

// Each part of a long recording is short: a page that does the parts by itself is not held.
if (only === '') {
    const text = textOf('long', {});
    const parts = recordingOf(text, {});
    const lasted = [];
    for (let done = false; !done;) {
        const start = seconds();
        ({ done } = parts.next());
        lasted.push(seconds() - start);
    }
    lasted.sort((a, b) => b - a);
    check(`120 000 lines in ${lasted.length} parts, the longest ${(1000 * lasted[0]).toFixed(0)} ms`, lasted.length > 200 && lasted[0] < 0.3, `more than 300 ms: ${lasted.slice(0, 5)}`);
}

// --- First gains --------------------------------------------------------------------
// The numbers are of other code, in rational arithmetic: the coefficients of Skogestad's
// table for the plant in counts; and the largest sensitivity of the loop by its frequencies.

const product = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
const quotient = ([a, b], [c, d]) => [(a * c + b * d) / (c * c + d * d), (b * c - a * d) / (c * c + d * d)];

function sensitivity(s, { KP, KI, KD, FILTER }) {
    const gain = Math.abs(s.GAIN) * (2 ** s.SENSOR_BITS - 1) / s.SENSOR_RANGE / Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN);
    const [a2, a1, a0] = { LAGS: [s.T1 * s.T2, s.T1 + s.T2, 1], OSCILLATOR: [s.T1 * s.T1, 2 * s.DAMPING * s.T1, 1], INTEGRATOR: [s.T2, 1, 0] }[s.PLANT];
    const [late, tau] = [s.DEAD + 0.5 / s.RATE, FILTER > 0 ? 2 ** FILTER / s.RATE : 0];
    let most = 0;
    for (let w = 1e-5 * s.RATE; w < Math.PI * s.RATE; w *= 1.004) {
        const d = quotient([0, KD * w], [1, tau * w]);
        const plant = quotient([gain * Math.cos(w * late), -gain * Math.sin(w * late)], [a0 - a2 * w * w, a1 * w]);
        const [re, im] = product([KP + d[0], d[1] - KI / w], plant);
        most = Math.max(most, 1 / Math.hypot(1 + re, im));
    }
    return most;
}

for (const [name, s, wanted] of gains) {
    const found = simcGains({ DAMPING: 0.3, ...s, PLANT: PLANT[s.PLANT] });
    checkNone(`first gains, ${name}`, Object.entries(wanted).filter(([key, value]) => !near(found[key], value, 0.0005)).map(([key, value]) => `${key} is ${found[key]} instead of ${value}`));
    const ms = sensitivity(s, found);
    check(`first gains, ${name}: Ms ${ms.toFixed(2)}`, ms > 1.1 && ms < 2, 'outside 1.1 to 2');
}

// A fit's curve goes through the plant that was recorded.
{
    const lines = record(random, recordings.quiet);
    const { read, fit } = finished(recordingOf(written(lines, {}), {}));
    const model = fit.models.find(({ kind }) => kind === fit.chosen);
    const away = Math.max(...lines.map(({ t, y }) => Math.abs(modelAt(model, t - read.stepAt) - y)));
    check(`the fit is ${away.toFixed(3)} away at most`, away < 0.05);
}

await finish();
