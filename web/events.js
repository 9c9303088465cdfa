// SPDX-License-Identifier: MIT
// What happens in a scene, and when: flags on the time axis, which are dragged or
// moved by the arrow keys, and the same as a list of fields.
import { CONTROLLER, LIMIT, PLANT } from './built.js';
import { make } from './dom.js';
import { createField } from './fields.js';
import { percent, short } from './format.js';

function loadOf(s) {
    if (s.PLANT === PLANT.MOTOR) {
        return { name: 'Load', unit: 'N m', start: 0.08, text: (a) => `load ${short(a)} N m` };
    }
    if (s.PLANT === PLANT.PENDULUM) {
        return { name: 'Shove', unit: 'rad/s²', start: 6, text: (a) => `shove ${short(a)}` };
    }
    return { name: 'Load', unit: 'of full drive', start: -0.1, text: (a) => `load ${percent(a, 0)}` };
}

// The kinds that this scene knows: { name, a and b: units or null, start, text }.
export function kindsOf(s) {
    const load = loadOf(s);
    const kinds = { LOAD: { name: load.name, a: load.unit, start: [load.start], text: load.text } };
    if (s.PLANT !== PLANT.PENDULUM) {
        kinds.SETPOINT = { name: 'Setpoint', a: s.unit, start: [s.SETPOINT], text: (a) => `${short(a)} ${s.unit}` };
    }
    if (s.CONTROLLER === CONTROLLER.PID) {
        const middle = Math.round((s.OUTPUT_MIN + s.OUTPUT_MAX) / 2);
        Object.assign(kinds, {
            MANUAL: { name: 'Manual', a: 'counts', start: [middle], text: (a) => `manual ${short(a)}` },
            AUTO: { name: 'Automatic', start: [], text: () => 'automatic' },
            LIMITS: { name: 'Limits', a: 'lowest', b: 'highest', start: [s.OUTPUT_MIN, middle],
                text: (a, b) => `limits ${short(a)} to ${short(b)}` },
            FEEDFORWARD: { name: 'Feed-forward', a: 'counts', start: [0], text: (a) => `feed-forward ${short(a)}` },
        });
    }
    return kinds;
}

export function textOf(s, event) {
    return kindsOf(s)[event.what]?.text(event.a, event.b) ?? event.what.toLowerCase();
}

function replaced(events, at, more) {
    return events.map((event, i) => (i === at ? { ...event, ...more } : event));
}

function withoutEvent(events, at) {
    return events.filter((_, i) => i !== at);
}

// Within what is shown, and round: finer than a hundredth of it.
function tidyTime(s, seconds) {
    const step = 10 ** Math.floor(Math.log10(s.DURATION) - 2);
    const inside = Math.min(s.DURATION, Math.max(0, seconds));
    return Number((Math.round(inside / step) * step).toPrecision(6));
}

const LETTER = 7.2; // pixels of a flag's text, about
const EDGES = 18;

// Where each flag stands: its row, as flags that would cover each other stand
// below each other, and whether it is to the left of its time.
function placesOf(s, width, plots) {
    const flags = s.events.map((event, i) => {
        const size = LETTER * textOf(s, event).length + EDGES;
        const x = plots.gutter + (width - plots.gutter - plots.right) * event.at / s.DURATION;
        const late = x + size > width;
        return { i, late, left: late ? x - size : x, size };
    });
    const ends = []; // of each row, where its last flag ends
    const places = [];
    for (const { i, late, left, size } of flags.sort((one, other) => one.left - other.left)) {
        const free = ends.findIndex((end) => end <= left);
        const row = free < 0 ? ends.length : free;
        ends[row] = left + size;
        places[i] = { row, late };
    }
    return places;
}

// The flags above the plots; update(state) after each change. `plots` has the
// gutters, onEvents(events) takes what was moved.
export function createFlags(place, plots, state, onEvents) {
    let flags = [];
    let held = -1; // the one that is dragged

    function build(count) {
        flags = Array.from({ length: count }, (_, i) => {
            const flag = make('button', { type: 'button', className: 'flag' });
            flag.addEventListener('pointerdown', (event) => {
                held = i;
                flag.setPointerCapture(event.pointerId);
            });
            flag.addEventListener('pointerup', () => {
                held = -1;
            });
            flag.addEventListener('pointermove', (event) => drag(event, i));
            flag.addEventListener('keydown', (event) => press(event, i));
            return flag;
        });
        place.replaceChildren(...flags);
    }

    function drag(event, i) {
        if (held !== i) {
            return;
        }
        const box = place.getBoundingClientRect();
        const part = (event.clientX - box.left - plots.gutter) / (box.width - plots.gutter - plots.right);
        onEvents(replaced(state().events, i, { at: tidyTime(state(), part * state().DURATION) }));
    }

    // The focus goes to the flag that stands in the place of one that was removed.
    function press(event, i) {
        const way = { ArrowLeft: -1, ArrowRight: 1, Delete: 0 }[event.key];
        if (way === undefined) {
            return;
        }
        event.preventDefault();
        const s = state();
        if (way === 0) {
            onEvents(withoutEvent(s.events, i));
            requestAnimationFrame(() => flags[Math.min(i, flags.length - 1)]?.focus()); // when it is drawn
        } else {
            onEvents(replaced(s.events, i, { at: tidyTime(s, s.events[i].at + way * s.DURATION / 100) }));
        }
    }

    let [last, width] = [null, 0];
    const update = (s) => {
        last = s;
        if (flags.length !== s.events.length) {
            build(s.events.length);
        }
        const places = placesOf(s, width, plots);
        place.style.setProperty('--rows', Math.max(1, ...places.map(({ row }) => row + 1)));
        s.events.forEach((event, i) => {
            const part = event.at / s.DURATION;
            flags[i].style.setProperty('--row', places[i].row);
            const text = textOf(s, event);
            flags[i].textContent = text;
            flags[i].hidden = part > 1;
            flags[i].classList.toggle('late', places[i].late);
            flags[i].style.setProperty('--at', part);
            flags[i].setAttribute('aria-label', `${text} at ${short(event.at)} s; the arrow keys move it, Delete removes it`);
        });
    };
    new ResizeObserver(() => {
        width = place.clientWidth;
        if (last !== null) {
            update(last);
        }
    }).observe(place);
    return update;
}

// The list of fields; it is built again when a kind or their number changes, so
// that a field keeps its focus while it is typed in.
export function createEventList(place, state, onEvents) {
    let shape = '';
    let fields = [];

    function row(s, event, i) {
        const kinds = kindsOf(s);
        const set = (more) => onEvents(replaced(state().events, i, more));
        const what = make('select', { 'aria-label': `What happens, ${i + 1}` },
            ...Object.entries(kinds).map(([key, kind]) => make('option', { value: key, textContent: kind.name })));
        what.value = event.what;
        what.addEventListener('change', () => {
            const [a = 0, b = 0] = kinds[what.value].start;
            set({ what: what.value, a, b });
        });
        const number = (key, label) => createField(`e-${i}-${key}`, { 'aria-label': `${label}, ${i + 1}` },
            { read: () => state().events[i]?.[key] ?? 0, onInput: (value) => set({ [key]: value }),
                step: () => ({ least: key === 'at' ? state().DURATION / 1000 : 0.01 }) });
        const at = number('at', 'Seconds');
        const kind = kinds[event.what] ?? {};
        const values = ['a', 'b'].filter((key) => kind[key]).map((key) => number(key, `${kind.name}, ${kind[key]}`));
        const remove = make('button', { type: 'button', className: 'quiet', textContent: '×', 'aria-label': `Remove ${textOf(s, event)}` });
        remove.addEventListener('click', () => onEvents(withoutEvent(state().events, i)));
        fields.push(at, ...values);
        return make('div', { className: 'event' }, what, make('span', { className: 'at' }, at.field, ' s'),
            make('span', { className: 'values' }, ...values.map((value) => value.field)), remove, ...[at, ...values].map((one) => one.why));
    }

    function build(s) {
        fields = [];
        const add = make('button', { type: 'button', textContent: 'Add an event' });
        add.disabled = s.events.length >= LIMIT.EVENTS;
        add.addEventListener('click', () => {
            const now = state();
            const [what, kind] = Object.entries(kindsOf(now))[now.PLANT === PLANT.PENDULUM ? 0 : 1];
            const [a = 0, b = 0] = kind.start;
            onEvents([...now.events, { at: tidyTime(now, now.DURATION / 2), what, a, b }]);
        });
        place.replaceChildren(...s.events.map((event, i) => row(s, event, i)), add);
    }

    return (s) => {
        const wanted = JSON.stringify([s.preset, s.unit, s.events.map((event) => event.what)]);
        if (wanted !== shape) {
            shape = wanted;
            build(s);
        }
        for (const one of fields) {
            one.update();
        }
    };
}
