// SPDX-License-Identifier: MIT
// What an experiment of the autotuner says, in words.
import { CAUSE, PLANT, STATUS, WORD } from './built.js';
import { digits, percent, time, whole } from './format.js';

const STATUSES = {
    REFUSED: 'It refuses these limits.',
    RUNNING: 'It needs more steps than the page has: sample more slowly.',
    NO_OSCILLATION: 'No oscillation: the setpoint is out of the output’s reach, or the plant slower than the timeout.',
    SATURATED: 'The measurement reached the end of its range: a setpoint further inside, a larger range, or a narrower range of the output.',
    IRREGULAR: 'The cycles were not alike, or the output that holds this setpoint is next to an end of its range: wait for a steady load, or take another setpoint.',
    TOO_FAST: 'The period is below 10 steps: sample faster, or measure with less noise.',
    TOO_SMALL: 'The swing is not far above the noise: less noise, or a larger range of the output.',
    TOO_SLOW: 'The cycles took too many steps: sample more slowly.',
};

const CAUSES = {
    NOT_DONE: 'the experiment has not measured.',
    NOT_LEGAL: 'the robustness is outside 8 to 64.',
    SHAPE: 'the wave is neither a lag’s nor an integrator’s. Try another swing, a faster rate or less load; else set the gains by hand.',
    TWO_PROCESSES: 'the ways up and down tell of two processes. Wait for a steady load; a heater that cools slowly is two processes, so set its gains by hand.',
    RUNS_AWAY: 'more measurement was held with less output. If the load has moved, try once more; else the process is unstable, so set its gains by hand.',
    GAIN_TOO_LARGE: 'a gain is above its range. Take a finer measurement, or a smaller range of the output.',
    GAIN_TOO_SMALL: 'ki is below its range. Take a slower rate, or a coarser measurement.',
};

const PHASES = ['it measures the noise', 'it finds the setpoint', 'it swings about the setpoint', 'it swings with more output up',
    'it swings with more output down', 'it swings as at first', 'it is over'];
const LASTING = 3; // the first phase that says how long it may still take
const OVER = 6;

function nameIn(list, value) {
    return Object.keys(list).find((name) => list[name] === value);
}

// `PI, safe 16`; a robustness that is no word stands alone.
export function ruleName({ rule, robustness }) {
    const word = nameIn(WORD, robustness);
    return `${rule}, ${word === undefined ? '' : `${word.toLowerCase()} `}${robustness}`;
}

// A sentence for each reason, with the rules that it keeps from gains.
export function causesText(rules) {
    const causes = new Map();
    for (const one of rules.filter(({ has }) => !has)) {
        causes.set(one.results.REASON, [...causes.get(one.results.REASON) ?? [], ruleName(one)]);
    }
    return [...causes].map(([cause, names]) => {
        const of = names.length === rules.length ? '' : ` by ${names.join('; ')}`;
        return ` No gains${of}: ${CAUSES[nameIn(CAUSE, cause)]}`;
    }).join('');
}

export function isMeasured(results) {
    return results.STATUS === STATUS.DONE;
}

function processText(rate, { GAIN, LAG, DEAD, SLOPE, HOLDING, HYSTERESIS, NOISE }) {
    const process = GAIN === 2 ** 32 - 1
        ? `it integrates, ${digits(SLOPE / 2 ** 24 * rate)} counts per second for each of the output`
        : `gain ${digits(GAIN / 256)}, lag ${time(LAG / 16 / rate)}`;
    return `${process}, delay ${time(DEAD / 16 / rate)}; output ${whole(HOLDING)} holds the setpoint; ` +
        `noise ${digits(NOISE / 16, 2)} counts, hysteresis ${HYSTERESIS}.`;
}

// What came of it; `lasted` is the beginning of the sentence where it has measured.
export function experimentText(rate, lasted, { results, rules }) {
    if (!isMeasured(results)) {
        const said = STATUSES[nameIn(STATUS, results.STATUS)];
        return results.STATUS === STATUS.RUNNING ? `${said} It came to ${results.DONE} of ${results.EXPECTED} cycles.` : said;
    }
    const process = results.HAS_MODEL === 1 ? `: ${processText(rate, results)}` : '.';
    return `${lasted}${process}${causesText(rules)}`;
}

export function ringingText(s) {
    return s.PLANT === PLANT.OSCILLATOR
        ? ' The rules serve plants that ring by themselves, as this one does, less well: look at Ms.' : '';
}

// How far it is at a step; steps are left at most if nothing disturbs.
export function stageText(s, { n, results, series }, at) {
    const k = Math.min(n - 1, Math.max(0, at));
    const [phase, done, period] = ['PHASE', 'DONE', 'PERIOD'].map((name) => series[name][k]);
    const text = `At ${time(k / s.RATE)} ${PHASES[phase]}`;
    if (phase === OVER) {
        return `${text}.`;
    }
    const left = phase >= LASTING ? `; at most ${time((results.EXPECTED - done) * period / s.RATE)} more` : '';
    return `${text}: ${done} of ${results.EXPECTED} cycles, ${percent(done / results.EXPECTED, 0)}${left}.`;
}

// The share of the cycles that are done at each step. What ends without a
// measurement has not done them all.
export function progressOf({ results, series }) {
    const each = 100 / Math.max(1, results.EXPECTED);
    return Float64Array.from(series.DONE, (done, k) =>
        each * (series.PHASE[k] === OVER && !isMeasured(results) ? series.DONE[Math.max(0, k - 1)] : done));
}
