// SPDX-License-Identifier: MIT
// The sliders and numbers of the panel. Their ranges follow the plant, so that
// the middle of each is a sensible value.
import { CONTROLLER, EXPERIMENT, OPTION, PLANT, WORD } from './built.js';
import { calmSlider, hasLine } from './calm.js';
import { find, make, setText } from './dom.js';
import { createField } from './fields.js';
import { digits } from './format.js';
import { helpFor } from './help.js';
import { countsGain, scaleSeconds } from './margins.js';
import { KINDS, gainsFor, plantOfKind, withPlant } from './own.js';
import { WHOLE, currentState, presetOf, withController } from './state.js';

// A range on a logarithmic scale `spread` times up and down.
function around(value, spread, zero = false) {
    const middle = Math.max(Math.abs(value), 1e-6);
    return { low: middle / spread, high: middle * spread, log: true, zero };
}

function straight(low, high, step) {
    return { low, high, step };
}

const isOwn = (s) => s.preset === 'own';

// What a double click resets a number to.
function from(s, key) {
    return (isOwn(s) || s.CONTROLLER !== presetOf(s.preset).CONTROLLER ? gainsFor(s)[key] : undefined) ?? presetOf(s.preset)[key];
}

// Around the preset's value; of a plant of one's own nothing is known before.
const WIDE = { T1: [1e-3, 1e4], T2: [1e-3, 1e4], RATE: [0.1, 20000], SENSOR_RANGE: [0.1, 1e4] };

function likePreset(key, spread) {
    return (s) => {
        if (!isOwn(s) || s.PLANT === PLANT.MOTOR && key === 'T1') {
            return around(from(s, key), spread);
        }
        const [low, high] = WIDE[key] ?? [s.SENSOR_RANGE / 50, s.SENSOR_RANGE * 50];
        return { low, high, log: true };
    };
}

// Dead time and second lags, from 0.
function upTo(part) {
    return (s) => {
        const most = isOwn(s) ? Math.max(scaleSeconds({ ...s, DEAD: 0, T2: 0 }), 10 / s.RATE) : part(s);
        return straight(0, most, most / 250);
    };
}
const sensor = (s) => straight(s.SENSOR_LOW, s.SENSOR_LOW + s.SENSOR_RANGE,
    s.SENSOR_RANGE / 500);
const integrates = (s) => s.PLANT === PLANT.INTEGRATOR;

// [state's name, label, unit, range].
function plantControls(s) {
    switch (s.PLANT) {
    case PLANT.OVEN: return [
        ['GAIN', 'Full power', `${s.unit} above the air`, likePreset('GAIN', 5)],
        ['T1', 'Body', 's', likePreset('T1', 10)],
        ['T2', 'Element', 's', likePreset('T2', 10)],
        ['DEAD', 'Dead time', 's', (now) => straight(0, 4 * from(now, 'DEAD'), 0.1)],
        ['START', 'Air', s.unit, () => straight(0, 60, 1)],
    ];
    case PLANT.MOTOR: return [
        ['GAIN', 'Supply', 'V', () => straight(6, 48, 0.5)],
        ['T1', 'Inertia', '10⁻⁶ kg m²', likePreset('T1', 8)],
        ['T2', 'Friction', 'mN m', () => straight(0, 30, 0.5)],
    ];
    case PLANT.PENDULUM: return [
        ['START', 'Released at', '°', () => straight(-15, 15, 0.5)],
        ['T2', 'Rod', 'm', likePreset('T2', 3)],
        ['T1', 'Motor’s lag', 's', likePreset('T1', 4)],
        ['GAIN', 'Full speed', 'm/s', likePreset('GAIN', 3)],
    ];
    case PLANT.OSCILLATOR: return [
        ['GAIN', 'Gain', `${s.unit} at full drive`, likePreset('GAIN', 5)],
        ['T1', '1 / natural frequency', 's', likePreset('T1', 10)],
        ['DAMPING', 'Damping', '', () => straight(0.02, 1.5, 0.01)],
        ['DEAD', 'Dead time', 's', (now) => straight(0, now.T1, now.T1 / 200)],
        ['START', 'At rest', s.unit, sensor],
    ];
    default: return [
        ['GAIN', integrates(s) ? 'Speed' : 'Gain',
            integrates(s) ? `${s.unit}/s at full drive` : `${s.unit} at full drive`, likePreset('GAIN', 5)],
        ...(integrates(s) ? [] : [['T1', 'Lag', 's', likePreset('T1', 10)]]),
        ['T2', integrates(s) ? 'Lag' : 'Second lag', 's',
            upTo((now) => 5 * Math.max(from(now, 'T2'), from(now, 'T1') / 10))],
        ['DEAD', 'Dead time', 's', upTo((now) => 5 * from(now, 'DEAD'))],
        ['START', 'At rest', s.unit, sensor],
    ];
    }
}

function gainControls(s) {
    if (s.CONTROLLER === CONTROLLER.AN937) {
        return [
            ['KP', 'kp', '/ 16', () => straight(0, 255, 1)],
            ['KI', 'ki', '/ 16 per tick', () => straight(0, 255, 1)],
            ['KD', 'kd', '/ 16 per sample', () => straight(0, 255, 1)],
            ['FILTER', 'Derivative period', 'ticks', () => straight(1, 32, 1)],
            ['INTEGRAL_MAX', 'Accumulated error', 'limit', () => ({ low: 100, high: 65535, log: true, whole: true })],
        ];
    }
    if (s.CONTROLLER === CONTROLLER.AN964) {
        return [
            ['KP', 'KP', 'of 1023', () => straight(0, 1023, 1)],
            ['KI', 'KI', 'of 1023', () => straight(0, 1023, 1)],
            ['KD', 'KD', 'of 1023', () => straight(0, 1023, 1)],
        ];
    }
    return [
        ['KP', 'kp', 'counts per count', (now) => around(1 / countsGain(now), 60, true)],
        ['KI', 'ki', 'per second', (now) => around(1 / countsGain(now) / scaleSeconds(now), 100, true)],
        ['KD', 'kd', 'seconds', (now) => around(0.1 * scaleSeconds(now) / countsGain(now), 100, true)],
    ];
}

// What most loops leave as it is.
function moreControls(s) {
    return s.CONTROLLER !== CONTROLLER.PID ? [] : [
        ['FILTER', 'Derivative filter', '2ⁿ − 1 steps', () => straight(0, 7, 1)],
        ['WEIGHT', 'Setpoint weight', '', () => straight(0.01, 1, 0.01)],
        ['INTEGRAL_MIN', 'Integral, lowest', 'counts; 0 and 0: free', (now) => straight(-Math.max(now.OUTPUT_MAX, 1), 0, 1)],
        ['INTEGRAL_MAX', 'Integral, highest', 'counts', (now) => straight(0, Math.max(now.OUTPUT_MAX, 1), 1)],
    ];
}

const duration = (s) => around(isOwn(s) ? 12 * scaleSeconds(s) : from(s, 'DURATION'), 10);

function hardwareControls(s) {
    const notes = s.preset === 'an937';
    return s.PLANT === PLANT.PENDULUM ? [] : [
        ...(notes ? [] : [['SENSOR_BITS', 'Converter', 'bits', () => straight(6, 15, 1)],
            ['SENSOR_LOW', 'Count 0 is', s.unit, (now) => straight(-now.SENSOR_RANGE, now.SENSOR_RANGE, now.SENSOR_RANGE / 200)]]),
        ['SENSOR_RANGE', 'All counts are', s.unit, likePreset('SENSOR_RANGE', 5)],
        ...(notes ? [] : [['OUTPUT_MIN', 'Lowest output', 'counts', (now) => straight(-Math.max(now.OUTPUT_MAX, 1), 0, 1)],
            ['OUTPUT_MAX', 'Highest output', 'counts', () => ({ low: 15, high: 32767, log: true, whole: true })]]),
        ['RATE', 'Sample rate', 'steps per second', likePreset('RATE', 16)],
    ];
}

function setpointControls(s) {
    return s.PLANT === PLANT.PENDULUM ? []
        : [['SETPOINT', 'Setpoint', s.unit, sensor]];
}

function tunerControls({ EXPERIMENT: kind }) {
    return [
        ...(kind === EXPERIMENT.HEAT_UP ? [
            ['DRIVE', 'Heat-up', '% of the highest output', () => straight(10, 100, 5)],
        ] : [
            ['SWING', 'Swing', 'counts at most; 0: an eighth', (s) => straight(0, Math.round(2 ** s.SENSOR_BITS / 4), 8)],
            ['CYCLES', 'Cycles', 'of each relay', () => straight(1, 4, 1)],
        ]),
        ['ROBUSTNESS', 'Robustness', Object.entries(WORD).map(([word, number]) => `${number} ${word.toLowerCase()}`).join(', '),
            () => straight(8, 64, 1)],
    ];
}

// In the order of the work; `at` is the part of the page that has a section.
export function sectionsOf(s) {
    const own = isOwn(s);
    const pid = s.CONTROLLER === CONTROLLER.PID;
    return [
        { at: 'plant', title: '1 Sensor, actuator, rate', open: own, head: own ? [unitField] : [], controls: hardwareControls(s) },
        { at: 'plant', title: '2 Your plant', open: true, sliders: true, head: [mounted('#recorder'), ...(own ? [kindChoice] : [])], controls: plantControls(s) },
        { at: 'gains', title: '3 Gains', open: true, sliders: true, head: hasLine(s) ? [calmSlider] : [], controls: [...setpointControls(s), ...gainControls(s)] },
        ...(s.PLANT === PLANT.PENDULUM ? [] : [{ at: 'more', title: 'Controller and options', head: [controllerChoice, firstButton, optionBoxes], controls: moreControls(s) }]),
        ...(pid ? [{ at: 'more', title: 'Autotune', controls: tunerControls(s) }] : []),
        { at: 'more', title: 'What happens, and when', head: [mounted('#events')], controls: [['NOISE', 'Noise ±', 'counts', () => straight(0, 20, 0.2)], ['DURATION', 'Show', 's', duration]] },
    ].filter(({ head = [], controls }) => head.length + controls.length > 0);
}

// --- Slider positions: 0..400 -------------------------------------------------

const POSITIONS = 400;

function positionOf(range, value) {
    if (range.log) {
        if (value <= 0) {
            return 0;
        }
        const part = Math.log(value / range.low) / Math.log(range.high / range.low);
        return Math.max(range.zero ? 1 : 0, Math.round(POSITIONS * part));
    }
    return Math.round(POSITIONS * (value - range.low) / (range.high - range.low));
}

function valueOf(range, position) {
    if (range.log) {
        if (range.zero && position === 0) {
            return 0;
        }
        const value = range.low * (range.high / range.low) ** (position / POSITIONS);
        return range.whole ? Math.round(value) : Number(value.toPrecision(3));
    }
    const value = range.low + (range.high - range.low) * position / POSITIONS;
    const step = range.step ?? (range.high - range.low) / POSITIONS;
    const tidy = Math.round(value / step) * step;
    return Number(Math.min(range.high, Math.max(range.low, tidy)).toPrecision(6));
}

// What an arrow key moves a value of 0 by.
function leastStep(range) {
    return range.log ? range.low : (range.high - range.low) / POSITIONS;
}

// The slider of a control; its field has the same by the arrow keys, so that Tab passes it.
function createSlider(key, label, unit, range, onInput) {
    const slider = make('input', { type: 'range', min: 0, max: POSITIONS, step: 1, tabIndex: -1, title: 'A double click resets it', 'aria-label': `${label}, slider` });
    slider.addEventListener('input', () => onInput(key, valueOf(range(currentState()), Number(slider.value))));
    slider.addEventListener('dblclick', () => onInput(key, from(currentState(), key)));
    return { slider, update: (s) => {
        slider.value = positionOf(range(s), s[key]);
        slider.setAttribute('aria-valuetext', `${digits(s[key], 4)} ${unit}`);
    } };
}

// One control; returns { row, update(state) }. `note` is text beside its label.
function createControl([key, label, unit, range], id, hasSlider, onInput) {
    const note = make('em', {});
    const name = make('label', { htmlFor: id }, label, ' ', make('small', { textContent: unit }));
    const number = createField(id, {}, { read: () => currentState()[key], onInput: (value) => onInput(key, value),
        step: () => ({ least: leastStep(range(currentState())), whole: WHOLE.includes(key) }) });
    const { slider = '', update = () => {} } = hasSlider ? createSlider(key, label, unit, range, onInput) : {};
    return { key, row: make('div', { className: hasSlider ? 'control' : 'control plain' }, name, note, slider, number.field, number.why, helpFor(key)),
        update: (s, text) => {
            number.update();
            update(s);
            setText(note, text);
        } };
}

// What stands above the controls of a section: { row, update(state) }. Each gets what
// takes a change of the state.
const mounted = (selector) => () => ({ row: find(selector), update: () => {} }); // a part that has its own module

function unitField(onMore) {
    const field = make('input', { type: 'text', id: 'c-unit', maxLength: 12, size: 5, value: currentState().unit });
    field.addEventListener('input', () => onMore({ unit: field.value }));
    return { row: make('label', { className: 'line' }, 'Unit ', field),
        update: (s) => {
            if (document.activeElement !== field) {
                field.value = s.unit;
            }
        } };
}

function kindChoice(onMore) {
    const choice = make('select', { id: 'c-plant' }, ...KINDS.map(([kind, name, like]) =>
        make('option', { value: kind, textContent: `${name}: ${like}` })));
    choice.addEventListener('change', () => {
        const s = currentState();
        onMore(withPlant(s, plantOfKind(s, Number(choice.value))));
    });
    return { row: make('label', { className: 'line' }, 'Kind ', choice), update: (s) => {
        choice.value = s.PLANT;
    } };
}

const CONTROLLERS = [[CONTROLLER.PID, 'fixpid_pid'], [CONTROLLER.AN937, 'fixpid_an937, the note’s'], [CONTROLLER.AN964, 'fixpid_an964, the note’s']];

function controllerChoice(onMore) {
    const choice = make('select', { id: 'c-controller' }, ...CONTROLLERS.map(([value, textContent]) => make('option', { value, textContent })));
    choice.addEventListener('change', () => onMore(withController(currentState(), Number(choice.value))));
    return { row: make('label', { className: 'line' }, 'Controller ', choice), update: (s) => {
        choice.value = s.CONTROLLER;
    } };
}

const OPTIONS = { 'reverse acting': OPTION.REVERSE, 'derivative on the error': OPTION.DERIVATIVE_ON_ERROR, 'P on the measurement': OPTION.PROPORTIONAL_ON_MEASUREMENT };

function optionBoxes(onMore) {
    const boxes = Object.entries(OPTIONS).map(([text, bit]) => {
        const box = make('input', { type: 'checkbox', value: bit });
        box.addEventListener('change', () => {
            const s = currentState();
            onMore({ OPTIONS: box.checked ? s.OPTIONS | bit : s.OPTIONS & ~bit });
        });
        return { box, bit, row: make('div', {}, make('label', {}, box, ` ${text}`), helpFor(text)) };
    });
    return { row: make('div', { id: 'options' }, ...boxes.map(({ row }) => row)), update: (s) => boxes.forEach(({ box, bit, row }) => {
        box.checked = (s.OPTIONS & bit) !== 0;
        row.hidden = s.CONTROLLER !== CONTROLLER.PID && bit !== OPTION.REVERSE;
    }) };
}

function firstButton(onMore) {
    const button = make('button', { type: 'button', id: 'first-gains', textContent: 'First gains for this plant' });
    button.addEventListener('click', () => onMore(gainsFor(currentState())));
    return { row: button, update: () => {} };
}

// Fills the panel; returns update(state, notes), which builds it again only when its
// controls are others. What has the focus has it afterwards.
export function createPanel(onMore) {
    const places = ['plant', 'gains', 'more'].map((id) => find(`#${id}`));
    let [shape, controls] = ['', []];
    const onInput = (key, value) => onMore({ [key]: value });

    function build(sections) {
        const open = new Map(places.flatMap((place) => [...place.children].map((one) => [one.dataset.title, one.open])));
        const focused = document.activeElement.id;
        const made = sections.map(({ at, title, open: first, head = [], sliders = false, controls: own }) => {
            const rows = [...head.map((one) => one(onMore)), ...own.map((one) => createControl(one, `c-${one[0].toLowerCase()}`, sliders, onInput))];
            const details = make('details', { open: open.get(title) ?? first }, make('summary', { textContent: title }), ...rows.map(({ row }) => row));
            details.dataset.title = title;
            return { at, details, rows };
        });
        places.forEach((place) => place.replaceChildren(...made.filter(({ at }) => at === place.id).map(({ details }) => details)));
        controls = made.flatMap(({ rows }) => rows);
        if (focused !== '' && document.activeElement.id !== focused) {
            document.getElementById(focused)?.focus();
        }
    }
    return (s, notes) => {
        const sections = sectionsOf(s);
        const wanted = JSON.stringify([s.preset, s.PLANT, s.CONTROLLER, s.unit, sections.map((one) => one.controls.map(([key]) => key))]);
        if (wanted !== shape) {
            shape = wanted;
            build(sections);
        }
        for (const control of controls) {
            control.update(s, notes[control.key] ?? '');
        }
    };
}
