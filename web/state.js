// SPDX-License-Identifier: MIT
// The page's one state, from which everything else follows: the parameters of
// the C by their names there, and a few of the page's own. A preset is a whole
// state; a link has what differs from one.
import { CONTROLLER, EVENT, EXPERIMENT, LIMIT, OPTION, PARAM, PLANT, RULE } from './built.js';
import { gainsFor, plantOfKind, sceneOfPlant, withPlant } from './own.js';

const common = {
    CONTROLLER: CONTROLLER.PID, GAIN: 100, T1: 1, T2: 0, DAMPING: 0.3, DEAD: 0, START: 0,
    SENSOR_BITS: 12, SENSOR_LOW: 0, SENSOR_RANGE: 100, NOISE: 0,
    OUTPUT_MIN: 0, OUTPUT_MAX: 1000, RATE: 20, DURATION: 60, SETPOINT: 50,
    KP: 1, KI: 0, KD: 0, FILTER: 0, WEIGHT: 1, OPTIONS: 0, INTEGRAL_MIN: 0, INTEGRAL_MAX: 0,
    EXPERIMENT: EXPERIMENT.RELAY, SWING: 0, CYCLES: 1, DRIVE: 100, ROBUSTNESS: 16,
    CLOCK: 16, unit: '%', loop: '', rule: 'PI', events: [], kept: [],
};

function preset(id, name, story, more) {
    return { ...common, preset: id, name, story, ...more };
}

export const PRESETS = [
    preset('oven', 'Oven', 'A reflow oven: an element warms a body, and the sensor sees it late. It cannot cool, so overshoot is expensive.', {
        PLANT: PLANT.OVEN, GAIN: 400, T1: 60, T2: 6, DEAD: 2.5, START: 22, unit: '°C',
        SENSOR_RANGE: 409.5, NOISE: 1, RATE: 10, DURATION: 600, SETPOINT: 180,
        KP: 2.1, KI: 0.07, KD: 8, FILTER: 3, WEIGHT: 0.6, EXPERIMENT: EXPERIMENT.HEAT_UP,
        events: [{ at: 260, what: 'SETPOINT', a: 220 }, { at: 440, what: 'LOAD', a: -0.12 }],
    }),
    preset('flow', 'Lag and dead time', 'A flow, a pressure, a mixing tank: one lag behind a pipe. Most loops of a plant look like this.', {
        PLANT: PLANT.LAGS, GAIN: 100, T1: 8, T2: 0.6, DEAD: 1.2, RATE: 20, DURATION: 90,
        SETPOINT: 50, KP: 0.62, KI: 0.11, KD: 0.17, FILTER: 2, NOISE: 0.4,
        events: [{ at: 36, what: 'SETPOINT', a: 65 }, { at: 65, what: 'LOAD', a: -0.15 }],
    }),
    preset('spring', 'Oscillating stage', 'A stage on a spring: it rings by itself, and the derivative has to hold it.', {
        PLANT: PLANT.OSCILLATOR, GAIN: 100, T1: 0.25, DAMPING: 0.25, DEAD: 0.01, unit: 'mm',
        SENSOR_RANGE: 150, RATE: 200, DURATION: 12, SETPOINT: 50,
        KP: 1.1, KI: 2.8, KD: 0.18, FILTER: 3,
        events: [{ at: 5, what: 'SETPOINT', a: 75 }, { at: 8.5, what: 'LOAD', a: -0.15 }],
    }),
    preset('axis', 'Position of an axis', 'A drive that integrates: speed follows the output, position follows speed.', {
        PLANT: PLANT.INTEGRATOR, GAIN: 120, T2: 0.06, DEAD: 0.02, unit: 'mm',
        SENSOR_RANGE: 400, OUTPUT_MIN: -1000, RATE: 100, DURATION: 12, SETPOINT: 100,
        KP: 3, KI: 3, KD: 0.05, FILTER: 2, WEIGHT: 0.5, START: 20,
        events: [{ at: 4, what: 'SETPOINT', a: 250 }, { at: 8, what: 'LOAD', a: -0.2 }],
    }),
    preset('motor', 'Motor speed', 'A 24 V motor with a tachometer, friction and a load on its shaft; fixpid_pid holds the speed.', {
        PLANT: PLANT.MOTOR, GAIN: 24, T1: 26, T2: 4, unit: 'rad/s',
        SENSOR_RANGE: 480, NOISE: 1, OUTPUT_MIN: -1000, RATE: 1000, DURATION: 1.2, SETPOINT: 300,
        KP: 1.5, KI: 120, KD: 0, WEIGHT: 0.5,
        events: [{ at: 0.45, what: 'SETPOINT', a: 360 }, { at: 0.8, what: 'LOAD', a: 0.08 }],
    }),
    preset('an937', 'AN937’s motor', 'The same motor with Microchip’s application note AN937, its gains and its anti-windup limit.', {
        CONTROLLER: CONTROLLER.AN937, PLANT: PLANT.MOTOR, GAIN: 24, T1: 26, T2: 4, unit: 'rad/s',
        SENSOR_BITS: 10, SENSOR_RANGE: 480, NOISE: 0.6, OUTPUT_MIN: -1000,
        RATE: 1000, DURATION: 1.2, SETPOINT: 360, KP: 96, KI: 80, KD: 16, FILTER: 4,
        INTEGRAL_MAX: 4000,
        events: [{ at: 0.7, what: 'LOAD', a: 0.08 }, { at: 0.95, what: 'LOAD', a: 0 }],
    }),
    preset('an964', 'AN964’s pendulum', 'An inverted pendulum on a moving base: application note AN964, 256 steps a second, with its drift offset.', {
        CONTROLLER: CONTROLLER.AN964, PLANT: PLANT.PENDULUM, GAIN: 6, T1: 0.15, T2: 0.5, START: 8,
        unit: '°', SENSOR_BITS: 10, SENSOR_LOW: -30.028, SENSOR_RANGE: 60, NOISE: 0.6,
        OUTPUT_MIN: -1000, RATE: 256, DURATION: 12, SETPOINT: 0, KP: 900, KI: 80, KD: 800, CLOCK: 4,
        events: [{ at: 6, what: 'LOAD', a: 6 }],
    }),
    // With its first gains, which the C would have to be there for.
    { ...sceneOfPlant(preset('own', 'Your own', 'Your plant on your hardware: paste a recorded step, move the slider, copy the header.', {
        SENSOR_BITS: 10, SENSOR_RANGE: 300, OUTPUT_MAX: 255, RATE: 10, START: 20, unit: '°C',
    }), plantOfKind({ SENSOR_RANGE: 300, RATE: 10 }, PLANT.LAGS)), KP: 1.692, KI: 0.03828 },
];

// As it is, to read from; and a copy, to change.
export function presetOf(id) {
    return PRESETS.find((one) => one.preset === id) ?? PRESETS[0];
}

export function presetState(id) {
    return structuredClone(presetOf(id));
}

// The user's own plant on the hardware of this state.
export function ownState(s, plant) {
    const { preset: id, name, story } = presetState('own');
    return withPlant({ ...s, preset: id, name, story,
        CONTROLLER: s.preset === id ? s.CONTROLLER : CONTROLLER.PID }, plant);
}

// The same plant with another controller: with the preset's gains, if it is the preset's.
export function withController(s, controller) {
    const own = presetState(s.preset);
    const next = { ...s, CONTROLLER: controller };
    const { KP, KI, KD, FILTER, WEIGHT, INTEGRAL_MIN, INTEGRAL_MAX } = s.preset !== 'own' && own.CONTROLLER === controller ? own : gainsFor(next);
    return { ...next, KP, KI, KD, FILTER, WEIGHT, INTEGRAL_MIN, INTEGRAL_MAX };
}

// --- What is within reason ---------------------------------------------------
// A link and a field may hold anything. What a controller refuses stays, to be
// told; what no plant is, or what would take minutes, becomes the nearest that
// can be shown.

const REAL = [-1e6, 1e6];
const COUNTS = [-32768, 32767];
const EVERY_OPTION = Object.values(OPTION).reduce((all, bit) => all | bit);
const BOUNDS = {
    GAIN: REAL, T1: [0, 1e5], T2: [0, 1e5], DAMPING: [0.001, 100], DEAD: [0, 1e5], START: REAL,
    SENSOR_BITS: [6, 15], SENSOR_LOW: REAL, SENSOR_RANGE: [0.001, 1e6], NOISE: [0, 1000],
    OUTPUT_MIN: COUNTS, OUTPUT_MAX: COUNTS, RATE: [0.01, 20000], DURATION: [1e-4, 1e6], SETPOINT: REAL,
    KP: REAL, KI: REAL, KD: REAL, FILTER: [0, 255], WEIGHT: [0, 10], OPTIONS: [0, EVERY_OPTION],
    INTEGRAL_MIN: COUNTS, INTEGRAL_MAX: [-32768, 65535], CLOCK: [0.001, 1000], SWING: [0, 16383], CYCLES: [1, 4], ROBUSTNESS: [8, 64],
    EXPERIMENT: [EXPERIMENT.RELAY, EXPERIMENT.HEAT_UP], DRIVE: [0, 100],
};
export const WHOLE = ['SENSOR_BITS', 'OUTPUT_MIN', 'OUTPUT_MAX', 'FILTER', 'OPTIONS', 'INTEGRAL_MIN', 'INTEGRAL_MAX',
    'EXPERIMENT', 'SWING', 'CYCLES', 'ROBUSTNESS'];

function clamped(value, [low, high]) {
    return Math.min(high, Math.max(low, value));
}

// A lag that is shorter than a part of a step is none that can be simulated, and
// dead time ends with the memory for it.
function ofPlant(s) {
    const shortest = 1 / (30 * s.RATE);
    const dead = [0, 4000 / s.RATE];
    switch (s.PLANT) {
    case PLANT.MOTOR:
        return { GAIN: [0.1, 1000], T1: [0.5, 1e4], T2: [0, 1000], RATE: [50, 20000], DURATION: [0.01, 20] };
    case PLANT.PENDULUM:
        return { GAIN: [0.1, 100], T1: [0.005, 10], T2: [0.02, 10], RATE: [256, 256], DURATION: [0.1, 60], START: [-90, 90] };
    case PLANT.OVEN:
        return { T1: [Math.max(shortest, s.DURATION / 5000), 1e5], T2: [Math.max(shortest, s.DURATION / 5000), 1e5], DEAD: dead };
    case PLANT.INTEGRATOR:
        return { T2: s.T2 > 0 ? [shortest, 1e5] : REAL, DEAD: dead };
    default:
        return { T1: [shortest, 1e5], T2: s.T2 > 0 ? [shortest, 1e5] : REAL, DEAD: dead };
    }
}

export function withinReason(s) {
    const found = { ...s };
    found.PLANT = s.preset === 'own' ? clamped(Math.round(s.PLANT), [PLANT.LAGS, PLANT.MOTOR]) : presetOf(s.preset).PLANT;
    // A pendulum falls without the drift offset that only AN964's loop has here.
    found.CONTROLLER = found.PLANT === PLANT.PENDULUM ? CONTROLLER.AN964 : clamped(Math.round(s.CONTROLLER), [CONTROLLER.PID, CONTROLLER.AN964]);
    for (const [name, bounds] of [...Object.entries(BOUNDS), ['RATE', ofPlant(s).RATE ?? REAL]]) {
        found[name] = clamped(found[name], bounds);
    }
    for (const [name, bounds] of Object.entries(ofPlant(found))) {
        found[name] = clamped(found[name], bounds);
    }
    found.DURATION = Math.max(found.DURATION, 4 / found.RATE);
    WHOLE.forEach((name) => {
        found[name] = Math.round(found[name]);
    });
    found.OPTIONS &= EVERY_OPTION;
    found.events = found.events.map((event) => ({ ...event, at: clamped(event.at, [0, 1e6]),
        a: clamped(event.a ?? 0, REAL), b: clamped(event.b ?? 0, REAL) }));
    return found;
}

// One state at a time; who listens is told of a change once a frame.
let state = presetState('oven');
let listener = () => {};
let waiting = 0;

export function currentState() {
    return state;
}

export function onChange(what) {
    listener = what;
}

export function changeNow(next) {
    state = withinReason(next);
    cancelAnimationFrame(waiting);
    waiting = 0;
    listener();
}

export function change(more) {
    state = withinReason({ ...state, ...more });
    if (waiting === 0) {
        waiting = requestAnimationFrame(() => {
            waiting = 0;
            listener();
        });
    }
}

// --- The link ------------------------------------------------------------

export const KEPT_MOST = 4;
export const LOOP_NAME = /^[A-Za-z0-9_]{0,31}$/; // a part of names of C
export const LINKED = [...Object.keys(PARAM), 'CLOCK'];

export function eventsText(events) {
    return events.map((event) =>
        [event.what.toLowerCase(), event.at, event.a ?? 0, event.b ?? 0].join('_')).join('~');
}

// Without a star, which in a header would be a part of a comment's sign.
function encoded(text) {
    return encodeURIComponent(text).replaceAll('*', '%2A');
}

export function fragmentOf(of) {
    const from = presetState(of.preset);
    const parts = [`p=${of.preset}`];
    for (const name of LINKED) {
        if (of[name] !== from[name]) {
            parts.push(`${name.toLowerCase()}=${of[name]}`);
        }
    }
    for (const name of ['unit', 'loop', 'rule']) {
        if (of[name] !== from[name]) {
            parts.push(`${name}=${encoded(of[name])}`);
        }
    }
    if (eventsText(of.events) !== eventsText(from.events)) {
        parts.push(`events=${eventsText(of.events)}`);
    }
    if (of.kept.length > 0) {
        parts.push(`kept=${of.kept.map(encoded).join(';')}`);
    }
    return parts.join('&');
}

function eventOf(text) {
    const [what, at, a = 0, b = 0] = text.split('_');
    const event = { at: Number(at), what: String(what).toUpperCase(), a: Number(a), b: Number(b) };
    const good = EVENT[event.what] > 0 && [event.at, event.a, event.b].every(Number.isFinite);
    return good ? event : null;
}

function decoded(text) {
    try {
        return decodeURIComponent(text);
    } catch {
        return '';
    }
}

// What is not understood is left as the preset has it.
export function stateOfFragment(fragment) {
    const pairs = new Map(fragment.split('&').map((part) => {
        const at = part.indexOf('=');
        return [part.slice(0, at), part.slice(at + 1)];
    }));
    const found = presetState(pairs.get('p'));
    for (const name of LINKED) {
        const text = pairs.get(name.toLowerCase());
        if (text !== undefined && text !== '' && Number.isFinite(Number(text))) {
            found[name] = Number(text);
        }
    }
    if (pairs.has('unit')) {
        found.unit = decoded(pairs.get('unit')).slice(0, 12);
    }
    if (LOOP_NAME.test(pairs.get('loop') ?? '')) {
        found.loop = pairs.get('loop') ?? '';
    }
    if (pairs.get('rule') in RULE) {
        found.rule = pairs.get('rule');
    }
    if (pairs.has('events')) {
        found.events = pairs.get('events').split('~').map(eventOf).filter(Boolean).slice(0, LIMIT.EVENTS);
    }
    // Each is a link of its own, which keeps none.
    found.kept = (pairs.get('kept') ?? '').split(';').map(decoded).filter(Boolean).slice(0, KEPT_MOST)
        .map((one) => fragmentOf({ ...ofLink(one.replace(/(^|&)kept=[^&]*/, '')), kept: [] }));
    return found;
}

// What is shown where this link is opened.
export function ofLink(fragment) {
    return withinReason(stateOfFragment(fragment));
}
