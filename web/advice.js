// SPDX-License-Identifier: MIT
// What a person should know of these settings: what the controller refuses, and
// where a gain is coarse, the loop has little margin or the sensor ends.
import { CONTROLLER, LIMIT, OPTION, PLANT } from './built.js';
import { digits, percent, time, whole } from './format.js';
import { scaleSeconds } from './margins.js';
import { actsWrongly, notesLimits } from './own.js';

const COARSE = 50; // below it a step of the integer is more than 2 %
const LIMIT_16 = 32767;
const KI_LEAST = 8; // of 2^24

function pidRefusals(s, r) {
    const found = [];
    const say = (yes, text) => yes && found.push(text);
    say(s.KP < 0 || s.KI < 0 || s.KD < 0, 'A gain is below 0: turn the sign with “reverse acting”.');
    say(r.KP > LIMIT.KP, `kp is above 127.996: scale the sensor or the actuator.`);
    say(s.KP > 0 && r.KP === 0, 'kp rounds to 0: the smallest is 0.00195.');
    say(r.KI > LIMIT.KI, 'ki is above 127.996 per step.');
    say(s.KI > 0 && r.KI < KI_LEAST, `ki is below 8 / 2²⁴ per step: sample more slowly, or give the actuator more counts.`);
    say(r.KD > LIMIT.KD, 'kd times the rate is above 125.996: raise the derivative filter.');
    say(s.KD > 0 && r.KD === 0, 'kd rounds to 0 at this rate and filter.');
    say(!(s.FILTER >= 0 && s.FILTER <= 7), 'The derivative filter is 0 to 7.');
    say(s.WEIGHT * 256 < 0.5 && (s.OPTIONS & OPTION.PROPORTIONAL_ON_MEASUREMENT) === 0,
        'A setpoint weight of 0 is the option “P on the measurement”.');
    say(s.WEIGHT > 1.0019, 'The setpoint weight is at most 1.');
    say(s.OUTPUT_MIN >= s.OUTPUT_MAX, 'The lowest output must be below the highest.');
    say(s.INTEGRAL_MIN < -LIMIT_16, 'The integral’s lowest value is −32767 or more.');
    say(s.INTEGRAL_MIN > s.INTEGRAL_MAX, 'The integral’s lowest value is above its highest.');
    return found;
}

function refusals(s, r) {
    const found = s.CONTROLLER === CONTROLLER.PID ? pidRefusals(s, r)
        : [`A value is out of range: gains are 0 to ${s.CONTROLLER === CONTROLLER.AN937 ? 255 : 1023}.`];
    return found.length > 0 ? found : ['A value is out of range.'];
}

function coarse(name, integer, least) {
    if (integer === 0 || integer >= COARSE) {
        return [];
    }
    return [`${name} is ${integer} steps of ${least}: the next value is ${percent(1 / integer, 0)} away.`];
}

function pidAdvice(r) {
    return [...coarse('kp', r.KP, '1/256'), ...coarse('ki', r.KI, '1/2²⁴'), ...coarse('kd', r.KD, '1/256')];
}

function notesAdvice(r, s) {
    const least = s.CONTROLLER === CONTROLLER.AN937 ? '1/16' : '1/1023';
    const ends = s.PLANT === PLANT.PENDULUM || s.preset === 'an937' ? [] : notesLimits(s);
    return [...ends, ...['KP', 'KI', 'KD'].flatMap((name) => (r[name] < 10 ? coarse(name.toLowerCase(), r[name], least) : []))];
}

function loopAdvice(s, margins) {
    if (!margins.stable) {
        return ['The loop is unstable near its setpoint: what is seen is held by the limits.'];
    }
    if (margins.ms > 2.2) {
        return [`Little margin: Ms ${digits(margins.ms)} is above 2.2; small changes of the plant make it swing.`];
    }
    return [];
}

function sceneAdvice(s, run) {
    const found = [];
    if (actsWrongly(s)) {
        found.push('More output moves this plant away from its setpoint: change “reverse acting” or the sign of its gain.');
    }
    const high = s.SENSOR_LOW + s.SENSOR_RANGE;
    const goals = [s.SETPOINT, ...s.events.filter((event) => event.what === 'SETPOINT').map((event) => event.a)];
    if (s.PLANT !== PLANT.PENDULUM && goals.some((goal) => goal > high || goal < s.SENSOR_LOW)) {
        found.push('A setpoint lies beyond the sensor’s range and is taken as its end.');
    }
    if (s.DURATION * s.RATE > LIMIT.STEPS) {
        found.push(`Shown are the first ${whole(LIMIT.STEPS)} steps.`);
    }
    if (s.PLANT < PLANT.MOTOR && scaleSeconds(s) * s.RATE < 8) {
        found.push('The plant is only a few steps long: sample faster.');
    }
    const settling = run.series.MEASUREMENT.at(-1);
    if (settling >= 2 ** s.SENSOR_BITS - 1 || (settling <= 0 && run.series.SETPOINT.at(-1) > 0)) {
        found.push('The measurement ends at the end of the sensor.');
    }
    return found;
}

// { refused: texts, warnings: texts }.
export function adviceOf(s, run, margins) {
    if (run.n < 0) {
        return { refused: refusals(s, run.results), warnings: [] };
    }
    const own = s.CONTROLLER === CONTROLLER.PID ? pidAdvice : notesAdvice;
    return { refused: [], warnings: [...own(run.results, s), ...loopAdvice(s, margins), ...sceneAdvice(s, run)] };
}

// Beside the labels of the gains: the times that other controllers have in their place.
export function notesOf(s) {
    const [ti, td] = [s.KI, s.KD].map((gain) => s.CONTROLLER === CONTROLLER.PID && s.KP > 0 && gain > 0);
    return { KI: ti ? `Ti ${time(s.KP / s.KI)}` : '', KD: td ? `Td ${time(s.KD / s.KP)}` : '' };
}
