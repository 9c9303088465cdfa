// SPDX-License-Identifier: MIT
// Sensors whose curve a fixpid_table is, and the table in C.
import { fitTable } from './engine.js';

const KELVIN = 273.15;
const WARM = 298.15; // 25 degrees, where an NTC has its resistance

// Type K in mV, NIST Monograph 175: the first above 0, with an exponential.
const K_ABOVE = [-0.176004136860e-1, 0.389212049750e-1, 0.185587700320e-4, -0.994575928740e-7, 0.318409457190e-9,
    -0.560728448890e-12, 0.560750590590e-15, -0.320207200030e-18, 0.971511471520e-22, -0.121047212750e-25];
const K_BELOW = [0, 0.394501280250e-1, 0.236223735980e-4, -0.328589067840e-6, -0.499048287770e-8, -0.675090591730e-10,
    -0.574103274280e-12, -0.310888728940e-14, -0.104516093650e-16, -0.198892668780e-19, -0.163226974860e-22];
const K_LOW = -250; // below, a microvolt is many degrees
const K_HIGH = 1372;

export function typeK(celsius) {
    const sum = (celsius >= 0 ? K_ABOVE : K_BELOW).reduceRight((value, factor) => value * celsius + factor, 0);
    return celsius >= 0 ? sum + 0.1185976 * Math.exp(-0.1183432e-3 * (celsius - 126.9686) ** 2) : sum;
}

function ntcCelsius(count, { bits, r25, beta, series, supply }) {
    const ratio = (count + 0.5) / 2 ** bits;
    const resistance = series * (supply ? ratio / (1 - ratio) : (1 - ratio) / ratio);
    return 1 / (1 / WARM + Math.log(resistance / r25) / beta) - KELVIN;
}

// { first, values in degrees } at all counts of the range, or null.
function ntc(sensor) {
    const all = Array.from({ length: 2 ** sensor.bits }, (_, count) => ntcCelsius(count, sensor));
    const inside = all.map((celsius) => celsius >= sensor.low && celsius <= sensor.high);
    const [first, last] = [inside.indexOf(true), inside.lastIndexOf(true)];
    return last > first ? { first, values: all.slice(first, last + 1) } : null;
}

// By Newton from one count to the next.
function thermocouple({ low, high, microvolts }) {
    const scale = 1000 / microvolts;
    const [first, last] = [Math.ceil(typeK(low) * scale), Math.floor(typeK(high) * scale)];
    if (last <= first || first < -32768 || last > 32767) {
        return null;
    }
    let celsius = low;
    const values = Array.from({ length: last - first + 1 }, (_, i) => {
        for (let step = 1; Math.abs(step) > 1e-6;) {
            const slope = (typeK(celsius + 1e-3) - typeK(celsius - 1e-3)) / 2e-3;
            step = ((first + i) / scale - typeK(celsius)) / slope;
            celsius += step;
        }
        return celsius;
    });
    return { first, values };
}

function legal(s) {
    const good = (value, least, most) => Number.isFinite(value) && value >= least && value <= most;
    const own = s.kind === 'ntc' ? good(s.bits, 6, 15) && Number.isInteger(s.bits) && good(s.r25, 1e-3, 1e6) && good(s.beta, 100, 1e5) &&
        good(s.series, 1e-3, 1e6) && good(s.low, -100, 500) && good(s.high, -100, 500)
        : good(s.microvolts, 0.5, 1000) && good(s.low, K_LOW, K_HIGH) && good(s.high, K_LOW, K_HIGH);
    return own && s.low < s.high && Number.isInteger(s.points) && good(s.points, 2, 255);
}

// { points, error in counts } of a sensor: { kind: 'ntc' or 'k', low, high, scale: counts a
// degree, points at most, and what its kind needs }; { refused: a sentence } otherwise.
export function tableOf(s) {
    if (!legal(s)) {
        return { refused: 'A value is missing or out of range: 2 to 255 points, 6 to 15 bits, from below to.' };
    }
    const curve = s.kind === 'ntc' ? ntc(s) : thermocouple(s);
    if (curve === null) {
        return { refused: 'The temperature range covers fewer than two counts of 16 bits.' };
    }
    return fitTable(curve.values.map((celsius) => celsius * s.scale), curve.first, s.points) ??
        { refused: 'These temperatures do not fit 16 bits: use coarser steps.' };
}

export function tableText({ points, error }, name, scale) {
    const lines = [''];
    for (const [x, y] of points) {
        const next = `{${x}, ${y}}, `;
        if (lines.at(-1).length + next.length > 46) {
            lines.push('');
        }
        lines[lines.length - 1] += next;
    }
    return ['#include "fixpid_table.h"', '',
        `// ${points.length} points for ${points[0][0]} to ${points.at(-1)[0]}, in ${1 / scale} degrees,`,
        `// within ${Number((error / scale).toPrecision(3))} degrees. On an AVR write`,
        `// PROGMEM after ${name}_points[] and call`, '// fixpid_table_at_P.',
        'static const struct fixpid_table_point', `    ${name}_points[] = {`,
        ...lines.map((line) => `    ${line.trimEnd()}`), '};',
        `static const struct fixpid_table ${name} =`, `    FIXPID_TABLE(${name}_points);`, ''].join('\n');
}
