// SPDX-License-Identifier: MIT
// The load alone: the loop at rest at its setpoint, and what a step of the load does to it.
import { LIMIT, PLANT } from './built.js';
import { run } from './engine.js';
import { kindsOf } from './events.js';
import { digits, time } from './format.js';
import { unitsOf, unitsPerCount } from './units.js';

// The scene's first load and the setpoint that it meets, or what loads are like there.
function loadOfScene(s) {
    const inTime = [...s.events].sort((a, b) => a.at - b.at);
    const load = inTime.find(({ what }) => what === 'LOAD') ?? { at: s.DURATION / 2, what: 'LOAD', a: kindsOf(s).LOAD.start[0] };
    const goal = inTime.filter(({ what, at }) => what === 'SETPOINT' && at <= load.at).at(-1)?.a ?? s.SETPOINT;
    return { load, goal };
}

// { s, found }: the scene and run as they are shown, from shortly before the load. The loop
// has run before, for as long as the whole scene is shown, and without what else happens.
export function loadAlone(s) {
    const { load, goal } = loadOfScene(s);
    const all = LIMIT.STEPS;
    const after = Math.max(4, Math.round(Math.min(0.4 * all, Math.max(s.DURATION - load.at, s.DURATION / 4) * s.RATE)));
    const lead = Math.max(2, Math.round(after / 20));
    const before = Math.max(lead, Math.min(Math.round(s.DURATION * s.RATE), all - after));
    const scene = { ...s, SETPOINT: goal, DURATION: (before + after) / s.RATE, events: [{ ...load, at: before / s.RATE }] };
    const { results, series } = run(scene);
    const cut = Object.fromEntries(Object.entries(series).map(([name, values]) => [name, values.slice(before - lead)]));
    return { s: { ...scene, DURATION: (lead + after) / s.RATE, events: [{ ...load, at: lead / s.RATE }] },
        found: { n: cut.OUTPUT.length, results, series: cut }, lead };
}

function errorsOf({ s, found: { series } }) {
    return series.VALUE_TRUE.map((value, i) => value - unitsOf(s, series.SETPOINT[i]));
}

// { most, at, back (seconds after the load, or null), iae }: `back` is when the error stays
// within a tenth of the largest one, or within the noise.
export function loadFigures(alone) {
    const errors = errorsOf(alone).map(Math.abs).slice(alone.lead);
    const { s } = alone;
    const most = errors.reduce((a, b) => Math.max(a, b), 0);
    const band = Math.max(most / 10, (1 + s.NOISE) * unitsPerCount(s));
    const last = errors.findLastIndex((one) => one > band);
    return { most, at: errors.indexOf(most) / s.RATE, back: last + 1 < errors.length ? (last + 1) / s.RATE : null,
        iae: errors.reduce((sum, one) => sum + one, 0) / s.RATE };
}

// A sentence, if the loop still moves when the load comes.
export function restText(alone) {
    const { s, lead } = alone;
    const early = errorsOf(alone).slice(0, lead).reduce((most, one) => Math.max(most, Math.abs(one)), 0);
    const still = Math.max(loadFigures(alone).most / 10, (2 + s.NOISE) * unitsPerCount(s));
    return s.PLANT === PLANT.PENDULUM || early <= still ? null : 'The loop is not at rest when the load comes: show a longer time, or make it quicker.';
}

// In the place of the figures that matter.
export function loadPairs(alone) {
    const { s, found } = alone;
    const { most, at, back, iae } = loadFigures(alone);
    const moved = found.series.OUTPUT.reduce((sum, one, i, all) => sum + Math.abs(one - all[Math.max(0, i - 1)]), 0);
    return [
        ['Load, at most', `${digits(most)} ${s.unit}`, ''], ['after', time(at), ''],
        ['Back within a tenth of it', back === null ? 'not yet' : time(back), ''],
        ['IAE of the load', `${digits(iae)} ${s.unit} s`, ''],
        ['Output moves', `${digits(moved / found.n)} / step`, ''],
    ];
}
