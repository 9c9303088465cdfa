// SPDX-License-Identifier: MIT
// What follows from a run: the header under four compilers, margins against the
// loop in time, and fits of recordings that are known.
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { check, checkNone, finish, open, random, WORK } from './harness.mjs';

const COMPILERS = [
    ['gcc', '-std=c99', '-x', 'c'], ['clang', '-std=c99', '-x', 'c'],
    ['g++', '-std=c++98', '-x', 'c++'], ['g++', '-std=c++17', '-x', 'c++'],
    ['avr-g++', '-mmcu=atmega328p', '-Os', '-x', 'c++'],
];

function run(command, ...more) {
    const ran = spawnSync(command, more, { encoding: 'utf8' });
    return ran.status === 0 ? ran.stdout : `${command}: ${ran.stderr || ran.error || ran.status}`;
}

// The configuration's bytes as a list of numbers, read back from the object file
// of each compiler: an array of the members.
const MEMBERS = {
    fixpid_pid: ['config.gains.kp_q8', 'config.gains.ki_q24', 'config.gains.kd_q8', 'config.gains.derivative_filter',
        'config.output_min', 'config.output_max', 'config.integral_min', 'config.integral_max',
        'config.setpoint_weight_q8', 'config.reverse', 'config.derivative_on_error',
        'config.proportional_on_measurement'],
    fixpid_an937: ['config.kp_q4', 'config.ki_q4', 'config.kd_q4', 'config.accumulated_error_limit',
        'config.derivative_period_ticks'],
    fixpid_an964: ['config.kp', 'config.ki', 'config.kd'],
};
const TYPES = { fixpid_pid: 'fixpid_pid_config', fixpid_an937: 'fixpid_an937_config', fixpid_an964: 'fixpid_an964_gains' };

function program(noun, wanted, macro, scale) {
    const agree = [...MEMBERS[noun].map((member, i) => `    good &= (${member} == ${wanted[i]});`),
        ...scale.map(([text, value]) => `    good &= (${text} == ${value});`)];
    const gains = macro === null ? []
        : [`static const struct fixpid_pid_gains folded = ${macro};`];
    const same = macro === null ? []
        : ['kp_q8', 'ki_q24', 'kd_q8', 'derivative_filter'].map((name) => `    good &= (folded.${name} == config.gains.${name});`);
    return ['#include "loop_gains.h"', `static const struct ${TYPES[noun]} config = LOOP_CONFIG;`, ...gains,
        'int main(void) {', '    int good = 1;', ...agree, ...same, '    return good ? 0 : 1;', '}', ''].join('\n');
}

// A constant configuration folds: on the AVR the whole program is `return 0`,
// which its code shows, as there is nothing to run it on here.
function returnsZero(object) {
    const code = run('avr-objdump', '-d', object);
    return /<main>:\s+\S+:\s+80 e0\s+ldi\s+r24, 0x00[^\n]*\n\s+\S+:\s+90 e0\s+ldi\s+r25, 0x00[^\n]*\n\s+\S+:\s+08 95\s+ret/.test(code);
}

const folder = `${WORK}/header`;
mkdirSync(folder, { recursive: true });

function headerFaults(name, { header, noun, wanted, scale }) {
    const macro = header.match(/FIXPID_PID_GAINS\([^)]*\)/)?.[0] ?? null;
    writeFileSync(`${folder}/loop_gains.h`, header);
    return COMPILERS.flatMap(([compiler, ...options]) => {
        const avr = compiler === 'avr-g++';
        // Where double has 32 bits the macro may fold to a neighbour.
        writeFileSync(`${folder}/use.txt`, program(noun, wanted, avr ? null : macro, avr ? [] : scale));
        const output = `${folder}/use`;
        const printed = run(compiler, ...options, '-O2', '-Wall', '-Wextra', '-Werror', '-Iinclude', `-I${folder}`,
            ...(avr ? ['-c'] : []), `${folder}/use.txt`, '-o', output);
        if (printed !== '') {
            return [`${name}, ${compiler}: ${printed}`];
        }
        const good = avr ? returnsZero(output) : spawnSync(output).status === 0;
        return good ? [] : [`${name}, ${compiler}: other integers`];
    });
}

const page = await open();

// In the page: the header of a state with what it has to compile to.
function headerOf(state) {
    const { tuner } = window;
    const { n, results: r } = tuner.run(state);
    if (n < 0) {
        return null;
    }
    const noun = ['fixpid_pid', 'fixpid_an937', 'fixpid_an964'][state.CONTROLLER];
    const wanted = {
        fixpid_pid: [r.KP, r.KI, r.KD, r.FILTER, state.OUTPUT_MIN, state.OUTPUT_MAX, state.INTEGRAL_MIN,
            state.INTEGRAL_MAX, r.WEIGHT, r.OPTIONS & 0x80, r.OPTIONS & 0x40, r.OPTIONS & 0x20].map((value, at) => (at < 9 ? value : Number(value !== 0))),
        fixpid_an937: [r.KP, r.KI, r.KD, state.INTEGRAL_MAX, r.FILTER],
        fixpid_an964: [r.KP, r.KI, r.KD],
    }[noun];
    const top = 2 ** state.SENSOR_BITS - 1;
    const scale = [0, 0.123, 0.5, 0.77, 1].map((part) => state.SENSOR_LOW + Number((part * state.SENSOR_RANGE).toPrecision(4)))
        .map((x) => [`LOOP_COUNTS(${x})`, Math.floor((x - state.SENSOR_LOW) / state.SENSOR_RANGE * top + 0.5)]);
    return { header: tuner.headerOf(state, r), noun, wanted, scale: [...scale, ['LOOP_RATE', state.RATE]] };
}

const presets = await page.evaluate(() => window.tuner.PRESETS);
for (const preset of presets) {
    const made = await page.evaluate(headerOf, preset);
    checkNone(`header of ${preset.preset}: ${COMPILERS.length} compilers`, headerFaults(preset.preset, made));
}
const draw = random(7);
const faults = [];
for (let i = 0; i < 4; i++) {
    const state = { ...presets[1], KP: 0.1 + 3 * draw(), KI: 0.1 + draw(), KD: 0.1 + draw(), WEIGHT: 0.1 + 0.9 * draw(), RATE: 7 + i,
        OPTIONS: i % 3 === 0 ? 0x80 : 0, unit: ['°C', 'a*/b\\', '', '??/'][i % 4] };
    faults.push(...headerFaults(`random ${i}`, await page.evaluate(headerOf, state)));
}
checkNone('headers of random settings', faults);

// A setpoint beyond the sensor is no constant of the firmware.
{
    const made = await page.evaluate(headerOf, presets[0]);
    const beyond = [['LOOP_COUNTS(500)', 0], ['LOOP_COUNTS(-1)', 0]].map((one) => headerFaults('beyond', { ...made, scale: [one] }));
    check('LOOP_COUNTS beyond the sensor compiles nowhere', beyond.every((faults) => faults.length === 4 && !faults.some((fault) => fault.includes('other integers'))), `${beyond}`);
}

// Each rule's gains fold to the very integers that the autotuner gave.
for (const preset of presets.filter((one) => one.CONTROLLER === 0 && one.preset !== 'spring')) {
    const found = await page.evaluate((state) => {
        const { tuner } = window;
        const experiment = tuner.experiment(state);
        const differ = experiment.rules.filter((rule) => rule.has).filter(({ results }) => {
            const again = tuner.run({ ...state, ...tuner.gainsOfRule(state, results) }).results;
            return ['KP', 'KI', 'KD', 'FILTER'].some((name) => again[name] !== results[name]);
        });
        return { status: experiment.results.STATUS, has: experiment.rules.filter((rule) => rule.has).length, differ };
    }, preset);
    // A motor without dead time swings too fast for it, and it says so.
    const [status, has] = preset.preset === 'motor' ? [6, 0] : [2, 6];
    check(`autotune of ${preset.preset}: status ${found.status}, ${found.has} of 6 gains`,
        found.status === status && found.has === has, `not status ${status} and ${has}`);
    checkNone(`rules of ${preset.preset} keep their integers`, found.differ.map((rule) => rule.rule));
}

// --- A run --------------------------------------------------------------------
// What the C has done around the library, done here again from the numbers beside it:
// the sensor, the error of each note's controller, and the pendulum's drift offset.
function runFaults(preset) {
    const { tuner } = window;
    const state = { ...preset, NOISE: 0 };
    const { n, results, series } = tuner.run(state);
    const top = 2 ** state.SENSOR_BITS - 1;
    const counts = (units) => Math.min(top, Math.max(0, Math.floor((units - state.SENSOR_LOW) / state.SENSOR_RANGE * top + 0.5)));
    const faults = [];
    let drift = 0;
    for (let i = 0; i < n; i++) {
        const [r, y, p] = [series.SETPOINT[i], series.MEASUREMENT[i], series.P[i]];
        const wanted = { an937: results.KP * 4 * (r - y), an964: y + Math.trunc(drift / 8) - 512 };
        if (y !== counts(series.VALUE_TRUE[i])) {
            faults.push(`step ${i}: ${y} of ${series.VALUE_TRUE[i]}`);
        }
        if (p !== (wanted[preset.preset] ?? p)) {
            faults.push(`step ${i}: P ${p}, not ${wanted[preset.preset]}`);
        }
        drift = Math.min(55, Math.max(-55, drift + Math.sign(series.OUTPUT[i])));
    }
    return faults;
}

// The twin rounds nothing; where nothing has to be rounded it is the library itself.
function twinDistance(state) {
    const { tuner } = window;
    const { n, series } = tuner.run(state);
    const counts = (2 ** state.SENSOR_BITS - 1) / state.SENSOR_RANGE;
    let most = 0;
    for (let i = 0; i < n; i++) {
        most = Math.max(most, Math.abs(series.VALUE_TRUE[i] - series.VALUE_TWIN[i]) * counts);
    }
    return most;
}

const TWINS = { // counts, and what of the scene is another
    oven: [2], flow: [2], spring: [2], axis: [2], motor: [2], own: [2], an937: [0],
    an964: [3, { NOISE: 0, DURATION: 0.5, KI: 16, events: [] }],
};
for (const preset of presets) {
    checkNone(`${preset.preset}: its counts are those of its values`, await page.evaluate(runFaults, preset));
    const [most, more] = TWINS[preset.preset];
    const away = await page.evaluate(twinDistance, { ...preset, ...more });
    check(`${preset.preset}: the twin is ${away.toFixed(3)} counts away`, away <= most, `more than ${most}`);
}

// --- The plant ------------------------------------------------------------------
// The plant behind the margins is the C's: with the outputs of a run it moves as that
// did. (Without friction, and where a sine is its angle.)
function plantDistance(preset) {
    const { tuner } = window;
    const pendulum = preset.preset === 'an964';
    const state = { ...preset, events: [], ...(pendulum ? { START: 1, DURATION: 0.5 } : {}),
        ...(['motor', 'an937'].includes(preset.preset) ? { T2: 0 } : {}) };
    const { n, results, series } = tuner.run(state);
    const plant = tuner.sampledPlant(state, results.DEAD_S);
    const start = state.START * Math.PI / 180;
    let x = pendulum ? [start, 0, 0, start, 0] : plant.phi.map(() => 0);
    const rest = pendulum ? 0 : series.VALUE_TRUE[0];
    const perCount = state.SENSOR_RANGE / (2 ** state.SENSOR_BITS - 1);
    let [away, most] = [0, 0];
    for (let i = 0; i < n; i++) {
        const y = plant.out.reduce((sum, c, k) => sum + c * x[k], 0) * perCount;
        away = Math.max(away, Math.abs(y - (series.VALUE_TRUE[i] - rest)));
        most = Math.max(most, Math.abs(series.VALUE_TRUE[i] - rest));
        const [u, u1] = [series.OUTPUT[i - plant.steps] ?? 0, series.OUTPUT[i - plant.steps - 1] ?? 0];
        x = plant.phi.map((row, k) => row.reduce((sum, p, j) => sum + p * x[j], 0) + plant.now[k] * u + plant.before[k] * u1);
    }
    return away / most;
}

for (const preset of presets) {
    const away = await page.evaluate(plantDistance, preset);
    check(`${preset.preset}: the margins' plant is the simulated one within ${(100 * away).toFixed(3)} %`, away < 0.002);
}

// --- Margins ------------------------------------------------------------------
// The gain margin is where the loop in time stops being stable, and so is the
// dead time that the phase margin stands for; Ms is the largest of the Fourier
// transform of what is left of a push.
function timeSide(state) {
    const { tuner } = window;
    const { results } = tuner.run(state);
    const margins = tuner.marginsOf(state, results);
    const plant = tuner.sampledPlant(state, results.DEAD_S);
    const controller = tuner.controllerOf(state, results);
    const n = tuner.responseSteps(state, results);
    const stable = (factor) => tuner.isStable(plant, controller, factor, n);
    const seen = tuner.linearResponse(plant, controller, 1, n);
    let ms = 0;
    for (let k = 1; k <= 1500; k++) {
        const w = 0.002 * (Math.PI / 0.002) ** (k / 1500);
        let [re, im] = [0, 0];
        for (let i = 0; i < n; i++) {
            re += seen[i] * Math.cos(w * i);
            im -= seen[i] * Math.sin(w * i);
        }
        ms = Math.max(ms, Math.hypot(re, im));
    }
    const { gainMargin, lowerGainMargin, delayMargin } = margins;
    const later = (part) => tuner.isStable(tuner.sampledPlant(state, results.DEAD_S + part * delayMargin), controller, 1, 2 * n);
    return { margins: { ...margins, curve: 0 }, ms, early: later(0.97), late: later(1.03),
        below: gainMargin === null || stable(0.97 * gainMargin), above: gainMargin !== null && stable(1.03 * gainMargin),
        inside: lowerGainMargin === null || stable(1.03 * lowerGainMargin),
        outside: lowerGainMargin !== null && stable(0.97 * lowerGainMargin) };
}

for (const preset of presets) {
    const found = await page.evaluate(timeSide, preset);
    const { margins } = found;
    const periodic = preset.preset === 'an937'; // its derivative has a period: margins are those of the mean
    check(`${preset.preset}: stable`, margins.stable);
    check(`${preset.preset}: Ms ${margins.ms.toFixed(3)}, in time ${found.ms.toFixed(3)}`,
        periodic || Math.abs(found.ms / margins.ms - 1) < 0.02, 'they differ');
    check(`${preset.preset}: gain margin ${margins.gainMargin?.toFixed(2)}`,
        periodic || (found.below && !found.above), 'the loop in time has another one');
    check(`${preset.preset}: dead time margin ${margins.delayMargin.toPrecision(3)} s`,
        periodic || (found.early && !found.late), 'the loop in time has another one');
    const unstableAlone = preset.preset === 'an964';
    check(`${preset.preset}: lower gain margin ${margins.lowerGainMargin?.toFixed(2) ?? 'none'}`,
        found.inside && !found.outside && unstableAlone === (margins.lowerGainMargin !== null),
        'the loop in time has another one');
}
const unstable = await page.evaluate((state) => {
    const { results } = window.tuner.run(state);
    return window.tuner.marginsOf(state, results).stable;
}, { ...presets[1], KP: 6 });
check('a loop with too much gain is unstable', !unstable);

// --- Costs ----------------------------------------------------------------------
// The card's figures are those of the documents: of one noun on each chip, and with
// a feature for each chip that docs/choosing.md has.
function documented(path, name) {
    const [, part] = readFileSync(path, 'utf8').split(new RegExp(`<!-- ${name}:(?:begin|end) -->`));
    return part.trim().split('\n').map((line) => line.split('|').slice(1, -1).map((cell) => cell.trim()));
}

const [titles, , ...steps] = documented('docs/cost.md', 'steps');
const features = documented('docs/choosing.md', 'features');

function costOf(noun, chip) {
    const row = steps.find((one) => one[0] === noun && one[1] === chip && ['object', '-O2'].includes(one[2]));
    return ['bound', 'with init', 'RAM each'].map((title) => Number(row?.[titles.indexOf(title)]));
}

function withFilter(chip) {
    const at = features[0].findIndex((title) => title.startsWith(chip));
    const sum = (column) => Number(features[2][column]) + Number(features[3][column]);
    return at < 0 ? costOf('PID', chip) : [sum(at), sum(at + 1), costOf('PID', chip)[2]];
}

for (const [fragment, rate, wanted] of [['p=an937', 1000, (chip) => costOf('AN937', chip)], ['p=an964', 256, (chip) => costOf('AN964', chip)],
    ['p=flow&filter=0', 20, (chip) => costOf('PID, typical', chip)], ['p=flow&filter=3', 20, withFilter]]) {
    const here = await open(fragment);
    const rows = await here.locator('#chips tbody tr').evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const differ = rows.filter(([chip, ...cells]) => {
        const [most, flash, ram] = wanted(chip.replace(' *', ''));
        return cells.slice(0, 4).map((cell) => Number(cell.replace(/\D/g, ''))).join() !== [most, flash, ram, most * rate].join();
    });
    checkNone(`${fragment}: costs on ${rows.length} chips`, rows.length < 7 ? ['too few'] : differ);
    await here.close();
}

// --- Recordings -----------------------------------------------------------------
const noise = random(11);
for (const [gain, lag, dead, start, size] of [[80, 12, 2, 20, 0], [300, 90, 8, 25, 0.6], [40, 0.5, 0.05, 0, 0.05], [-30, 4, 1, 50, 0.05]]) {
    const lines = ['time;value'];
    for (let i = 0; i <= 200; i++) {
        const t = i / 200 * (dead + 6 * lag);
        const value = start + (t > dead ? gain * (1 - Math.exp(-(t - dead) / lag)) : 0) + size * (noise() - 0.5);
        lines.push(`${t.toFixed(4)}; ${value.toFixed(3)}`);
    }
    const fit = await page.evaluate((text) => {
        const parts = window.tuner.recordingOf(text, {});
        let part = parts.next();
        while (!part.done) {
            part = parts.next();
        }
        return part.value.fit.models.find((one) => one.kind === 'first');
    }, lines.join('\n'));
    const away = Math.max(Math.abs(fit.rise / gain - 1), Math.abs(fit.T1 / lag - 1), Math.abs(fit.dead - dead) / lag);
    check(`a recording of ${gain}, ${lag} s, ${dead} s is fitted within ${(100 * away).toFixed(2)} %`, away < 0.01);
}
checkNone('no error in the page', page.noted.errors);
await finish();
