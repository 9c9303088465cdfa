// SPDX-License-Identifier: MIT
// The header for the firmware: the integers that the page has run, as an
// initialiser that every compiler takes, with their real units beside them.
import { CONTROLLER, FEATURE, LIMIT, OPTION, PLANT, VERSION } from './built.js';
import { digits, short } from './format.js';
import { errorPerCount, marginsOf } from './margins.js';
import { fragmentOf } from './state.js';

// FIXPID_PID_FEATURES of this configuration and of what its scene calls.
export function featuresOf(s, results) {
    const called = new Set(s.events.map((event) => event.what));
    const needs = {
        FILTER: results.FILTER > 0,
        WEIGHT: results.WEIGHT < 256,
        REVERSE: (results.OPTIONS & OPTION.REVERSE) !== 0,
        DERIVATIVE_ON_ERROR: (results.OPTIONS & OPTION.DERIVATIVE_ON_ERROR) !== 0,
        FEEDFORWARD: called.has('FEEDFORWARD'),
        MANUAL: called.has('MANUAL') || called.has('AUTO'),
        COARSE_KI: results.KI > LIMIT.KI_FINE,
    };
    return Object.entries(needs).reduce((sum, [name, yes]) => sum + (yes ? FEATURE[name] : 0), 0);
}

export function hex(value) {
    return `0x${value.toString(16).toUpperCase().padStart(2, '0')}`;
}

// Lines of a macro, their backslashes under each other.
function macroOf(name, lines) {
    const all = [`#define ${name}`, ...lines.map((line) => `    ${line}`)];
    const width = Math.max(...all.slice(0, -1).map((line) => line.length)) + 1;
    return [...all.slice(0, -1).map((line) => `${line.padEnd(width)}\\`), all.at(-1)];
}

function macro(name, lines) {
    return macroOf(name, ['{', ...lines.map((line) => `    ${line}`), '}']);
}

// An integer, what it is called and what it means.
function field(value, name, meaning = '') {
    return [`${value},`, `${name}${meaning && `: ${meaning}`}`];
}

function initialiser(name, fields) {
    const width = Math.max(...fields.map(([value]) => value.length));
    return macro(name, fields.map(([value, text], i) => {
        const last = i === fields.length - 1;
        return `${(last ? value.slice(0, -1) : value).padEnd(width)} /* ${text} */`;
    }));
}

function option(results, name) {
    return (results.OPTIONS & OPTION[name]) !== 0 ? 'true' : 'false';
}

// What a loop's name makes of `LOOP`: two headers in one firmware share no name.
const prefixOf = ({ loop }) => (loop === '' ? 'LOOP' : `LOOP_${loop.toUpperCase()}`);

export const fileOf = (s) => `${prefixOf(s).toLowerCase()}_gains.h`;

function pidLines(s, r, loop) {
    return [
        '// The same, folded in double precision:',
        `// FIXPID_PID_GAINS(${s.KP}, ${s.KI}, ${s.KD}, ${s.RATE}, ${r.FILTER})`,
        ...initialiser(`${loop}_GAINS`, [
            field(`${r.KP}u`, 'kp_q8', short(r.KP / 256)),
            field(`${r.KI}u`, 'ki_q24', `${short(r.KI * s.RATE / 2 ** 24)} per second`),
            field(`${r.KD}u`, 'kd_q8', `${short(r.KD * 2 ** r.FILTER / 256 / s.RATE)} s`),
            field(`${r.FILTER}u`, 'derivative_filter'),
        ]),
        '',
        `// static const struct fixpid_pid_config config = ${loop}_CONFIG;`,
        `// It needs -DFIXPID_PID_FEATURES=${hex(featuresOf(s, r))} or more.`,
        ...initialiser(`${loop}_CONFIG`, [
            field(`${loop}_GAINS`, 'gains'),
            field(s.OUTPUT_MIN, 'output_min'),
            field(s.OUTPUT_MAX, 'output_max'),
            field(s.INTEGRAL_MIN, 'integral_min'),
            field(s.INTEGRAL_MAX, 'integral_max'),
            field(`${r.WEIGHT}u`, 'setpoint_weight_q8'),
            field(option(r, 'REVERSE'), 'reverse'),
            field(option(r, 'DERIVATIVE_ON_ERROR'), 'derivative_on_error'),
            field(option(r, 'PROPORTIONAL_ON_MEASUREMENT'), 'proportional_on_measurement'),
        ]),
    ];
}

// What the loop passes to a note's controller.
function errorText(s) {
    const scale = s.CONTROLLER === CONTROLLER.AN937 ? errorPerCount(s) : 1;
    const error = (s.OPTIONS & OPTION.REVERSE) !== 0 ? 'measurement - setpoint' : 'setpoint - measurement';
    return s.PLANT === PLANT.PENDULUM ? '// Its error is the angle, with the drift offset of examples/pendulum.'
        : `// Its error is ${scale === 1 ? error : `(${error}) * ${scale}`}, in counts.`;
}

function limitLines() {
    const limits = ['SUM', 'TERM', 'OUTPUT'].map((name) => [`FIXPID_AN964_${name}_LIMIT`, LIMIT[`AN964_${name}`]]);
    return [
        '// Its limits are chosen when it is compiled; the page has run with these:',
        ...limits.map(([name, value]) => `// -D${name}=${value}`),
        ...limits.flatMap(([name, value]) => [`#if ${name} != ${value}`, `#error "these gains are for ${name} ${value}"`, '#endif']),
    ];
}

function an937Lines(s, r, loop) {
    return [
        `// static const struct fixpid_an937_config config = ${loop}_CONFIG;`,
        ...initialiser(`${loop}_CONFIG`, [
            field(`${r.KP}u`, 'kp_q4', short(r.KP / 16)),
            field(`${r.KI}u`, 'ki_q4', `${short(r.KI / 16)} per tick`),
            field(`${r.KD}u`, 'kd_q4', short(r.KD / 16)),
            field(`${s.INTEGRAL_MAX}u`, 'accumulated_error_limit'),
            field(`${r.FILTER}u`, 'derivative_period_ticks'),
        ]),
    ];
}

function an964Lines(s, r, loop) {
    return [
        `// static const struct fixpid_an964_gains gains = ${loop}_CONFIG;`,
        ...initialiser(`${loop}_CONFIG`, [
            field(`${r.KP}u`, 'kp', short(r.KP / 1024)),
            field(`${r.KI}u`, 'ki'),
            field(`${r.KD}u`, 'kd'),
        ]),
    ];
}

export const NOUN = { [CONTROLLER.PID]: 'fixpid_pid', [CONTROLLER.AN937]: 'fixpid_an937',
    [CONTROLLER.AN964]: 'fixpid_an964' };

// What a header may say: nothing that ends a comment or is not ASCII.
function plain(text) {
    return text.replace(/[^\x20-\x7E]/g, '').replace(/[\\*?]/g, '');
}

function plantText(s, unit) {
    const second = s.T2 > 0 ? ` and ${short(s.T2)} s` : '';
    const dead = `dead time ${short(s.DEAD)} s`;
    switch (s.PLANT) {
    case PLANT.MOTOR: return `motor of ${short(s.GAIN)} V, inertia ${short(s.T1)}e-6 kg m2, friction ${short(s.T2)} mN m`;
    case PLANT.PENDULUM: return `pendulum of ${short(s.T2)} m on a base of ${short(s.GAIN)} m/s`;
    case PLANT.INTEGRATOR: return `integrator, ${short(s.GAIN)} ${unit}/s at full drive, lag ${short(s.T2)} s, ${dead}`;
    case PLANT.OSCILLATOR: return `${short(s.GAIN)} ${unit} at full drive, oscillates with ${short(1 / s.T1)} rad/s, damping ${short(s.DAMPING)}, ${dead}`;
    default: return `${short(s.GAIN)} ${unit} at full drive, lag ${short(s.T1)} s${second}, ${dead}`;
    }
}

function marginText({ stable, ms, phaseMargin, gainMargin, delayMargin }) {
    const known = [['Ms', ms, ''], ['phase', phaseMargin, ' degrees'], ['gain', gainMargin, ''], ['dead time', delayMargin, ' s']];
    return stable ? known.filter(([, value]) => value !== null).map(([name, value, unit]) => `${name} ${plain(digits(value).replace('−', '-'))}${unit}`).join(', ') : 'unstable';
}

// The counts of a constant in units, and the rate, for the rest of the firmware.
function scaleLines(s, unit, loop) {
    const [low, high] = [s.SENSOR_LOW, s.SENSOR_LOW + s.SENSOR_RANGE].map((value) => `(${value})`);
    return [
        `#define ${loop}_RATE ${s.RATE} // steps per second`,
        `// A constant setpoint of so many ${unit} in counts; beyond the sensor it does not compile.`,
        ...macroOf(`${loop}_COUNTS(x)`, [
            'FIXPID_CAST(int16_t,',
            `    FIXPID_FOLDED((FIXPID_REAL(x) - ${low}) / ${s.SENSOR_RANGE} * ${2 ** s.SENSOR_BITS - 1}) +`,
            `        FIXPID_CHECKED(0, (FIXPID_REAL(x) >= ${low}) &&`,
            `                              (FIXPID_REAL(x) <= ${high})))`,
        ]),
        '',
    ];
}

// FNV-1a of the lines, by which two headers of one name are known to differ.
function digestOf(lines) {
    const hash = [...lines.join('\n')].reduce((sum, c) => Math.imul(sum ^ c.charCodeAt(0), 0x01000193) >>> 0, 0x811C9DC5);
    return `0x${hash.toString(16).toUpperCase().padStart(8, '0')}u`;
}

// Its lines between a guard that two copies of the same header pass, and no others.
function guarded(s, lines) {
    const guard = `${prefixOf(s)}_GAINS_H`;
    const digest = digestOf(lines);
    const differ = s.loop === '' ? 'without a name differ: give each loop a name' : `for the loop ${s.loop} differ: give each loop a name of its own`;
    return [`#ifndef ${guard}`, `#define ${guard} ${digest}`, ...lines, `#elif ${guard} != ${digest}`, `#error "two headers of gains ${differ}"`, '#endif', ''];
}

// With what it is from and for: the plant, the margins and what else is said of them, the
// page's settings, the scale. Python's package writes the same.
export function wholeHeaderOf(s, results, margins = marginsOf(s, results), said = []) {
    const noun = NOUN[s.CONTROLLER];
    const lines = { fixpid_pid: pidLines, fixpid_an937: an937Lines, fixpid_an964: an964Lines }[noun];
    const unit = plain(s.unit) || 'units';
    const loop = prefixOf(s);
    return [
        `// Gains of ${s.loop === '' ? 'a loop' : `the loop "${s.loop}"`}, by the tuner page of fixpid ${VERSION}`,
        `// ${short(s.RATE)} step${s.RATE === 1 ? '' : 's'} per second; sensor: ${s.SENSOR_BITS} bits, ${short(s.SENSOR_RANGE)} ${unit}`,
        `// Plant: ${plantText(s, unit)}`,
        `// Margins: ${marginText(margins)}`,
        ...said.map((text) => `// ${plain(text)}`),
        `// The page has it with #${plain(fragmentOf({ ...s, kept: [] }))}`,
        ...guarded(s, [
            `#include "${noun}.h"`,
            '',
            ...scaleLines(s, unit, loop),
            ...(s.CONTROLLER === CONTROLLER.PID ? [] : [errorText(s)]),
            ...(s.CONTROLLER === CONTROLLER.AN964 ? limitLines() : []),
            ...lines(s, results, loop),
            '',
        ]),
    ].join('\n');
}
