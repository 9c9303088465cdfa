// SPDX-License-Identifier: MIT
// Recordings of plants that are known, written as loggers and people write them: how
// the page's modules read and fit them, without a browser, and how the page takes them,
// in one. recordings.json has them, row by row, with what has to come out.
//
//   node test/web/tuner/recordings.mjs [words of a row's name]
import { readFileSync, writeFileSync } from 'node:fs';
import { check, checkNone, finish, open, random, WORK } from './harness.mjs';
import { violations } from '../browser/browser.mjs';
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
    await here.evaluate(() => new Promise((done) => {
        requestAnimationFrame(() => requestAnimationFrame(done));
    }));
    return { ...await here.evaluate(() => window.tuner.currentState()), margins: await here.textContent('#margins') };
}

const closeTo = (value, wanted, part = 0.04) => Math.abs(value / wanted - 1) < part;

// Milliseconds that the page was held at most while `act` was done.
async function held(here, act) {
    await here.evaluate(() => {
        let last = performance.now();
        window.longest = 0;
        window.ticking = setInterval(() => {
            const now = performance.now();
            window.longest = Math.max(window.longest, now - last);
            last = now;
        }, 5);
    });
    await act();
    return here.evaluate(() => {
        clearInterval(window.ticking);
        return window.longest;
    });
}

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

    for (const [title, reason] of [['pure noise', 'There is no step here'], ['a ramp that ends', 'a ramp that ends'], ['not settled', 'It has not settled'],
        ['one column', 'Line 1 has one number only'], ['words', 'No line has a number']]) {
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
        const longest = await held(here, async () => {
            await here.setInputFiles('#record-file', file);
            await here.waitForFunction(() => document.querySelector('#fit').textContent.startsWith('Gain'));
        });
        check(`120 000 lines in a ${how}: ${await said(here)}`, (await here.getAttribute('#recorder', 'data-done')) === how && /lags 1[34]\d s and 1[12]/.test(await said(here)), await here.getAttribute('#recorder', 'data-done'));
        check(`the page is held for ${longest.toFixed(0)} ms at most`, longest < 1500, 'more than 1500 ms');
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
            if (process.env.PICTURES) {
                await here.locator('#recorder').screenshot({ path: `${process.env.PICTURES}/${title.replace(/\W+/g, '_')}_${colorScheme}.png` });
            }
        }
        await here.close();
    }
}
await finish();
