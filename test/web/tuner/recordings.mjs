// SPDX-License-Identifier: MIT
// Recordings of plants that are known, written as loggers and people write them: how
// the page's modules read and fit them, without a browser, and how the page takes them,
// in one. recordings.json has them, row by row, with what has to come out.
//
//   node test/web/tuner/recordings.mjs [words of a row's name]
import { readFileSync, writeFileSync } from 'node:fs';
import { check, checkNone, choose, finish, frame, moduleOf, open, random, violations, WORK } from './harness.mjs';

const { readCell } = await moduleOf('cells');
const { startEngine } = await moduleOf('engine');
const { fitNotes, recordingOf } = await moduleOf('models');
const { simcGains } = await moduleOf('own');
const { FIT_KIND, FIT_REASON, PLANT } = await moduleOf('built');
await startEngine();

const { recordings, rows, clocks } = JSON.parse(readFileSync('test/web/tuner/recordings.json', 'utf8'));
const only = process.argv[2] ?? '';

// --- Recordings of our own making ----------------------------------------------------
// Plants that are known, step by step; what drives them, how a logger writes it down, and what goes
// wrong on the way. The same in each run.

// How the state of a plant with gain 1 moves in `dt` seconds with the drive u; its first number is measured.
const PLANTS = {
    first: ({ lag }) => ([x], u, dt) => [x + dt * (u - x) / lag],
    second: ({ lag, lag2 }) => ([x, z], u, dt) => [x + dt * (z - x) / lag, z + dt * (u - z) / lag2],
    integrating: ({ lag2 }) => ([x, z], u, dt) => [x + dt * z, z + dt * (u - z) / lag2],
    ringing: ({ lag, damping }) => ([x, v], u, dt) => {
        const speed = v + dt * ((u - x) / lag - 2 * damping * v) / lag;
        return [x + dt * speed, speed];
    },
};

// Lines { t, u, y, goal }: `gain` for a drive of 1, which is `level` at first, where the plant is at rest
// but if it begins `cold`, and then as `moves` say: [seconds, level]. Or a PI controller drives it, `loop`,
// or a switch: from line to line, with this chance, or for a part of each `window` of lines.
function record({ plant, gain, dead = 0, start = 20, level = 0, moves = [[0, 0.3]], cold = false, loop = null, switched = null, window = null,
    n = 300, every = 2, uneven = 0.2, noise = 0, grid = 0, parts = 40, ...numbers }) {
    const draw = random(1);
    const normal = () => Math.sqrt(-2 * Math.log(draw())) * Math.cos(2 * Math.PI * draw());
    const next = PLANTS[plant](numbers);
    const before = cold ? 0 : level;
    let [x, t, sum, next0] = [[before, plant === 'second' ? before : 0], 0, 0, 0];
    const driven = [];
    const lines = [];
    for (let i = 0; i < n; i++) {
        const y = start + gain * x[0] + noise * normal();
        const goal = loop?.goals.filter(([from]) => from <= t).at(-1)[1];
        let u = moves.filter(([from]) => from <= t).at(-1)?.[1] ?? level;
        if (loop !== null) {
            sum = Math.min(100, Math.max(0, sum + loop.ki * (goal - y)));
            u = Math.min(1, Math.max(0, (loop.kp * (goal - y) + sum) / 100));
        } else if (switched !== null) {
            u = Number(draw() < switched);
        } else if (window !== null) {
            u = Number(i % window < 2 + Math.floor(i / 60) % 4);
        }
        driven.push({ t, u });
        lines.push({ t, u, y: grid > 0 ? Math.round(y / grid) * grid : y, goal });
        const step = every * (1 + uneven * (2 * draw() - 1));
        for (let k = 0; k < parts; k++, t += step / parts) {
            for (; next0 < driven.length && driven[next0].t <= t - dead + 1e-9; next0++);
            x = next(x, next0 > 0 ? driven[next0 - 1].u : before, step / parts);
        }
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
    s: (t) => (t + 0.03).toFixed(2),
    whole: (t) => String(Math.round(t)),
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
    labels = null, end = '\n', every = {}, add = '', again = 0, words = null } = {}) {
    const mark = (text) => {
        const [whole, part] = text.split('.');
        const grouped = thousands === '' ? whole : whole.replace(/\B(?=(\d{3})+$)/g, thousands);
        return part === undefined ? grouped : `${grouped}${decimal}${part}`;
    };
    const cell = {
        t: ({ t }) => (['clock', 'midnight', 'noon', 'iso', 'isoBlank', 'german'].includes(time) ? TIMES[time](t) : mark(TIMES[time](t))),
        u: ({ u }) => words?.[u] ?? mark((drive * u).toFixed(drive > 1 ? 0 : 2)),
        y: ({ y }) => mark(y.toFixed(2)),
        g: ({ goal = 200 }) => mark(goal.toFixed(1)), // a setpoint
        a: ({ t }) => mark((23 + 0.4 * Math.sin(t / 50)).toFixed(2)), // the air, nothing to do with it
        q: ({ t }) => (t < 700 ? '0' : '30'), // another output
        z: ({ t, y }) => mark((20 + (y - 20) / 3 + 0.02 * Math.sin(t)).toFixed(2)), // another sensor
    };
    const rows = [...lines.slice(0, again), ...lines].map((line, i) => {
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
    if (name.startsWith('file: ')) {
        const lines = readFileSync(`test/support/recordings/${name.slice(6)}`, 'utf8').trim().split('\n');
        return lines.map((line) => line.split(',').slice(0, how.cells).join(',')).join('\n');
    }
    const text = written(record(recordings[name]), how);
    return how.replace ? text.replaceAll(...how.replace) : text;
}

const near = (value, wanted) => {
    const [goal, away] = Array.isArray(wanted) ? wanted : [wanted, 0.03 * Math.abs(wanted)];
    return Math.abs(value - goal) <= away;
};
const KINDS = { first: FIT_KIND.FIRST, second: FIT_KIND.SECOND, integrating: FIT_KIND.INTEGRATING, ringing: FIT_KIND.RINGING };
// Where no column is the drive, and no row asks for that: a step of 30 % at the first line.
const told = (how, want) => ((how.columns ?? 'ty') === 'ty' && want.asks === undefined ? { step: { from: 0, to: 30, at: 0 } } : {});

// What of a row is not as wanted.
function wrongOf(text, choices, want) {
    const { read, fit } = recordingOf(text, choices);
    const at = want.kind === undefined ? fit?.chosen : KINDS[want.kind];
    const { plant = {}, ...model } = fit?.models?.[at] ?? {};
    const refused = read.refused ?? (fit !== null && (fit.models === null || model.reason !== FIT_REASON.USABLE) ? model.sentence ?? fit.sentence : null);
    const { time, drive, goals } = read.roles ?? {};
    const questions = read.questions ?? [];
    const found = { ...plant, refused, gain: plant.gain * (read.full ?? 1), delay: plant.dead + plant.lag2 / 2, ti: 8 * (plant.dead + plant.lag2 / 2),
        roles: [time, drive, read.value].join(' '), goals: goals?.join(), names: read.names?.join('|'), unit: read.unit, full: read.full, span: read.points?.t.at(-1),
        chosen: Object.keys(KINDS).find((kind) => KINDS[kind] === fit?.chosen),
        asks: questions.map(({ key, chosen }) => (chosen === undefined ? key : `${key}:${chosen}`)).join(' '), answers: questions[0]?.answers?.map(({ value }) => value).join(' ') };
    const wrong = [];
    const say = (yes, name) => yes && wrong.push(`${name} is ${JSON.stringify(found[name])} instead of ${JSON.stringify(want[name])}`);
    say(want.refused === undefined ? refused !== null : refused === null || !refused.includes(want.refused), 'refused');
    for (const name of ['chosen', 'roles', 'goals', 'names', 'unit', 'full', 'asks', 'answers']) {
        say(want[name] !== undefined && want[name] !== found[name], name);
    }
    for (const name of ['gain', 'lag', 'lag2', 'dead', 'damping', 'delay', 'ti', 'span']) {
        say(want[name] !== undefined && !near(found[name], want[name]), name);
    }
    const sentence = [...read.notes ?? [], ...fit === null ? [] : fitNotes(fit)].join(' ');
    for (const note of want.notes ?? []) {
        const not = note.startsWith('!');
        if (sentence.includes(not ? note.slice(1) : note) === not) {
            wrong.push(`“${sentence}” ${not ? 'has' : 'has not'} “${note}”`);
        }
    }
    if (want.why !== undefined && !Object.values(read.whys).includes(want.why)) {
        wrong.push(`“${Object.values(read.whys).join('”, “')}” is not “${want.why}”`);
    }
    return wrong;
}

for (const [name, recording, how, choices, want] of rows.filter(([title]) => title.includes(only))) {
    checkNone(name, wrongOf(textOf(recording, how), { ...told(how, want), ...choices }, want));
}
checkNone('a wrong answer is reported', wrongOf(textOf('oven', {}), { step: { from: 0, to: 30, at: 0 } }, { chosen: 'first', gain: 250 }).length === 2 ? [] : ['it is not']);

// --- Cells ------------------------------------------------------------------------

checkNone('clocks and dates', Object.entries(clocks).flatMap(([text, wanted]) => {
    const half = text.replace(/ ([ap])\.?m\.?$/i, '$1m');
    const { kind, value } = readCell(half, '.');
    return (wanted === null ? kind === 'text' : Math.abs(value - wanted) < 1e-6) ? [] : [`“${text}” is ${kind} ${value} instead of ${wanted}`];
}));

// Nothing that is no text of a recording ends in an exception.
checkNone('what makes no sense is refused or asked about, without an exception', ['\u0000', ',,,,\n,,,', '1e999,1e999\n'.repeat(20), '0,0\n'.repeat(20),
    `${'9'.repeat(400)},1\n`.repeat(20), '"'.repeat(99), '1,"2\n'.repeat(20), ';;1;;\n'.repeat(12), 'é\n'.repeat(9), '1 2 3 4 5\n'.repeat(30), `${'1,'.repeat(5000)}2\n`.repeat(10),
    Array.from({ length: 20 }, (_, i) => `${i},1e308`).join('\n'), Array.from({ length: 20 }, (_, i) => `${i},${i % 2 ? '-' : ''}1e308`).join('\n')]
    .flatMap((text) => {
        try {
            const { read, fit } = recordingOf(text, {});
            return read.refused !== undefined || read.questions.length > 0 || fit.reason !== FIT_REASON.USABLE ? [] : [`“${text.slice(0, 20)}” is taken`];
        } catch (error) {
            return [`“${text.slice(0, 20)}”: ${error.stack}`];
        }
    }));

// --- In the browser -----------------------------------------------------------------

const textOfRow = (title) => (title.endsWith('.csv') ? textOf(`file: ${title}`, {}) : textOf(...rows.find(([name]) => name === title).slice(1, 3)));
const said = (here) => here.textContent('#fit');
const fitted = (here) => here.waitForSelector('#recorder[data-done]:not([data-busy])');
const isDisabled = async (here, ids) => (await Promise.all(ids.map((id) => here.isDisabled(id)))).join();

// As a paste does it: the whole text and one event.
async function paste(here, text) {
    await here.evaluate((pasted) => {
        const field = document.querySelector('#recording');
        field.value = pasted;
        field.dispatchEvent(new InputEvent('input', { inputType: 'insertFromPaste', bubbles: true }));
    }, text);
    await fitted(here);
}

async function answer(here, value) {
    await here.click(`#record-asks button[value="${value}"]`);
    await fitted(here);
}

const shown = (here) => here.evaluate(() => ['time', 'seconds', 'drive', 'full', 'value'].map((id) => document.querySelector(`#record-${id}`).value).join());
const LOOKS = ['#use-fit', '#copy', '#save', '#share'];
const closeTo = (value, wanted, part = 0.04) => Math.abs(value / wanted - 1) < part;

if (only === '') {
    const here = await open();
    await paste(here, textOfRow('two_steps.csv'));
    check('a worker reads it, and asks', (await here.getAttribute('#recorder', 'data-done')) === 'worker' && (await here.locator('.ask').count()) === 2, await said(here));
    check('nothing is copied while a question is open', (await isDisabled(here, LOOKS)) === 'true,true,true,true', await isDisabled(here, LOOKS));
    check('what is likely is marked, and nothing else', (await here.locator('.ask .likely').allTextContents()).join() === 's: 1.00 s apart, 12 min 49 s in all');
    await answer(here, 'unit s');
    check('one answer is not enough', (await isDisabled(here, LOOKS)) === 'true,true,true,true' && (await here.locator('.ask').count()) === 1);
    await answer(here, 'full 100');
    check('all of them are', (await isDisabled(here, LOOKS)) === 'false,false,false,false' && (await here.locator('.ask').count()) === 0);
    check('its plant', /^Gain 60\.0 °C at full drive, lags 1[45]\d s and (19|20)\.\d s, dead time [234]\.\d+ s\./.test(await said(here)), await said(here));
    check('what was taken stands beside its column', (await shown(here)) === '0,s,1,100,2' && (await here.textContent('#record-drive-why')) === 'by its name', await shown(here));
    await here.selectOption('#record-seconds', 'min');
    await fitted(here);
    check('and can be changed', /lags 9\d\d\d s/.test(await said(here)), await said(here));
    await here.selectOption('#record-seconds', 's');
    await here.fill('#record-full', '200');
    await here.press('#record-full', 'Tab');
    await fitted(here);
    check('full drive, too', /^Gain 120 °C/.test(await said(here)), await said(here));
    await here.click('#record-models button:not([aria-pressed=true])');
    check('another usable model can be looked at', /^Gain 120 °C at full drive, lag 1\d\d s/.test(await said(here)), await said(here));

    await paste(here, textOfRow('closed_loop.csv'));
    for (const value of ['unit s', 'full 100']) {
        await answer(here, value);
    }
    check('what was before is asked', (await here.textContent('.ask p')).startsWith('Was the drive off before the first line') && await here.isDisabled('#use-fit'), await said(here));
    await answer(here, 'before 0');
    check('it was off: a closed loop’s plant', /^Gain 200 °C at full drive, lags 1[45]\d s and (19|2[01])/.test(await said(here)) && !(await here.isDisabled('#use-fit')), await said(here));
    await here.click('#record-asks .quiet');
    await fitted(here);
    check('it is asked again', (await here.locator('.ask').count()) === 1);

    await paste(here, textOfRow('hotend.csv'));
    await here.fill('.ask input', '2');
    await here.click('.ask button:last-child');
    await fitted(here);
    await here.fill('[aria-label="The step: to"]', '100');
    await here.click('.ask button:last-child');
    await fitted(here);
    check('single numbers, with a time between lines and a step that was told', /^Gain \d+ °C at full drive/.test(await said(here)) && !(await here.isDisabled('#use-fit')), await said(here));

    for (const [title, reason] of [['6 SP1 without the output', 'log the output, too'], ['words', 'No line has a number']]) {
        await paste(here, textOfRow(title));
        check(`${title}: refused with the reason`, (await said(here)).includes(reason) && await here.isDisabled('#use-fit') && (await here.getAttribute('#fit', 'class')) === 'refused', await said(here));
    }
    await here.click('#record-clear');
    await fitted(here);
    check('nothing says nothing', (await said(here)) === '' && await here.isDisabled('#use-fit') && await here.isHidden('#fit-plot'));

    // Dropped as a file, in German.
    await here.evaluate((text) => {
        const data = new DataTransfer();
        data.items.add(new File([text], 'log.csv', { type: 'text/csv' }));
        document.querySelector('#recorder').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, textOfRow('German, semicolons'));
    await here.waitForFunction(() => document.querySelector('#record-notes').textContent.includes('comma'));
    check('a file is dropped, with decimal commas', (await here.textContent('.ask p')).includes('What was stepped'), await said(here));

    // What comes of a plant that is taken.
    for (const [title, answers, [plant, gain, lag]] of [['11 a heater on and off', [], ['LAGS', 60, 300]], ['closed_loop_SP1.csv', ['unit s', 'full 100'], ['LAGS', 200, 150]], ['hotplate.csv', ['full 5000'], ['LAGS', 179, 14.2]]]) {
        await paste(here, textOfRow(title));
        for (const value of answers) {
            await answer(here, value);
        }
        await here.click('#use-fit');
        await here.waitForFunction(() => /nine of ten/.test(document.querySelector('#verdict').textContent));
        const s = await here.evaluate(() => window.tuner.currentState());
        check(`${title} becomes the plant`, s.PLANT === PLANT[plant] && closeTo(s.GAIN, gain) && closeTo(s.T1, lag), `${s.PLANT} ${s.GAIN} ${s.T1}`);
        const wanted = simcGains(s);
        checkNone(`${title}: the gains are the rule’s`, ['KP', 'KI', 'KD'].filter((key) => !near(s[key], [wanted[key], 1e-3 * wanted[key]])).map((key) => `${key} is ${s[key]} instead of ${wanted[key]}`));
        const [, ms, low, high] = /^Ms (\d\.\d); (\d\.\d) to (\d\.\d) for nine of ten plants that the recording allows\.$/.exec(await here.textContent('#verdict')) ?? [];
        check(`${title}: Ms ${ms}, ${low} to ${high}`, Number(low) <= Number(ms) && Number(ms) <= Number(high) && Number(high) <= 2.2, await here.textContent('#verdict'));
        check(`${title}: the header says it, too`, (await here.textContent('#header')).includes(`// Ms ${ms}; ${low} to ${high} for nine of ten plants that the recording allows\n`));
    }
    await here.evaluate(() => window.tuner.change({ KP: 3 * window.tuner.currentState().KP }));
    await here.waitForFunction(() => /have Ms above 2\.2|unstable/.test(document.querySelector('#verdict').textContent));
    check('gains by hand are judged, too, and the header warns', (await here.textContent('#header')).includes('// Warning: ') && (await here.getAttribute('#verdict', 'class')) === 'risky', await here.textContent('#verdict'));
    checkNone('no error', here.noted.errors);
    checkNone('no request but the file', here.noted.requests.filter((url) => !/^(file:|data:|blob:)/.test(url)));
    await here.close();
}

if (only === '') {
    const file = `${WORK}/long.csv`;
    writeFileSync(file, textOfRow('120 000 lines'));
    for (const how of ['worker', 'page']) {
        const here = await open();
        if (how === 'page') {
            await here.addInitScript(() => delete globalThis.Worker);
            await here.reload();
            await here.waitForSelector('body[data-ready]');
        }
        await here.setInputFiles('#record-file', file);
        await here.waitForFunction(() => document.querySelector('.ask') !== null);
        await here.evaluate(() => {
            const slept = [];
            let last = performance.now();
            window.slept = slept;
            setInterval(() => {
                slept.push(performance.now() - last);
                last = performance.now();
            }, 10);
        });
        await here.fill('[aria-label="The step: to"]', '30');
        await here.click('.ask button:last-child');
        await here.waitForFunction(() => document.querySelector('#fit').textContent.startsWith('Gain') && document.querySelector('.ask') === null);
        const longest = await here.evaluate(() => Math.max(...window.slept));
        check(`120 000 lines by a ${how}, which holds the page for ${longest.toFixed(0)} ms: ${await said(here)}`, (await here.getAttribute('#recorder', 'data-done')) === how && /lags 1[34]\d s and 1[12]/.test(await said(here)) && (how === 'page' || longest < 400));
        check('the field has its first lines', (await here.inputValue('#recording')).endsWith('… long.csv, 120001 lines'), (await here.inputValue('#recording')).slice(-40));
        checkNone('no error', here.noted.errors);
        await here.close();
    }
}

if (only === '') {
    for (const [colorScheme, viewport] of [['light', { width: 1360, height: 1000 }], ['dark', { width: 390, height: 844 }]]) {
        const here = await open('', { colorScheme, viewport });
        for (const title of ['two_steps.csv', 'hotend.csv', '11 a heater on and off', '6 SP1 without the output']) {
            await paste(here, textOfRow(title));
            checkNone(`${title}, ${colorScheme}: axe-core`, await violations(here));
            check(`${title}, ${colorScheme}: no sideways scroll`, (await here.evaluate(() => document.documentElement.scrollWidth)) <= viewport.width);
        }
        await here.close();
    }
}
await finish();
