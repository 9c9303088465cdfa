// SPDX-License-Identifier: MIT
// The sliders and numbers of the panel. Their ranges follow the plant, so that
// the middle of each is a sensible value.
import { CONTROLLER, PLANT, WORD } from './built.js';
import { make } from './dom.js';
import { digits, short } from './format.js';
import { countsGain, scaleSeconds } from './margins.js';
import { presetState } from './state.js';

// A range on a logarithmic scale `spread` times up and down.
function around(value, spread, zero = false) {
    const middle = Math.max(Math.abs(value), 1e-6);
    return { low: middle / spread, high: middle * spread, log: true, zero };
}

function straight(low, high, step) {
    return { low, high, step };
}

const from = (s, key) => presetState(s.preset)[key];
const likePreset = (key, spread) => (s) => around(from(s, key), spread);
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
            (now) => straight(0, 5 * Math.max(from(now, 'T2'), from(now, 'T1') / 10), from(now, 'T2') / 50)],
        ['DEAD', 'Dead time', 's', (now) => straight(0, 5 * from(now, 'DEAD'), from(now, 'DEAD') / 50)],
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
        ['FILTER', 'Derivative filter', '2ⁿ steps', () => straight(0, 7, 1)],
        ['WEIGHT', 'Setpoint weight', '', () => straight(0.01, 1, 0.01)],
    ];
}

const duration = (s) => around(from(s, 'DURATION'), 10);

function sensorControls(s) {
    const notes = s.CONTROLLER !== CONTROLLER.PID;
    const rate = ['RATE', 'Sample rate', 'steps per second', likePreset('RATE', 16)];
    const bits = ['SENSOR_BITS', 'Converter', 'bits', () => straight(6, 15, 1)];
    const noise = ['NOISE', 'Noise ±', 'counts', () => straight(0, 20, 0.2)];
    const range = ['SENSOR_RANGE', 'Range', s.unit, likePreset('SENSOR_RANGE', 5)];
    const show = ['DURATION', 'Show', 's', duration];
    if (s.CONTROLLER === CONTROLLER.AN964) {
        return [noise, show];
    }
    return [rate, ...(notes ? [] : [bits]), range, noise,
        ...(notes ? [] : [
            ['OUTPUT_MIN', 'Lowest output', 'counts', () => straight(-1000, 0, 10)],
            ['OUTPUT_MAX', 'Highest output', 'counts', () => ({ low: 15, high: 32767, log: true, whole: true })],
            ['INTEGRAL_MIN', 'Integral, lowest', 'counts; 0 and 0: free', (now) => straight(-Math.max(now.OUTPUT_MAX, 1), 0, 1)],
            ['INTEGRAL_MAX', 'Integral, highest', 'counts', (now) => straight(0, Math.max(now.OUTPUT_MAX, 1), 1)],
        ]), show];
}

function setpointControls(s) {
    return s.CONTROLLER === CONTROLLER.AN964 ? []
        : [['SETPOINT', 'Setpoint', s.unit, sensor]];
}

function tunerControls() {
    return [
        ['SWING', 'Swing', 'counts; 0: by the noise', (s) => straight(0, Math.round(2 ** s.SENSOR_BITS / 4), 8)],
        ['CYCLES', 'Cycles', 'of each relay', () => straight(1, 4, 1)],
        ['ROBUSTNESS', 'Robustness', Object.entries(WORD).map(([word, number]) => `${number} ${word.toLowerCase()}`).join(', '),
            () => straight(8, 64, 1)],
    ];
}

export function sectionsOf(s) {
    return [
        { title: 'Gains', open: true, controls: [...setpointControls(s), ...gainControls(s)] },
        { title: 'Plant', open: true, controls: plantControls(s) },
        { title: 'Sensor, actuator, rate', open: false, controls: sensorControls(s) },
        ...(s.CONTROLLER === CONTROLLER.PID ? [{ title: 'Autotune', open: false, controls: tunerControls() }] : []),
    ];
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

// One control; returns { row, update(state) }. `note` is text beside its label.
function createControl([key, label, unit, range], id, onInput) {
    const number = make('input', { type: 'number', id, step: 'any', inputMode: 'decimal' });
    const slider = make('input', { type: 'range', min: 0, max: POSITIONS, step: 1 });
    slider.setAttribute('aria-label', `${label}, slider`);
    const note = make('em', {});
    const name = make('label', { htmlFor: id }, label, ' ', make('small', { textContent: unit }));
    let now = null;
    slider.addEventListener('input', () => onInput(key, valueOf(range(now), Number(slider.value))));
    number.addEventListener('input', () => {
        if (number.value !== '' && Number.isFinite(Number(number.value))) {
            onInput(key, Number(number.value));
        }
    });
    number.addEventListener('change', () => {
        number.value = short(now[key]);
    });
    function update(s, text = note.textContent) {
        now = s;
        if (document.activeElement !== number) { // not while it is typed in
            number.value = short(s[key]);
        }
        const at = positionOf(range(s), s[key]);
        slider.value = at;
        slider.setAttribute('aria-valuetext', `${digits(s[key], 4)} ${unit}`);
        slider.style.setProperty('--part', `${Math.min(100, Math.max(0, at / POSITIONS * 100))}%`);
        note.textContent = text;
    }
    return { key, row: make('div', { className: 'control' }, name, note, slider, number), update };
}

// Fills the panel; returns update(state, notes), which builds it again only when
// its controls are others.
export function createPanel(place, onInput) {
    let [shape, controls] = ['', []];
    function build(s) {
        const open = new Map([...place.querySelectorAll('details')].map((one) => [one.dataset.title, one.open]));
        controls = [];
        place.replaceChildren(...sectionsOf(s).map((section) => {
            const rows = section.controls.map((one) => {
                const control = createControl(one, `c-${one[0].toLowerCase()}`, onInput);
                controls.push(control);
                return control.row;
            });
            const details = make('details', { open: open.get(section.title) ?? section.open },
                make('summary', { textContent: section.title }), ...rows);
            details.dataset.title = section.title;
            return details;
        }));
    }
    return (s, notes) => {
        const wanted = JSON.stringify([s.preset, s.unit, sectionsOf(s).map((one) => one.controls.map(([key]) => key))]);
        if (wanted !== shape) {
            shape = wanted;
            build(s);
        }
        for (const control of controls) {
            control.update(s, notes[control.key] ?? '');
        }
    };
}
