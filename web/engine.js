// SPDX-License-Identifier: MIT
// The C of sim/tuner as WebAssembly: a scene in, its series and results out.
import { COUNT, EVENT, LIMIT, METRIC, PARAM, RESULT, RULE, VALUE, WASM, WORD } from './built.js';

let wasm = null;

export async function startEngine() {
    const bytes = Uint8Array.from(atob(WASM), (c) => c.charCodeAt(0));
    wasm = (await WebAssembly.instantiate(bytes, {})).instance.exports;
}

// What the C exports: twin.js has the other half of it.
export function exported() {
    return wasm;
}

// The numbers that the C gets: of the state's parameters and of its events, in
// their order in time.
export function sceneOf(state) {
    const params = Object.keys(PARAM).map((name) => Number(state[name]) || 0);
    const events = new Array(LIMIT.EVENTS * LIMIT.EVENT_SIZE).fill(0);
    const inTime = [...state.events].sort((a, b) => a.at - b.at);
    inTime.slice(0, LIMIT.EVENTS).forEach((event, i) => {
        events.splice(i * LIMIT.EVENT_SIZE, LIMIT.EVENT_SIZE, event.at,
            EVENT[event.what], event.a, event.b ?? 0);
    });
    return { params, events };
}

export function put(scene) {
    const memory = wasm.memory.buffer;
    new Float64Array(memory, wasm.tuner_params(), scene.params.length).set(scene.params);
    new Float64Array(memory, wasm.tuner_events(), scene.events.length).set(scene.events);
}

function results() {
    const size = Object.keys(RESULT).length;
    const all = new Float64Array(wasm.memory.buffer, wasm.tuner_results(), size);
    return Object.fromEntries(Object.entries(RESULT).map(([name, at]) => [name, all[at]]));
}

// Those of these names, or all.
function series(n, names = null) {
    const all = [...Object.entries(COUNT).map(([name, at]) => [name, Int32Array, wasm.tuner_counts(at)]),
        ...Object.entries(VALUE).map(([name, at]) => [`VALUE_${name}`, Float64Array, wasm.tuner_values(at)])];
    return Object.fromEntries(all.filter(([name]) => names === null || names.includes(name))
        .map(([name, Type, at]) => [name, new Type(wasm.memory.buffer, at, n).slice()]));
}

// What the last run is worth, as enum tuner_metric says: { overshoot, .., meanError, .. }; what
// there is none of is null.
function metrics() {
    const all = new Float64Array(wasm.memory.buffer, wasm.tuner_metrics(), Object.keys(METRIC).length);
    return Object.fromEntries(Object.entries(METRIC).map(([name, at]) =>
        [name.toLowerCase().replace(/_(.)/g, (_, letter) => letter.toUpperCase()), all[at] < 0 ? null : all[at]]));
}

// { n, results, series of these names, or all, metrics }; n is -1 where the controller refuses a value.
export function run(state, names = null) {
    put(sceneOf(state));
    const n = wasm.tuner_run();
    return { n, results: results(), series: series(Math.max(n, 0), names), metrics: n < 0 ? null : metrics() };
}

// Of the experiment that the C has now, by each rule and each word of robustness, and
// by the state's own number: { rule, robustness, has: whether there are gains, results }.
function rules(state) {
    const numbers = [...new Set([...Object.values(WORD), state.ROBUSTNESS])].sort((a, b) => a - b);
    return Object.entries(RULE).flatMap(([rule, at]) => numbers.map((robustness) => {
        put(sceneOf({ ...state, ROBUSTNESS: robustness }));
        const has = wasm.tuner_rule(at) === 1;
        return { rule, robustness, has, results: results() };
    }));
}

function record() {
    return new Uint8Array(wasm.memory.buffer, wasm.tuner_record(), LIMIT.RECORD_SIZE);
}

// The same of the autotuner, with `rules`, and its `record`, or null.
export function experiment(state) {
    put(sceneOf(state));
    const n = wasm.tuner_experiment();
    const found = { n, results: results(), series: series(Math.max(n, 0)), rules: rules(state) };
    return { ...found, record: wasm.tuner_pack() === 1 ? record().slice() : null };
}

// What an experiment came to whose record this is: { results, rules }, or null where
// the record is refused.
export function recorded(state, bytes) {
    record().set(bytes);
    return wasm.tuner_unpack() === 1 ? { results: results(), rules: rules(state) } : null;
}

// The table that follows the values of a function at first, first + 1, .. best, with so
// many points at most: { points: pairs of x and y, error }, or null where it is refused.
export function fitTable(values, first, most) {
    new Float64Array(wasm.memory.buffer, wasm.tuner_fit_values(), values.length).set(values);
    const count = wasm.tuner_fit(first, first + values.length - 1, most);
    const found = new Int16Array(wasm.memory.buffer, wasm.tuner_fit_points(), 2 * count);
    const points = Array.from({ length: count }, (_, i) => [found[2 * i], found[2 * i + 1]]);
    return count > 0 ? { points, error: wasm.tuner_fit_error() } : null;
}
