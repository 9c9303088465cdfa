// SPDX-License-Identifier: MIT
// Recordings of plants that are known, written as loggers and people write them: how
// the page's modules read and fit them, without a browser. recordings.json has
// them, row by row, with what has to come out.
//
//   node test/web/tuner/recordings.mjs [words of a row's name]
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, random, WORK } from './harness.mjs';
import { record, written } from './made.mjs';

const moduleOf = (name) => import(`${process.cwd()}/${WORK}/modules/${name}.js`);
const { readCell } = await moduleOf('cells');
const { understood } = await moduleOf('columns');
const { filterOf, firstGains, modelAt, paceOf, recordingOf } = await moduleOf('models');

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
// The numbers are of other code: the coefficients of the controller that makes the loop
// without its dead time 1/(pace s), or the double pole -1/(2 pace) where the plant
// integrates, in rational arithmetic.

const complex = (re, im) => [re, im];
const product = ([a, b], [c, d]) => complex(a * c - b * d, a * d + b * c);
const quotient = ([a, b], [c, d]) => complex((a * c + b * d) / (c * c + d * d), (b * c - a * d) / (c * c + d * d));
const turned = (w, seconds) => complex(Math.cos(w * seconds), -Math.sin(w * seconds));

// The plant as a quotient of polynomials of s = jw, with half a step of the hold.
function plantAtW({ kind, T1 = 0, T2 = 0, damping = 0, dead }, gain, rate, w) {
    const [a2, a1, a0] = { first: [0, T1, 1], second: [T1 * T2, T1 + T2, 1], ringing: [T1 * T1, 2 * damping * T1, 1], integrating: [T2, 1, 0] }[kind];
    return product(quotient(complex(Math.abs(gain), 0), complex(a0 - a2 * w * w, a1 * w)), turned(w, dead + 0.5 / rate));
}

function sensitivity(model, gain, rate, { KP, KI, KD, FILTER }) {
    let most = 0;
    const tau = FILTER > 0 ? 2 ** FILTER / rate : 0;
    for (let i = 0; i < 4000; i++) {
        const w = 10 ** (-5 + 8 * i / 4000) / (model.dead + 1 / rate) / 10;
        const d = quotient(complex(0, KD * w), complex(1, tau * w));
        const controller = complex(KP + d[0], d[1] - KI / w);
        const [re, im] = product(controller, plantAtW(model, gain, rate, w));
        most = w < Math.PI * rate ? Math.max(most, 1 / Math.hypot(1 + re, im)) : most;
    }
    return most;
}

for (const [name, model, gain, rate, wanted] of gains) {
    const found = firstGains(model, gain, rate);
    checkNone(`first gains, ${name}`, Object.entries(wanted).filter(([key, value]) => !near(found[key], value, 1e-7)).map(([key, value]) => `${key} is ${found[key]} instead of ${value}`));
    const ms = sensitivity(model, gain, rate, { ...found, FILTER: filterOf(found, model, rate) });
    check(`first gains, ${name}: Ms ${ms.toFixed(2)} at a pace of ${paceOf(model, rate).toPrecision(3)} s`, ms > 1.1 && ms < 1.7, 'outside 1.1 to 1.7');
    const quick = sensitivity(model, gain, rate, { ...found, KP: 4 * found.KP, KI: 4 * found.KI, KD: 4 * found.KD, FILTER: filterOf(found, model, rate) });
    check(`first gains, ${name}: four times as much is worse`, quick > ms + 0.2, `Ms ${quick.toFixed(2)}`);
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
