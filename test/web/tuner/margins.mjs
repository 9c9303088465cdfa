// SPDX-License-Identifier: MIT
// A run and its margins: what the C does around the library, done here again; the margins of
// recorded scenes; and Bode's plot. python/test/margins.py holds loops of any kind to scipy.
import { readFileSync } from 'node:fs';
import { check, checkNone, finish, moduleOf } from './harness.mjs';

const { run, startEngine } = await moduleOf('engine');
const { countsGain, marginsOf, msOfEach, scaleSeconds } = await moduleOf('margins');
const { identifySimc } = await moduleOf('identify');
const { bodeOf, bodeText, betweenAngles, offText } = await moduleOf('response');
const { calmGains } = await moduleOf('calm');
const { PRESETS, ofLink, presetState } = await moduleOf('state');
await startEngine();

// --- A run --------------------------------------------------------------------
// From the numbers beside it: the sensor, the error of each note's controller, and the
// pendulum's drift offset.
function runFaults(preset) {
    const state = { ...preset, NOISE: 0 };
    const { n, results, series } = run(state);
    const top = 2 ** state.SENSOR_BITS - 1;
    const counts = (units) => Math.min(top, Math.max(0, Math.floor((units - state.SENSOR_LOW) / state.SENSOR_RANGE * top + 0.5)));
    const faults = [];
    let drift = 0;
    for (let i = 0; i < n; i++) {
        const [r, y, p] = [series.SETPOINT[i], series.MEASUREMENT[i], series.P[i]];
        const wanted = { an937: results.KP * 4 * (r - y), an964: y + Math.trunc(drift / 8) - 512 }[preset.preset] ?? p;
        if (y !== counts(series.VALUE_TRUE[i]) || p !== wanted) {
            faults.push(`step ${i}: ${y} of ${series.VALUE_TRUE[i]}, P ${p}, not ${wanted}`);
        }
        drift = Math.min(55, Math.max(-55, drift + Math.sign(series.OUTPUT[i])));
    }
    return faults;
}

// The twin rounds nothing; where nothing has to be rounded it is the library itself.
function twinDistance(state) {
    const { series } = run(state);
    const counts = (2 ** state.SENSOR_BITS - 1) / state.SENSOR_RANGE;
    return series.VALUE_TRUE.reduce((most, value, i) => Math.max(most, Math.abs(value - series.VALUE_TWIN[i]) * counts), 0);
}

const TWINS = { // counts, and what of the scene is another
    oven: [2], flow: [2], spring: [2], axis: [2], motor: [2], own: [2], an937: [0],
    an964: [3, { NOISE: 0, DURATION: 0.5, KI: 16, events: [] }],
};
for (const preset of PRESETS) {
    checkNone(`${preset.preset}: its counts are those of its values`, runFaults(preset));
    const [most, more] = TWINS[preset.preset];
    const away = twinDistance({ ...preset, ...more });
    check(`${preset.preset}: the twin is ${away.toFixed(3)} counts away`, away <= most, `more than ${most}`);
}

// --- Recorded ---------------------------------------------------------------------
// The scenes of margins.csv: their parameters, their integers, and margins that other code
// computed, empty where there is none.
function rowFaults(row) {
    const state = { ...presetState('flow'), ...row, events: [] };
    const m = marginsOf(state, { KP: row.RESULT_KP, KI: row.RESULT_KI, KD: row.RESULT_KD, FILTER: row.RESULT_FILTER });
    const found = { stable: Number(m.stable), ms: m.ms, phase_degrees: m.phaseMargin, delay_s: m.delayMargin, gain: m.gainMargin,
        lower_gain: m.lowerGainMargin, crossover: m.crossover, turnover: m.turnover, off_ms: m.off.ms, off_stable: Number(m.off.stable),
        dead_steps: m.steps, scale_s: scaleSeconds(state), counts_gain: countsGain(state) };
    const away = (a, b) => (a === null || b === null ? Number(a !== b) : Math.abs(a - b) / Math.max(Math.abs(b), 1e-9));
    return Object.keys(found).filter((name) => !(away(found[name], row[name]) < 1e-9)).map((name) => `${name} ${found[name]}, not ${row[name]}`);
}

const [names, ...lines] = readFileSync('test/support/margins.csv', 'utf8').trim().split('\n').map((line) => line.split(','));
lines.forEach((line, at) => checkNone(`scene ${at + 2} of margins.csv`,
    rowFaults(Object.fromEntries(names.map((name, i) => [name, line[i] === '' ? null : Number(line[i])])))));

// --- A slow plant under a quick controller -------------------------------------------
// Plants of a recording, with SIMC's gains: Ms is nearly the same at any rate, and with 25 times
// the gain no rate makes them stable. A push lasts up to 10 000 000 steps.
const PLANTS = [[0, 1, 140, 0, 0, 9], [1, 1, 140, 20, 0, 9], [2, 0.01, 0, 5, 0, 9], [3, 1, 10, 0, 0.1, 3], [0, 1, 10, 0, 0, 50], [0, -1, 1000, 0, 0, 10]];

function msAtRate(plant, rate, factor) {
    const s = { ...presetState('own'), RATE: rate };
    const perCount = factor * s.SENSOR_RANGE / (2 ** s.SENSOR_BITS - 1) / (100 / s.OUTPUT_MAX);
    const [kp, ki, kd] = identifySimc(plant, 1 / rate, 1);
    return msOfEach(s, { KP: kp * perCount * 256, KI: ki * perCount / rate * 2 ** 24, KD: kd * perCount * rate * 256, FILTER: 0 }, [plant], 100)[0];
}

for (const [kind, gain, lag, lag2, damping, dead] of PLANTS) {
    const plant = { kind, gain, lag, lag2, damping, dead };
    const [slow, ...quick] = [10, 100, 1000, 10000].map((rate) => msAtRate(plant, rate, 1));
    check(`kind ${kind} with ${dead} s of dead time: Ms ${slow.toFixed(3)} at any rate`, slow < 2.2 && quick.every((ms) => Math.abs(ms / slow - 1) < 0.02), `${quick}`);
    check(`kind ${kind} with ${dead} s of dead time: unstable at any rate`, [10, 100, 1000, 10000].every((rate) => msAtRate(plant, rate, 25) === Infinity));
}

// --- Bode's plot -------------------------------------------------------------------------
// It passes 0 dB and -180 degrees where the margins are, and the dead time turns it to the end.
const LAG = { ...presetState('own'), GAIN: 100, T1: 10, T2: 0, SENSOR_BITS: 12, SENSOR_RANGE: 100, OUTPUT_MAX: 1000, RATE: 10 };
const SWINGS = { KP: 0.49, KI: 0.49, KD: 0 }; // so much integral that less gain is worse
for (const [name, dead, more] of [['ten steps of dead time', 1, {}], ['a part of a step', 0.137, {}], ['500 steps', 50, {}], ['much integral', 0.1, SWINGS]]) {
    const s = { ...LAG, DEAD: dead, ...calmGains({ ...LAG, DEAD: dead }, 1), ...more };
    const margins = marginsOf(s, run(s).results);
    const { decibels, degrees } = bodeOf(margins);
    const at = (w) => [decibels, degrees].map((values) => betweenAngles(values, margins.angles, w));
    const [[none, turned], [under, half]] = [margins.crossover, margins.turnover].map(at);
    check(`${name}: the crossover, with ${margins.phaseMargin.toFixed(2)} degrees`, Math.abs(none) < 0.01 && Math.abs(turned + 180 - margins.phaseMargin) < 0.05, `${none} dB, ${turned} degrees`);
    check(`${name}: −180 degrees, with a gain margin of ${margins.gainMargin.toFixed(3)}`, Math.abs(half + 180) < 0.05 && Math.abs(under + 20 * Math.log10(margins.gainMargin)) < 0.01, `${under} dB, ${half} degrees`);
    check(`${name}: it goes down to ${degrees.at(-1).toFixed(0)} degrees`, degrees.every((one, i) => i === 0 || one < degrees[i - 1] + 60) && degrees.at(-1) < -180 * margins.steps);
}

// --- In words --------------------------------------------------------------------------------
for (const [link, off, bode] of [['p=oven', /^With the plant’s gain up to 20 % off, the shaded band, the loop stays stable and Ms is at most 1\.\d\d\.$/,
    /^Bode plot of the loop: its gain is 1 at 0\.\d+ rad\/s, \d\d° from −180°; −180° are at 0\.\d+ rad\/s, \d+\.\d dB below 1$/],
['p=flow&kp=2', /the loop becomes unstable\.$/, /^Bode/], ['p=flow&kp=4', /^$/, /^Bode plot of the loop, which is unstable$/], ['p=flow&kp=0.1&ki=0&kd=0', /./, /its gain is 1 at no frequency/]]) {
    const s = ofLink(link);
    const margins = marginsOf(s, run(s).results);
    check(`in words: ${link}`, off.test(offText(margins)) && bode.test(bodeText(margins, s.RATE)), `${offText(margins)} ${bodeText(margins, s.RATE)}`);
}
await finish();
