// SPDX-License-Identifier: MIT
// A plant of the user's own, on the user's own hardware: what a plant's kind is called,
// its first gains, and a scene for it that leaves sensor, actuator and rate as they are.
import { CONTROLLER, FIT_KIND, LIMIT, OPTION, PLANT } from './built.js';
import { identifySimc } from './identify.js';
import { errorPerCount, scaleSeconds } from './margins.js';
import { unitsPerCount } from './units.js';

export const KINDS = [
    [PLANT.LAGS, 'Lag and dead time', 'most flows, pressures, temperatures'],
    [PLANT.INTEGRATOR, 'Integrator', 'a level, the position of an axis'],
    [PLANT.OSCILLATOR, 'Oscillating', 'a spring, a swing'],
    [PLANT.MOTOR, 'DC motor', 'its speed'],
];

export const round4 = (x) => Number(x.toPrecision(4));

// A motor without friction is two lags; the numbers are those of plant_motor.c.
function motorAsLags(s) {
    const [resistance, inductance, constant, viscous] = [2.4, 0.4e-3, 0.05, 1e-5];
    const both = constant * constant + resistance * viscous;
    return { gain: s.GAIN * constant / both, lags: [resistance * s.T1 * 1e-6 / both, inductance / resistance] };
}

// The state's plant as Skogestad's rules (SIMC) take it, of counts per count.
function plantOf(s) {
    const { gain, lags } = s.PLANT === PLANT.MOTOR ? motorAsLags(s) : { gain: s.GAIN, lags: [s.T1, s.T2] };
    const [lag2, lag] = lags.sort((a, b) => a - b);
    const plant = { kind: FIT_KIND.SECOND, gain: Math.abs(gain) / unitsPerCount(s) / Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN), lag, lag2, damping: 0, dead: s.PLANT === PLANT.MOTOR ? 0 : s.DEAD };
    switch (s.PLANT) {
    case PLANT.OSCILLATOR: return { ...plant, kind: FIT_KIND.RINGING, lag: s.T1, lag2: 0, damping: s.DAMPING };
    case PLANT.INTEGRATOR: return { ...plant, kind: FIT_KIND.INTEGRATING, lag: 0, lag2: s.T2 };
    default: return plant;
    }
}

// Their gains, with a time constant of the loop `calm` times the one that they advise. D is of what
// oscillates.
export function simcGains(s, calm = 1) {
    const filter = Math.min(7, Math.max(0, Math.floor(Math.log2(s.T1 * s.RATE / 10))));
    return withGains(...identifySimc(plantOf(s), 1 / s.RATE, calm), s.PLANT === PLANT.OSCILLATOR ? filter : 0);
}

// The time constant of the loop with these gains, and how many times that of SIMC it is, if
// they are SIMC's for any; else null. 1 / kp grows evenly with it, from the dead time on.
export function calmOf(s) {
    const plant = plantOf(s);
    const [none, own] = [0, 1].map((calm) => 1 / identifySimc(plant, 1 / s.RATE, calm)[0]);
    const calm = (1 / s.KP - none) / (own - none);
    const other = calm > 0 && Number.isFinite(calm) ? simcGains(s, calm) : null;
    const near = (key) => Math.abs(s[key] - other[key]) <= 0.002 * other[key];
    const same = other !== null && near('KI') && near('KD') && (s.KD === 0 || s.FILTER === other.FILTER);
    return same ? { calm, seconds: calm * (own / none - 1) * (plant.dead + plant.lag2 / 2 + 0.5 / s.RATE) } : null;
}

function withGains(kp, ki, kd = 0, filter = 0) {
    return { KP: round4(kp), KI: round4(ki), KD: round4(kd), FILTER: filter, WEIGHT: 1 };
}

// --- The notes' controllers ----------------------------------------------------------

// The integers that come nearest to these gains, as real numbers, and where each ends.
function notesNumbers(s, { KP, KI, KD }) {
    if (s.CONTROLLER === CONTROLLER.AN937) {
        const q4 = 16 / errorPerCount(s);
        return [['KP', KP * q4, 255], ['KI', KI / s.RATE * q4, 255], ['KD', KD * s.RATE * q4, 255]];
    }
    const all = Math.min(1023 / 1024, KP); // kp multiplies I and D, too
    return [['KP', KP * 1024, 1023], ['KI', KI / s.RATE / all * 4096, 1023], ['KD', KD * s.RATE / 3 / all * 32, 1023]];
}

// First gains of the controller that the state has.
export function gainsFor(s) {
    const first = simcGains(s);
    if (s.CONTROLLER === CONTROLLER.PID) {
        return { ...first, INTEGRAL_MIN: 0, INTEGRAL_MAX: 0 };
    }
    const found = Object.fromEntries(notesNumbers(s, first).map(([name, wanted, most]) => [name, Math.round(Math.min(most, wanted))]));
    // The sum may be as long as the output needs, and no longer.
    const sum = Math.ceil(16 * Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN) / Math.max(1, found.KI));
    return { ...found, FILTER: 1, WEIGHT: 1, INTEGRAL_MIN: 0, INTEGRAL_MAX: s.CONTROLLER === CONTROLLER.AN937 ? Math.min(65535, sum) : 0 };
}

// Texts: which of the plant's first gains the note's controller cannot have, and what
// else its limits take away.
export function notesLimits(s) {
    const name = s.CONTROLLER === CONTROLLER.AN937 ? 'AN937' : 'AN964';
    const found = notesNumbers(s, simcGains(s)).flatMap(([key, wanted, most]) => {
        if (Math.round(wanted) > most) {
            return [`${name}’s ${key.toLowerCase()} ends at ${most}; this plant’s first gains want ${Math.round(wanted)}.`];
        }
        return wanted > 0 && wanted < 0.5 ? [`${name}’s ${key.toLowerCase()} of 1 is more than this plant’s first gains want, ${round4(wanted)}: ${key === 'KI' ? 'sample more slowly' : 'scale the sensor'}.`] : [];
    });
    if (s.CONTROLLER !== CONTROLLER.AN964) {
        return found;
    }
    const most = Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN);
    const integral = Math.floor(Math.floor(LIMIT.AN964_SUM / 256) * s.KI / 16) * s.KP / 1024;
    return [...found,
        ...(s.KI > 0 && integral < most ? [`Its integral alone reaches ${Math.floor(integral)} of ${most} counts: the sum ends at ${LIMIT.AN964_SUM}.`] : []),
        ...(most > LIMIT.AN964_OUTPUT ? [`Its output ends at ${LIMIT.AN964_OUTPUT} of ${most} counts.`] : []),
        ...(2 ** s.SENSOR_BITS > 1024 ? ['Its error ends at 1023 counts, which is not the whole sensor.'] : [])];
}

// --- The user's plant ------------------------------------------------------------------

// Whether the loop acts against the plant: more output, less of what is measured.
export function actsWrongly(s) {
    return s.PLANT !== PLANT.PENDULUM && s.GAIN < 0 !== ((s.OPTIONS & OPTION.REVERSE) !== 0);
}

// Of a kind that was chosen anew: slow enough for the rate, and within the sensor.
export function plantOfKind(s, kind) {
    const [steps, span] = [1 / s.RATE, s.SENSOR_RANGE];
    return { PLANT: kind, DAMPING: 0.3, ...{
        [PLANT.LAGS]: { GAIN: 0.8 * span, T1: round4(600 * steps), T2: 0, DEAD: round4(50 * steps) },
        [PLANT.INTEGRATOR]: { GAIN: round4(0.002 * span * s.RATE), T2: round4(10 * steps), DEAD: round4(5 * steps) },
        [PLANT.OSCILLATOR]: { GAIN: 0.8 * span, T1: round4(50 * steps), DEAD: round4(2 * steps) },
        [PLANT.MOTOR]: { GAIN: 24, T1: 26, T2: 4 },
    }[kind] };
}

// What full drive moves the measurement by; of an integrator a part of the sensor.
function rangeOfDrive(s) {
    const reach = { [PLANT.MOTOR]: s.GAIN / 0.05, [PLANT.INTEGRATOR]: Math.sign(s.GAIN) * 0.4 * s.SENSOR_RANGE };
    return reach[s.PLANT] ?? s.GAIN;
}

// A scene for this plant with its first gains, as sceneOfPlant has it.
export function withPlant(s, plant) {
    const next = sceneOfPlant(s, plant);
    return { ...next, ...gainsFor(next) };
}

// A scene for this plant: `plant` has PLANT, GAIN and what else is of a plant, and maybe
// its unit. The sensor, the output, the rate and its direction, if that was set, stay.
export function sceneOfPlant(s, plant) {
    const next = { ...s, ...plant };
    const [low, high] = [next.SENSOR_LOW, next.SENSOR_LOW + next.SENSOR_RANGE];
    const reach = rangeOfDrive(next);
    const inside = (value) => round4(Math.min(high, Math.max(low, value)));
    const seconds = round4(Math.min(12 * scaleSeconds(next), LIMIT.STEPS / next.RATE));
    return {
        ...next,
        OPTIONS: next.GAIN < 0 ? next.OPTIONS | OPTION.REVERSE : next.OPTIONS,
        DURATION: seconds, NOISE: s.NOISE,
        SETPOINT: inside(next.START + reach / 2),
        events: [{ at: round4(0.4 * seconds), what: 'SETPOINT', a: inside(next.START + 0.65 * reach) },
            { at: round4(0.72 * seconds), what: 'LOAD', a: -0.1 }],
    };
}
