// SPDX-License-Identifier: MIT
// What the plots show of a run, by mode: 'run', 'load' or 'tune'.
import { CONTROLLER, PLANT } from './built.js';
import { progressOf } from './experiment.js';
import { keptSeries } from './runs.js';
import { inUnits, unitsPerCount } from './units.js';

// Float64Array.from would ask an iterator for each.
function each(counts, as) {
    const found = new Float64Array(counts.length);
    for (let i = 0; i < counts.length; i++) {
        found[i] = as(counts[i]);
    }
    return found;
}

const TERMS = {
    [CONTROLLER.PID]: () => [256, 65536, 256],
    [CONTROLLER.AN937]: () => [16, 16, 16],
    [CONTROLLER.AN964]: (results) => new Array(3).fill(1024 / Math.max(results.KP, 1)),
};

const ofRun = (s, name, mode) => (mode === 'run' ? keptSeries(s, name) : []);

export function measurementPane(s, { series }, mode) {
    const pendulum = s.PLANT === PLANT.PENDULUM;
    return { title: pendulum ? 'Angle' : 'Measurement', unit: s.unit, leastSpan: 8 * unitsPerCount(s), series: [
        ...(pendulum ? [] : [{ name: 'setpoint', color: 'setpoint', dash: [6, 4], held: true, data: each(series.SETPOINT, inUnits(s)) }]),
        ...ofRun(s, 'value', mode),
        { name: 'measured', color: 'measured', data: each(series.MEASUREMENT, inUnits(s)) },
    ] };
}

export function panesOf(s, found, mode) {
    const { series, results } = found;
    const tuning = mode === 'tune';
    const output = { title: 'Output', unit: 'counts', limited: tuning ? null : series.LIMITED, series: [
        ...ofRun(s, 'output', mode), { name: 'output', color: 'output', held: true, data: series.OUTPUT }] };
    const terms = () => ({ title: 'Terms', unit: 'counts', series: ['P', 'I', 'D'].map((name, i) => {
        const scale = TERMS[s.CONTROLLER](results)[i];
        return { name, color: name.toLowerCase(), width: 1.25, data: each(series[name], (term) => term / scale) };
    }) });
    const progress = () => ({ title: 'Progress', unit: '%', leastSpan: 100, series: [{ name: 'done', color: 'i', held: true, data: progressOf(found) }] });
    return [measurementPane(s, found, mode), output, tuning ? progress() : terms()];
}
