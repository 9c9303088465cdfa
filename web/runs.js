// SPDX-License-Identifier: MIT
// The figures that matter, and the runs that are kept to compare: each as its link has
// it, so that the page's link has them, too.
import { PLANT } from './built.js';
import { make, setText, table } from './dom.js';
import { run } from './engine.js';
import { digits, percent, time } from './format.js';
import { helpFor } from './help.js';
import { marginsOf } from './margins.js';
import { KEPT_MOST, fragmentOf, ofLink } from './state.js';

const LETTERS = 'ABCD';
const computed = new Map(); // runs, by their links

// Of a kept run: { s, figures, value, output, seconds }, or null where it is refused.
export function runOf(fragment) {
    if (!computed.has(fragment)) {
        const s = ofLink(fragment);
        const found = run(s);
        computed.set(fragment, found.n < 0 ? null : { s, figures: valuesOf(s, found.metrics, marginsOf(s, found.results)),
            seconds: 1 / s.RATE, value: found.series.VALUE_TRUE, output: Float64Array.from(found.series.OUTPUT) });
    }
    return computed.get(fragment);
}

function valuesOf(s, found, margins) {
    return { overshoot: found.overshoot, settled: found.settled, load: found.load, iae: found.iae, travel: found.travel,
        ms: margins.stable ? margins.ms : null, phase: margins.stable ? margins.phaseMargin : null };
}

const LOAD = (s) => (value) => (value === null ? 'none' : `${digits(value)} ${s.unit}`);

// [key, name, text of a value]; of a pendulum its base's way is what matters.
function figureNamesOf(s) {
    const step = s.PLANT === PLANT.PENDULUM
        ? [['travel', 'Base’s way', (value) => `${digits(value)} m`], ['load', 'Shove', LOAD(s)]]
        : [['overshoot', 'Overshoot', percent], ['settled', 'Settled', (value) => (value === null ? 'not yet' : time(value))], ['load', 'Load', LOAD(s)]];
    return [...step, ['ms', 'Ms', (value) => (value === null ? 'unstable' : value.toFixed(2))],
        ['phase', 'Phase margin', (value) => (value === null ? '–' : `${value.toFixed(0)}°`)]];
}

function changed(text, value, before) {
    if (value === null || before === null || before === undefined) {
        return '';
    }
    const difference = value - before;
    const sign = difference < 0 ? '−' : '+';
    const said = text(Math.abs(difference));
    return said === text(0) ? '±0' : `${sign}${said}`;
}

// [name, value, change to the last kept run of the same unit].
export function keyFigures(s, found, margins) {
    const values = valuesOf(s, found, margins);
    const before = s.kept.map(runOf).filter((one) => one !== null && one.s.unit === s.unit).at(-1)?.figures;
    return figureNamesOf(s).map(([key, name, text]) => [name, text(values[key]), changed(text, values[key], before?.[key])]);
}

// Into each place, the first with help; what is the same there already is not touched.
export function fillKey(places, figures) {
    const wanted = figures.map(([name]) => name).join();
    for (const place of places) {
        if (place.dataset.names !== wanted) {
            place.dataset.names = wanted;
            const help = place === places[0] ? helpFor : () => '';
            place.replaceChildren(...figures.map(([name]) => make('div', {}, make('dt', { textContent: name }), make('dd', {}, '', make('small', { title: 'Change to the last kept run' })), help(name))));
        }
        figures.forEach(([, value, change], i) => {
            const [shown, small] = place.children[i].querySelector('dd').childNodes;
            setText(shown, value);
            setText(small, change && ` ${change}`);
        });
    }
}

// What a kept run is drawn with, of those on the same plant's axes.
export function keptSeries(s, name) {
    return s.kept.map((fragment, i) => ({ letter: LETTERS[i], one: runOf(fragment), i }))
        .filter(({ one }) => one !== null && one.s.unit === s.unit && one.s.PLANT === s.PLANT)
        .map(({ letter, one, i }) => ({ name: `kept ${letter}`, color: 'kept', dash: [[], [8, 3], [3, 3], [8, 3, 2, 3]][i],
            data: one[name], seconds: one.seconds, held: name === 'output' }));
}

// All figures of the kept runs, and of the one that is shown.
export function fillRuns(place, s, found, margins, { onUse, onDrop }) {
    place.hidden = s.kept.length === 0;
    if (place.hidden) {
        place.replaceChildren();
        return;
    }
    const cells = (own, { overshoot, settled, load, iae, ms, phase }) => [own.name, digits(own.KP), digits(own.KI), digits(own.KD),
        percent(overshoot), settled === null ? 'not yet' : time(settled), LOAD(own)(load), ms === null ? 'unstable' : ms.toFixed(2),
        phase === null ? '–' : `${phase.toFixed(0)}°`, `${digits(iae)} ${own.unit} s`];
    const button = (word, letter, act) => {
        const made = make('button', { type: 'button', textContent: word, 'aria-label': `${word} ${letter}` });
        made.addEventListener('click', act);
        return made;
    };
    const kept = s.kept.map((fragment, i) => {
        const one = runOf(fragment);
        const letter = LETTERS[i];
        const buttons = make('span', {}, button('Use', letter, () => onUse(fragment)), ' ', button('Drop', letter, () => onDrop(i)));
        return { cells: one === null ? [letter, buttons, 'refused', ...new Array(9).fill('–')] : [letter, buttons, ...cells(one.s, one.figures)] };
    });
    place.replaceChildren(table('Kept runs', ['Run', 'Take it', 'Plant', 'kp', 'ki', 'kd', 'Overshoot', 'Settled', 'Load', 'Ms', 'Phase', 'IAE'],
        [...kept, { cells: ['Now', '', ...cells(s, valuesOf(s, found, margins))], chosen: true }]));
}

// The kept runs with this one, the oldest left out where there are too many.
export function keptWith(s) {
    const own = fragmentOf({ ...s, kept: [] });
    return [...s.kept.filter((one) => one !== own), own].slice(-KEPT_MOST);
}
