// SPDX-License-Identifier: MIT
// Recordings of plants that are known, written as loggers and people write them: how
// the page's modules read and fit them, without a browser, and how the page takes them,
// in one. recordings.json has them, row by row, with what has to come out.
//
//   node test/web/tuner/recordings.mjs [words of a row's name]
import { readFileSync, writeFileSync } from 'node:fs';
import { check, checkNone, choose, finish, frame, moduleOf, open, random, violations, WORK } from './harness.mjs';

const { readCell } = await moduleOf('cells');
const { modelAt, recordingOf } = await moduleOf('models');
const { simcGains } = await moduleOf('own');
const { PLANT } = await moduleOf('built');

const { recordings, rows, clocks } = JSON.parse(readFileSync('test/web/tuner/recordings.json', 'utf8'));
const only = process.argv[2] ?? '';
const seconds = () => process.cpuUsage().user / 1e6;

// --- Recordings of our own making ----------------------------------------------------
// Plants that are known, their noise, how a logger writes them down, and what goes wrong on the
// way. The same in each run.

// Responses to a step of 1 at 0, of plants with gain 1: from the poles, each by itself.
const PLANTS = {
    first: ({ lag }) => (t) => 1 - Math.exp(-t / lag),
    second: ({ lag, lag2 }) => (t) => 1 + (lag2 * Math.exp(-t / lag2) - lag * Math.exp(-t / lag)) / (lag - lag2),
    integrating: ({ lag2 = 0 }) => (t) => (lag2 === 0 ? t : t + lag2 * Math.expm1(-t / lag2)),
    ringing: ({ period, damping }) => (t) => {
        const [real, imaginary] = [-damping / period, Math.sqrt(1 - damping ** 2) / period];
        return 1 - Math.exp(real * t) * (Math.cos(imaginary * t) - real / imaginary * Math.sin(imaginary * t));
    },
    ramp: ({ lag }) => (t) => Math.min(1, t / lag),
    none: () => () => 0,
};

// Lines { t, u, y } of a plant: `gain` for a drive of 1, which goes from 0 to `step` after
// `rest` seconds. `load` takes a part of the step away later, `back` all of it; `spikes` moves
// a line now and then.
function record({ plant, gain = 1, step = 0.3, dead = 0, start = 20, rest = 0, n = 300, every = 2, uneven = 0.2, noise = 0, grid = 0,
    seed = 1, load = null, back = null, spikes = null, ...numbers }) {
    const draw = random(seed);
    const normal = () => Math.sqrt(-2 * Math.log(draw())) * Math.cos(2 * Math.PI * draw());
    const shape = PLANTS[plant](numbers);
    const answer = (t) => (t <= dead ? 0 : shape(t - dead));
    const lines = [];
    let t = 0;
    for (let i = 0; i < n; i++) {
        const u = t >= rest && !(back !== null && t >= back) ? step : 0;
        const pushed = answer(t - rest) - (load === null ? 0 : load.part * answer(t - load.at)) - (back === null ? 0 : answer(t - back));
        const y = start + gain * step * pushed + noise * normal() + (spikes !== null && i % spikes.every === 0 ? spikes.size : 0);
        lines.push({ t, u, y: grid > 0 ? Math.round(y / grid) * grid : y });
        t += every * (1 + uneven * (2 * draw() - 1));
    }
    return lines;
}

const pad = (value) => String(value).padStart(2, '0');

// A time of day, from so many seconds after midnight; of 12 hours with am and pm.
function clock(seconds, half) {
    const hours = Math.floor(seconds / 3600) % 24;
    const rest = `${pad(Math.floor(seconds / 60) % 60)}:${(seconds % 60).toFixed(1).padStart(4, '0')}`;
    return half ? `${hours % 12 === 0 ? 12 : hours % 12}:${rest} ${hours < 12 ? 'am' : 'pm'}` : `${pad(hours)}:${rest}`;
}

const TIMES = {
    s: (t) => t.toFixed(2),
    ms: (t) => String(Math.round(1000 * t)),
    min: (t) => (t / 60).toFixed(5),
    epoch: (t) => (1795694400 + t).toFixed(2),
    epochMs: (t) => String(1795694400000 + Math.round(1000 * t)),
    clock: (t) => clock(12 * 3600 + 245 + t, false),
    midnight: (t) => clock(86400 - 120 + t, false),
    noon: (t) => clock(12 * 3600 - 60 + t, true),
    iso: (t) => new Date(1795694400000 + Math.round(1000 * t)).toISOString(),
    isoBlank: (t) => new Date(1795694400000 + Math.round(1000 * t)).toISOString().replace('T', ' ').replace('Z', ''),
    german: (t) => `26.11.2026 ${clock(12 * 3600 + t, false).replace('.', ',')}`,
};

// The text that a logger makes of lines: separator, decimal mark, thousands, quotes, a
// head, which columns in which order, and how the time is written.
function written(lines, { separator = ',', decimal = '.', thousands = '', quotes = false, head = '', columns = 'ty', time = 's', drive = 1,
    labels = null, end = '\n', every = {}, add = '' } = {}) {
    const mark = (text) => {
        const [whole, part] = text.split('.');
        const grouped = thousands === '' ? whole : whole.replace(/\B(?=(\d{3})+$)/g, thousands);
        return part === undefined ? grouped : `${grouped}${decimal}${part}`;
    };
    const cell = {
        t: ({ t }) => (['s', 'ms', 'min', 'epoch', 'epochMs'].includes(time) ? mark(TIMES[time](t)) : TIMES[time](t)),
        u: ({ u }) => mark((drive * u).toFixed(drive > 1 ? 0 : 2)),
        y: ({ y }) => mark(y.toFixed(2)),
        g: () => mark('200.0'), // a setpoint that stands still
        a: ({ t }) => mark((23 + 0.4 * Math.sin(t / 50)).toFixed(2)), // the air, nothing to do with it
    };
    const rows = lines.map((line, i) => {
        const cells = [...columns].map((name, k) => {
            const text = cell[name](line);
            return `${labels ? `${labels[k]}=` : ''}${quotes ? `"${text}"` : text}${name === 'y' ? add : ''}`;
        });
        return every[i] ?? cells.join(separator);
    });
    return `${head}${rows.join(end)}${end}`;
}

// --- Rows -----------------------------------------------------------------------

function textOf(name, how) {
    if (name.startsWith('text: ')) {
        return name.slice(6);
    }
    const text = written(record(recordings[name]), how);
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

for (const [name, recording, how, choices, want] of rows.filter(([title]) => title.includes(only))) {
    checkNone(name, wrongOf(textOf(recording, how), choices, want));
}
checkNone('a wrong answer is reported', wrongOf(textOf('oven', {}), {}, { chosen: 'first', gain: 250 }).length === 2 ? [] : ['it is not']);

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

// A fit's curve goes through the plant that was recorded.
{
    const lines = record(recordings.quiet);
    const { read, fit } = finished(recordingOf(written(lines, {}), {}));
    const model = fit.models.find(({ kind }) => kind === fit.chosen);
    const away = Math.max(...lines.map(({ t, y }) => Math.abs(modelAt(model, t - read.stepAt) - y)));
    check(`the fit is ${away.toFixed(3)} away at most`, away < 0.05);
}

// --- In the browser -----------------------------------------------------------------

const rowOf = (title) => rows.find(([name]) => name === title);
const textOfRow = (title) => textOf(...rowOf(title).slice(1, 3));
const said = (here) => here.textContent('#fit');
const fitted = (here) => here.waitForSelector('#recorder[data-done]:not([data-busy])');

// As a paste does it: the whole text and one event.
async function paste(here, text) {
    await here.evaluate((pasted) => {
        const field = document.querySelector('#recording');
        field.value = pasted;
        field.dispatchEvent(new InputEvent('input', { inputType: 'insertFromPaste', bubbles: true }));
    }, text);
    await fitted(here);
}

async function choose(here, id, value) {
    await (id === 'at' || id === 'step' ? here.fill(`#record-${id}`, value) : here.selectOption(`#record-${id}`, value));
    await fitted(here);
}

// The state after this recording was taken as the plant, and what the page says of its loop.
async function taken(here, title) {
    await paste(here, textOfRow(title));
    await here.click('#use-fit');
    await frame(here);
    return { ...await here.evaluate(() => window.tuner.currentState()), margins: await here.textContent('#margins') };
}

const closeTo = (value, wanted, part = 0.04) => Math.abs(value / wanted - 1) < part;

if (only === '') {
    const here = await open();
    const rest = textOfRow('time, drive, temperature');
    await paste(here, rest);
    check('three columns: fitted by a worker', (await here.getAttribute('#recorder', 'data-done')) === 'worker' && /^Gain 2[34]\d °C at full drive, lags 1[34]\d s and 1\d/.test(await said(here)), await said(here));
    check('the step is the drive’s', (await here.inputValue('#record-step')) === '30', await here.inputValue('#record-step'));
    check('its worth is said', /It fits well: 0\.\d % of the rise is left on average, R² is 0\.999/.test(await said(here)), await said(here));
    const heads = (await here.locator('#record-lines thead th').allTextContents()).join('|');
    check('the first lines are shown as understood', heads === 'Line|Time, s|Drive|Measurement', heads);
    check('the models stand beside one another', (await here.locator('#record-models tbody tr').count()) === 4);
    await here.click('#record-models [aria-label="Show One lag"]');
    check('another model can be looked at', /lag 14\d s, dead time 1\d/.test(await said(here)), await said(here));
    await choose(here, 'drive', '-1');
    check('without the drive the rest is dead time, and it is said', /dead time (6|7)\d.*say when the step was/.test(await said(here)), await said(here));
    await choose(here, 'at', '60,0');
    check('the moment of the step can be typed', /dead time (\d\.|1[01])/.test(await said(here)), await said(here));
    await choose(here, 'at', '');
    const box = await here.locator('#fit-plot').boundingBox();
    const xOf = (t) => box.x + 56 + (box.width - 70) * t / Number(rest.trim().split('\n').at(-1).split(',')[0]);
    await here.mouse.move(xOf(0) + 3, box.y + 60);
    await here.mouse.down();
    await here.mouse.move(xOf(30), box.y + 60);
    await here.mouse.move(xOf(60) + 1, box.y + 60);
    await here.mouse.up();
    await fitted(here);
    check('or dragged', Math.abs(Number(await here.inputValue('#record-at')) - 60) < 6 && /dead time (\d\.|1\d)/.test(await said(here)), `${await here.inputValue('#record-at')}: ${await said(here)}`);
    await choose(here, 'at', '');
    await choose(here, 'seconds', 'ms');
    check('the unit of time can be chosen', /lags 0\.1/.test(await said(here)), await said(here));
    await choose(here, 'seconds', '');
    await choose(here, 'step', '0');
    check('a step of 0 has a reason of its own', (await said(here)).startsWith('How far was the output stepped?') && await here.isDisabled('#use-fit'), await said(here));
    await choose(here, 'step', '30');

    for (const [title, reason] of [['pure noise', 'There is no step here'], ['words', 'No line has a number']]) {
        await paste(here, textOfRow(title));
        check(`${title}: refused with the reason`, (await said(here)).includes(reason) && await here.isDisabled('#use-fit') && (await here.getAttribute('#fit', 'class')) === 'refused', await said(here));
    }
    await paste(here, '');
    check('nothing says nothing', (await said(here)) === '' && await here.isDisabled('#use-fit') && await here.isHidden('#fit-plot'));

    // Dropped as a file, in German.
    await here.evaluate((text) => {
        const data = new DataTransfer();
        data.items.add(new File([text], 'log.csv', { type: 'text/csv' }));
        document.querySelector('#recorder').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, textOfRow('German, semicolons'));
    await here.waitForFunction(() => document.querySelector('#record-notes').textContent.includes('comma'));
    check('a file is dropped, with decimal commas', /^Gain .* lags 1[34]\d s/.test(await said(here)), await said(here));

    const loops = { 'time, drive, temperature': ['LAGS', 240, 140], integrator: ['INTEGRATOR', 2.4], ringing: ['OSCILLATOR', 240, 10], 'one lag': ['LAGS', 80, 100] };
    for (const [title, [plant, gain, lag]] of Object.entries(loops)) {
        const s = await taken(here, title === 'integrator' ? 'an integrator' : title);
        const ms = Number(/Ms(\d+\.\d+)/.exec(s.margins)?.[1]);
        const step = Number(await here.inputValue('#record-step'));
        check(`${title} becomes the plant`, s.PLANT === PLANT[plant] && closeTo(s.GAIN, gain * 30 / step) && (lag === undefined || closeTo(s.T1, lag)), `${s.PLANT} ${s.GAIN} ${s.T1}`);
        check(`${title}: its loop with the first gains`, !s.margins.includes('unstable') && ms > 1 && ms < 2.05, s.margins);
        const wanted = simcGains(s);
        checkNone(`${title}: the gains are the rule’s`, ['KP', 'KI', 'KD'].filter((key) => !near(s[key], wanted[key], 1e-3)).map((key) => `${key} is ${s[key]} instead of ${wanted[key]}`));
    }
    checkNone('no error', here.noted.errors);
    checkNone('no request but the file', here.noted.requests.filter((url) => !/^(file:|data:|blob:)/.test(url)));
    await here.close();
}

if (only === '') {
    const file = `${WORK}/long.csv`;
    writeFileSync(file, textOfRow('120 000 lines'));
    for (const how of ['worker', 'slices']) {
        const here = await open();
        if (how === 'slices') {
            await here.addInitScript(() => delete globalThis.Worker);
            await here.reload();
            await here.waitForSelector('body[data-ready]');
        }
        await here.setInputFiles('#record-file', file);
        await here.waitForFunction(() => document.querySelector('#fit').textContent.startsWith('Gain'));
        check(`120 000 lines in a ${how}: ${await said(here)}`, (await here.getAttribute('#recorder', 'data-done')) === how && /lags 1[34]\d s and 1[12]/.test(await said(here)), await here.getAttribute('#recorder', 'data-done'));
        check('the field has its first lines', (await here.inputValue('#recording')).endsWith('… long.csv, 120001 lines'), (await here.inputValue('#recording')).slice(-40));
        checkNone('no error', here.noted.errors);
        await here.close();
    }
}

if (only === '') {
    for (const [colorScheme, viewport] of [['light', { width: 1360, height: 1000 }], ['dark', { width: 390, height: 844 }]]) {
        const here = await open('', { colorScheme, viewport });
        for (const title of ['time, drive, temperature', 'pure noise']) {
            await paste(here, textOfRow(title));
            await here.locator('#record-preview').evaluate((one) => {
                one.open = true;
            });
            checkNone(`${title}, ${colorScheme}: axe-core`, await violations(here));
            check(`${title}, ${colorScheme}: no sideways scroll`, (await here.evaluate(() => document.documentElement.scrollWidth)) <= viewport.width);
        }
        await here.close();
    }
}
await finish();
