// SPDX-License-Identifier: MIT
// The header for the firmware: the integers that the page has run, as an
// initialiser that every compiler takes, with their real units beside them.
import { CONTROLLER, FEATURE, LIMIT, OPTION, VERSION } from './built.js';
import { short } from './format.js';

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

// A macro of lines, their backslashes under each other.
function macro(name, lines) {
    const all = [`#define ${name}`, '    {', ...lines.map((line) => `        ${line}`)];
    const width = Math.max(...all.map((line) => line.length)) + 1;
    return [...all.map((line) => `${line.padEnd(width)}\\`), '    }'];
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

function pidLines(s, r) {
    return [
        '// The same, folded in double precision:',
        `// FIXPID_PID_GAINS(${s.KP}, ${s.KI}, ${s.KD}, ${s.RATE}, ${r.FILTER})`,
        ...initialiser('LOOP_GAINS', [
            field(`${r.KP}u`, 'kp_q8', short(r.KP / 256)),
            field(`${r.KI}u`, 'ki_q24', `${short(r.KI * s.RATE / 2 ** 24)} per second`),
            field(`${r.KD}u`, 'kd_q8', `${short(r.KD * 2 ** r.FILTER / 256 / s.RATE)} s`),
            field(`${r.FILTER}u`, 'derivative_filter'),
        ]),
        '',
        '// static const struct fixpid_pid_config config = LOOP_CONFIG;',
        `// It needs -DFIXPID_PID_FEATURES=${hex(featuresOf(s, r))} or more.`,
        ...initialiser('LOOP_CONFIG', [
            field('LOOP_GAINS', 'gains'),
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

function an937Lines(s, r) {
    return [
        '// static const struct fixpid_an937_config config = LOOP_CONFIG;',
        ...initialiser('LOOP_CONFIG', [
            field(`${r.KP}u`, 'kp_q4', short(r.KP / 16)),
            field(`${r.KI}u`, 'ki_q4', `${short(r.KI / 16)} per tick`),
            field(`${r.KD}u`, 'kd_q4', short(r.KD / 16)),
            field(`${s.INTEGRAL_MAX}u`, 'accumulated_error_limit'),
            field(`${r.FILTER}u`, 'derivative_period_ticks'),
        ]),
    ];
}

function an964Lines(s, r) {
    return [
        '// static const struct fixpid_an964_gains gains = LOOP_CONFIG;',
        ...initialiser('LOOP_CONFIG', [
            field(`${r.KP}u`, 'kp', short(r.KP / 1024)),
            field(`${r.KI}u`, 'ki'),
            field(`${r.KD}u`, 'kd'),
        ]),
    ];
}

export const NOUN = { [CONTROLLER.PID]: 'fixpid_pid', [CONTROLLER.AN937]: 'fixpid_an937',
    [CONTROLLER.AN964]: 'fixpid_an964' };

export function headerOf(s, results) {
    const noun = NOUN[s.CONTROLLER];
    const lines = { fixpid_pid: pidLines, fixpid_an937: an937Lines, fixpid_an964: an964Lines }[noun];
    const unit = s.unit.replace(/[^\x20-\x7E]/g, '').replace(/[\\*?]/g, '') || 'units';
    return [
        `// Gains of a loop, by the tuner page of fixpid ${VERSION}`,
        `// ${short(s.RATE)} steps per second; sensor: ${s.SENSOR_BITS} bits, ${short(s.SENSOR_RANGE)} ${unit}`,
        '#ifndef LOOP_GAINS_H',
        '#define LOOP_GAINS_H',
        `#include "${noun}.h"`,
        '',
        ...lines(s, results),
        '',
        '#endif',
        '',
    ].join('\n');
}
