// SPDX-License-Identifier: MIT
// What an experiment of a tuner says, in words.
import { CAUSE, EXPERIMENT, HEAT_UP, PLANT, STATUS, WORD } from './built.js';
import { digits, percent, time, whole } from './format.js';

const SAID = {
    REFUSED: 'It refuses these limits.',
    RUNNING: 'It needs more steps than the page has: sample more slowly.',
};

const OF_RELAY = {
    ...SAID,
    NO_OSCILLATION: 'No oscillation: the setpoint is out of the output’s reach, or the plant slower than the timeout. Begin at the setpoint.',
    SATURATED: 'The measurement reached the end of its range: begin at the setpoint, or take a setpoint further inside or a larger range.',
    IRREGULAR: 'The cycles were not alike, or the output that holds this setpoint is next to an end of its range: wait for a steady load, or take a range of the output about what holds it; a heater: a heat-up.',
    TOO_FAST: 'The period is below 10 steps: sample faster, or measure with less noise.',
    TOO_SMALL: 'The swing is not far above the noise: less noise, or a larger range of the output.',
    TOO_SLOW: 'The cycles took too many steps: sample more slowly.',
};

const OF_HEAT_UP = {
    ...SAID,
    MOVING: 'The measurement was not at rest: wait until it stands or falls.',
    NO_MOVEMENT: 'Nothing moved in time: more output, or less noise.',
    WRONG_WAY: 'The measurement went the other way: change “reverse acting”; if that is right, take the relay.',
    LIMIT: 'What is stored would bring the measurement to the setpoint: begin further away, or take half the output where half of it has half the effect.',
    LEVELS_OFF: 'The measurement came to rest before its slope was clear: take the relay, or a faster rate.',
    TOO_SLOW: 'It took too many steps: sample more slowly.',
};

const CAUSES = {
    NO_REASON: 'a gain is out of its range. Take PI, a finer measurement or another rate.', // of a heat-up
    NOT_DONE: 'the experiment has not measured.',
    NOT_LEGAL: 'the robustness is outside 8 to 64.',
    SHAPE: 'the noise or the hysteresis hides the wave. Take PI, or less noise.',
    TWO_PROCESSES: 'the ways up and down tell of two processes. Take PI, which is for the quicker one.',
    RUNS_AWAY: 'more measurement was held with less output. If noise or a load made it look so, try once more from rest; otherwise the process is unstable, so set its gains by hand.',
    GAIN_TOO_LARGE: 'a gain is above its range. Take a finer measurement, or a smaller range of the output.',
    GAIN_TOO_SMALL: 'ki is below its range. Take a slower rate, or a coarser measurement.',
};

const PHASES = ['it measures the noise', 'it finds the setpoint', 'it swings about the setpoint', 'it swings with more output up',
    'it swings with more output down', 'it swings as at first', 'it is over'];
const HEAT_UP_PHASES = { ...PHASES, 1: 'it heats' };
const LASTING = 3; // the first phase that says how long it may still take
const OVER = 6;

function nameIn(list, value) {
    return Object.keys(list).find((name) => list[name] === value);
}

const isHeatUp = (results) => results.EXPERIMENT === EXPERIMENT.HEAT_UP;
const statusOf = (results) => nameIn(isHeatUp(results) ? HEAT_UP : STATUS, results.STATUS);

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
    return statusOf(results) === 'DONE';
}

function processText(rate, results) {
    const { GAIN, LAG, DEAD, SLOPE, HOLDING, HYSTERESIS, NOISE } = results;
    const slope = `${digits(SLOPE / 2 ** 24 * rate)} counts per second for each of the output`;
    const process = isHeatUp(results) ? `it moves by ${slope}` : GAIN === 2 ** 32 - 1 ? `it integrates, ${slope}`
        : `gain ${digits(GAIN / 256)}, lag ${time(LAG / 16 / rate)}`;
    const relay = isHeatUp(results) ? ['', ''] : [`; output ${whole(HOLDING)} holds the setpoint`, `, hysteresis ${HYSTERESIS}`];
    return `${process}, delay ${time(DEAD / 16 / rate)}${relay[0]}; noise ${digits(NOISE / 16, 2)} counts${relay[1]}.`;
}

const doneText = (results, done) => (isHeatUp(results) ? `${done} %` : `${done} of ${results.EXPECTED} cycles`);

// What came of it; `lasted` is the beginning of the sentence where it has measured.
export function experimentText(rate, lasted, { results, rules }) {
    if (!isMeasured(results)) {
        const said = (isHeatUp(results) ? OF_HEAT_UP : OF_RELAY)[statusOf(results)];
        return statusOf(results) === 'RUNNING' ? `${said} It came to ${doneText(results, results.DONE)}.` : said;
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
    const text = `At ${time(k / s.RATE)} ${(isHeatUp(results) ? HEAT_UP_PHASES : PHASES)[phase]}`;
    if (phase === OVER) {
        return `${text}.`;
    }
    const left = phase >= LASTING ? `; at most ${time((results.EXPECTED - done) * period / s.RATE)} more` : '';
    return `${text}: ${isHeatUp(results) ? '' : `${doneText(results, done)}, `}${percent(done / results.EXPECTED, 0)}${left}.`;
}

// The share that is done at each step. What ends without a
// measurement has not done it all.
export function progressOf({ results, series }) {
    const each = 100 / Math.max(1, results.EXPECTED);
    return Float64Array.from(series.DONE, (done, k) =>
        each * (series.PHASE[k] === OVER && !isMeasured(results) ? series.DONE[Math.max(0, k - 1)] : done));
}
