// SPDX-License-Identifier: MIT
// The margins of the sampled loop near its setpoint, as sim/tuner/margins.h computes them of
// the scene's plant and the controller's integers; and what of them is the page's alone.
import { PLANT, RESULT } from './built.js';
import { exported, put, sceneOf } from './engine.js';
import { doubles, room, read, sizeOf, write } from './structs.js';

// How far a plant's gain may be off, as a part of it, for the worst case.
export const OFF = 0.2;

function putLoop(s, results) {
    put(sceneOf(s));
    const integers = doubles(exported().tuner_results(), Object.keys(RESULT).length);
    ['KP', 'KI', 'KD', 'FILTER'].forEach((name) => {
        integers[RESULT[name]] = results[name];
    });
}

// { ms, gainMargin, lowerGainMargin, phaseMargin (degrees),
// delayMargin (seconds of further dead time), stable, crossover and turnover: where phase
// and gain margin are, in radians per step; off: { ms, stable } of the worst gain within
// OFF; curve: the loop's points at `angles`, and steps of dead time in them }.
// A margin that there is none of is null: no gain makes such a loop swing.
export function marginsOf(s, results) {
    putLoop(s, results);
    const at = room(sizeOf('loop_margins'));
    exported().tuner_margins(at);
    const found = read('loop_margins', at);
    const some = (value) => (value < 0 ? null : value);
    return {
        ms: found.ms, gainMargin: some(found.gain), lowerGainMargin: some(found.lowerGain),
        phaseMargin: some(found.phaseDegrees), delayMargin: some(found.delayS), stable: found.stable,
        crossover: some(found.crossover), turnover: some(found.turnover),
        off: { ms: found.offMs, stable: found.offStable },
        curve: Array.from(found.re, (re, i) => [re, found.im[i]]), angles: [...found.angles], steps: found.deadSteps,
    };
}

// Ms of the same controller with each of these plants of identify.js, in the order of their
// size; Infinity of a loop that is unstable. `full` is the recording's drive at the highest output.
export function msOfEach(s, results, plants, full) {
    putLoop(s, results);
    const at = room(sizeOf('identify_plant'));
    return plants.map((plant) => {
        write('identify_plant', at, plant);
        const ms = exported().tuner_ms(at, full);
        return ms < 0 ? Infinity : ms;
    }).sort((a, b) => a - b);
}

// What AN937's loop passes on of one count: its motor's 1023 counts are 4000.
export function errorPerCount(s) {
    return s.PLANT === PLANT.MOTOR ? 4 : 1;
}

// The time that matters to the controller: dead time and lags. As tuner_scale_s has it, but
// before there is an engine, too.
export function scaleSeconds(s) {
    switch (s.PLANT) {
    case PLANT.MOTOR: return 2.4 * s.T1 * 1e-6 / 0.0025;
    case PLANT.PENDULUM: return Math.sqrt(s.T2 / 9.81);
    case PLANT.INTEGRATOR: return 2 * (s.DEAD + s.T2) + 4 / s.RATE;
    case PLANT.OSCILLATOR: return s.T1 / Math.max(s.DAMPING, 0.05) + s.DEAD;
    default: return s.T1 + s.T2 + s.DEAD;
    }
}

// Counts of measurement per count of output, at rest; of an integrator, after
// the time that matters.
export function countsGain(s) {
    const most = Math.max(s.OUTPUT_MAX, -s.OUTPUT_MIN);
    const top = 2 ** s.SENSOR_BITS - 1;
    const perDrive = { [PLANT.MOTOR]: s.GAIN / 0.05, [PLANT.PENDULUM]: 60,
        [PLANT.INTEGRATOR]: s.GAIN * scaleSeconds(s) }[s.PLANT] ?? s.GAIN;
    return Math.abs(perDrive * top / s.SENSOR_RANGE / most);
}
