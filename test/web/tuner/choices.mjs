// SPDX-License-Identifier: MIT
// What the page chooses, against what Python's package does: the guard of a model and
// the points of a sensor's table; and what it prints of them, in C.
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { check, checkNone, finish, open, random, WORK } from './harness.mjs';

const COMPILERS = [['gcc', '-std=c99', '-x', 'c'], ['g++', '-std=c++98', '-x', 'c++'],
    ['avr-g++', '-mmcu=atmega328p', '-Os', '-c', '-x', 'c++']];
const INTEGRATING = 2 ** 32 - 1;
const GUARD_NUMBERS = ['output_min', 'output_max', 'measurement_min', 'measurement_max', 'reach_min', 'reach_max', 'band', 'patience', 'reverse', 'noisy'];

function python(asked) {
    const ran = spawnSync('build/python/venv/bin/python', ['-B', 'python/test/choices.py'],
        { input: JSON.stringify(asked), encoding: 'utf8', maxBuffer: 2 ** 28 });
    if (ran.status !== 0) {
        throw new Error(`python/test/choices.py: ${ran.stderr}`);
    }
    return JSON.parse(ran.stdout);
}

// What the program in C says; the AVR's is only compiled.
function compiled(name, text, body) {
    writeFileSync(`${WORK}/${name}.txt`, `#include <stdio.h>\n${text}\nint main(void) {\n${body}\nreturn 0; }\n`);
    return COMPILERS.map(([compiler, ...options]) => {
        const library = options.includes('-c') ? [] : ['-DFIXPID_NO_ASSEMBLY', '-Isrc', `${WORK}/fixpid_table.o`, `${WORK}/fixpid_guard.o`];
        const ran = spawnSync(compiler, ['-Wall', '-Wextra', '-Werror', '-Iinclude', ...options, `${WORK}/${name}.txt`,
            ...(library.length > 0 ? ['-x', 'none', ...library] : []), '-o', `${WORK}/${name}`], { encoding: 'utf8' });
        if (ran.status !== 0) {
            return { compiler, why: ran.stderr };
        }
        return library.length === 0 ? { compiler } : { compiler, said: spawnSync(`${WORK}/${name}`, { encoding: 'utf8' }).stdout };
    });
}

for (const noun of ['table', 'guard']) {
    spawnSync('gcc', ['-std=c99', '-Iinclude', '-c', `src/${noun}/fixpid_${noun}.c`, '-o', `${WORK}/fixpid_${noun}.o`], { stdio: 'inherit' });
}

const page = await open('p=flow');

// --- Guards -------------------------------------------------------------------
const draw = random(20261124);
const whole = (least, spread) => Math.round(least * Math.exp(draw() * Math.log(spread)));
// The specification's plant, and others: integrating, quiet, noisy, quick, too slow.
const guards = [{ model: { gain_q8: 703, dead_q4: 960, slope_q24: 38379, noise_q4: 8 }, output_min: 0, output_max: 255 },
    { model: { gain_q8: 703, dead_q4: 960, slope_q24: 0, noise_q4: 8 }, output_min: 0, output_max: 255 },
    { model: { gain_q8: 703, dead_q4: 960, slope_q24: 10, noise_q4: 8 }, output_min: 0, output_max: 255 }];
for (let i = 0; i < 400; i++) {
    guards.push({ model: { gain_q8: i % 3 === 0 ? INTEGRATING : whole(20, 500), dead_q4: whole(16, 500), slope_q24: whole(1000, 20000),
        noise_q4: Math.floor(draw() * 50) }, output_min: -Math.floor(draw() * 500), output_max: whole(10, 1000) });
}

// --- Tables -------------------------------------------------------------------
const NTC = { kind: 'ntc', r25: 10, beta: 3950, series: 10, supply: true, bits: 10, low: 0, high: 150, scale: 100, points: 16 };
const K = { kind: 'k', microvolts: 2, low: 0, high: 1372, scale: 10, points: 16 };
const sensors = [NTC, { ...NTC, points: 24 }, { ...NTC, bits: 12, scale: 10 }, { ...NTC, supply: false, low: -20, high: 100 },
    { ...NTC, r25: 100, beta: 4190, series: 4.7, high: 250, points: 12 }, K, { ...K, low: -200 }, { ...K, microvolts: 10, points: 8 }];
const MOST = [0.147, 0.063, 0.184, null, null, 0.178, 0.414, null]; // degrees

const theirs = python({ guards,
    tables: sensors.map(({ kind, bits, r25, beta, series, supply, microvolts, low, high, scale, points }) =>
        (kind === 'ntc' ? { kind, bits, r25, beta, series, supply, low, high, scale, points } : { kind, microvolts, low, high, scale, points })) });
const ours = await page.evaluate(({ plants, all }) => {
    const { guardRule, tableOf, tableText } = window.tuner;
    const from = performance.now();
    const tables = all.map(tableOf);
    const seconds = (performance.now() - from) / 1000;
    return { guards: plants.map(({ model, output_min: low, output_max: high }) =>
        guardRule({ GAIN: model.gain_q8, DEAD: model.dead_q4, SLOPE: model.slope_q24, NOISE: model.noise_q4 }, low, high)),
    tables, texts: tables.map((table, i) => tableText(table, 'sensor', all[i].scale)), seconds };
}, { plants: guards, all: sensors });

const rule = ({ band, patience, noisy }) => `band ${band}, patience ${patience}, ${noisy}`;
const text = (config) => (config === null ? 'none' : rule(config));
checkNone(`${guards.length} guards are Python’s`, guards.map((_, i) => [text(ours.guards[i]), text(theirs.guards[i])])
    .filter(([a, b]) => a !== b).map(([a, b]) => `${a}, Python: ${b}`));
check('the specified guard', text(ours.guards[0]) === 'band 8, patience 395, false', text(ours.guards[0]));
check('some plants have none', ours.guards.filter((one) => one === null).length > 2);

for (const [i, table] of theirs.tables.entries()) {
    const [mine, { kind, scale }] = [ours.tables[i], sensors[i]];
    const same = JSON.stringify(mine.points) === JSON.stringify(table.points);
    const degrees = mine.error / scale;
    check(`table ${i + 1}, ${kind}: ${mine.points.length} points, ${degrees.toFixed(4)} degrees, ${same ? 'Python’s points' : 'other points'}`,
        Math.abs(mine.error - table.error) < 1e-6 * table.error, `Python has ${table.error / scale}`);
    check(`table ${i + 1} is good enough`, MOST[i] === null || degrees <= MOST[i], `not within ${MOST[i]}`);
    const said = table.points.map(([x, y]) => `${x} ${y}`).join('\n');
    checkNone(`table ${i + 1} in C`, compiled('table', ours.texts[i],
        `for (int i = 0; i < sensor.count; i++) { printf("%d %d\\n", sensor.points[i].x, sensor.points[i].y); }\n(void)fixpid_table_at(&sensor, 0);`)
        .flatMap(({ compiler, why, said: found }) => (why || (same && found !== undefined && found.trim() !== said) ? [`${compiler}: ${why ?? found}`] : [])));
    checkNone(`table ${i + 1} has short lines`, ours.texts[i].split('\n').filter((line) => line.length > 52));
}
check(`${sensors.length} tables take ${ours.seconds.toFixed(1)} s`, ours.seconds < 15);

// --- The page’s own loops -------------------------------------------------------
for (const preset of ['oven', 'flow', 'axis']) {
    const here = await open(`p=${preset}`);
    await here.click('#modes button[value=tune]');
    const printed = await here.locator('#guard pre').textContent();
    const values = GUARD_NUMBERS.map((name) => printed.match(new RegExp(`(\\S+?),? +/\\* ${name} \\*/`))?.[1]);
    check(`${preset}: the guard is beside the gains`, await here.isVisible('#guard') && values.every((one) => one !== undefined), printed);
    checkNone(`${preset}: the library takes it`, compiled('guard', printed,
        `struct fixpid_guard guard;\nprintf("%d", fixpid_guard_init(&guard, &guard_config));`)
        .flatMap(({ compiler, why, said }) => (why || (said !== undefined && said !== '1') ? [`${compiler}: ${why ?? said}`] : [])));
    const expected = await here.evaluate(() => {
        const { currentState, experiment } = window.tuner;
        const s = currentState();
        const { results: r } = experiment(s);
        return { model: { gain_q8: r.GAIN, dead_q4: r.DEAD, slope_q24: r.SLOPE, noise_q4: r.NOISE }, output_min: s.OUTPUT_MIN, output_max: s.OUTPUT_MAX };
    });
    const [wanted] = python({ guards: [expected], tables: [] }).guards;
    check(`${preset}: it is Python’s`, `${values[6]} ${values[7]} ${values[9]}` === `${wanted.band} ${wanted.patience} ${wanted.noisy}`, `${values} / ${rule(wanted)}`);
    checkNone(`${preset}: no error`, here.noted.errors);
    await here.close();
}

// --- By a person ------------------------------------------------------------------
await page.click('#choose');
const found = await page.locator('#table-found').textContent();
check('the worst error is stated', /^Worst error 0\.146 °C, over every count, with 16 points\.$/.test(found), found);
check('the table is printed', (await page.locator('#table').textContent()).includes('    ntc_points[] = {'));
await page.fill('#s-points', '8');
check('another number drops it', !(await page.isVisible('#table')) && (await page.locator('#table-found').textContent()) === '');
for (const [id, value] of [['#s-points', '1'], ['#s-points', ''], ['#s-bits', '40'], ['#s-low', '200']]) {
    const before = await page.inputValue(id);
    await page.fill(id, value);
    await page.click('#choose');
    check(`${id} ${value || 'empty'} is refused with a sentence`, /^A value is missing/.test(await page.locator('#table-found').textContent()) && await page.isDisabled('#copy-table'));
    await page.fill(id, before);
}
await page.selectOption('#s-kind', 'k');
check('a thermocouple has its own fields', await page.isVisible('#s-microvolts') && !(await page.isVisible('#s-beta')));
await page.fill('#s-points', '16');
await page.click('#choose');
check('and its table', /^Worst error 0\.17\d °C/.test(await page.locator('#table-found').textContent()), await page.locator('#table-found').textContent());
checkNone('no error in the page', page.noted.errors);
await finish();
