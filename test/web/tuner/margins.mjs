// SPDX-License-Identifier: MIT
// A run and its margins: what the C does around the library, done here again; the plant and the
// margins against the loop in time, and the frequency response against a lag's by its formula.
import { check, checkNone, finish, loopByFormula, moduleOf, msByFormula } from './harness.mjs';

const { run, startEngine } = await moduleOf('engine');
const { OFF, controllerOf, isStable, linearResponse, marginsOf, responseSteps, sampledPlant } = await moduleOf('margins');
const { bodeOf, bodeText, betweenAngles, offText } = await moduleOf('response');
const { calmGains } = await moduleOf('calm');
const { PRESETS, ofLink, presetState, withController, withinReason } = await moduleOf('state');
await startEngine();

// --- A run --------------------------------------------------------------------
// From the numbers beside it: the sensor, the error of each note's controller, and the
// pendulum's drift offset.
function runFaults(preset) {
    const state = { ...preset, NOISE: 0 };
    const { n, results, series } = run(state);
    const top = 2 ** state.SENSOR_BITS - 1;
    const counts = (units) => Math.min(top, Math.max(0, Math.floor((units - state.SENSOR_LOW) / state.SENSOR_RANGE * top + 0.5)));
    const faults = [];
    let drift = 0;
    for (let i = 0; i < n; i++) {
        const [r, y, p] = [series.SETPOINT[i], series.MEASUREMENT[i], series.P[i]];
        const wanted = { an937: results.KP * 4 * (r - y), an964: y + Math.trunc(drift / 8) - 512 }[preset.preset] ?? p;
        if (y !== counts(series.VALUE_TRUE[i]) || p !== wanted) {
            faults.push(`step ${i}: ${y} of ${series.VALUE_TRUE[i]}, P ${p}, not ${wanted}`);
        }
        drift = Math.min(55, Math.max(-55, drift + Math.sign(series.OUTPUT[i])));
    }
    return faults;
}

// The twin rounds nothing; where nothing has to be rounded it is the library itself.
function twinDistance(state) {
    const { series } = run(state);
    const counts = (2 ** state.SENSOR_BITS - 1) / state.SENSOR_RANGE;
    return series.VALUE_TRUE.reduce((most, value, i) => Math.max(most, Math.abs(value - series.VALUE_TWIN[i]) * counts), 0);
}

// The plant behind the margins is the C's: with the outputs of a run it moves as that did.
// (Without friction, and where a sine is its angle.)
function plantDistance(preset) {
    const pendulum = preset.preset === 'an964';
    const state = { ...preset, events: [], ...(pendulum ? { START: 1, DURATION: 0.5 } : {}), ...(['motor', 'an937'].includes(preset.preset) ? { T2: 0 } : {}) };
    const { n, results, series } = run(state);
    const plant = sampledPlant(state, results.DEAD_S);
    const start = state.START * Math.PI / 180;
    let x = pendulum ? [start, 0, 0, start, 0] : plant.phi.map(() => 0);
    const rest = pendulum ? 0 : series.VALUE_TRUE[0];
    const perCount = state.SENSOR_RANGE / (2 ** state.SENSOR_BITS - 1);
    let [away, most] = [0, 0];
    for (let i = 0; i < n; i++) {
        const y = plant.out.reduce((sum, c, k) => sum + c * x[k], 0) * perCount;
        away = Math.max(away, Math.abs(y - (series.VALUE_TRUE[i] - rest)));
        most = Math.max(most, Math.abs(series.VALUE_TRUE[i] - rest));
        const [u, u1] = [series.OUTPUT[i - plant.steps] ?? 0, series.OUTPUT[i - plant.steps - 1] ?? 0];
        x = plant.phi.map((row, k) => row.reduce((sum, p, j) => sum + p * x[j], 0) + plant.now[k] * u + plant.before[k] * u1);
    }
    return away / most;
}

const TWINS = { // counts, and what of the scene is another
    oven: [2], flow: [2], spring: [2], axis: [2], motor: [2], own: [2], an937: [0],
    an964: [3, { NOISE: 0, DURATION: 0.5, KI: 16, events: [] }],
};
for (const preset of PRESETS) {
    checkNone(`${preset.preset}: its counts are those of its values`, runFaults(preset));
    const [most, more] = TWINS[preset.preset];
    const away = twinDistance({ ...preset, ...more });
    check(`${preset.preset}: the twin is ${away.toFixed(3)} counts away`, away <= most, `more than ${most}`);
    const plant = plantDistance(preset);
    check(`${preset.preset}: the margins’ plant is the simulated one within ${(100 * plant).toFixed(3)} %`, plant < 0.002);
}

// --- Against the loop in time ------------------------------------------------------
// The gain margin is where the loop in time stops being stable, and so is the dead time that
// the phase margin stands for; Ms is the largest of the Fourier transform of what is left of a push.
function marginFaults(s) {
    const { results } = run(s);
    const margins = marginsOf(s, results);
    const plant = sampledPlant(s, results.DEAD_S);
    const controller = controllerOf(s, results);
    const n = responseSteps(s, results);
    const stable = (factor) => isStable(plant, controller, factor, n);
    const later = (part) => isStable(sampledPlant(s, results.DEAD_S + part * margins.delayMargin), controller, 1, 2 * n);
    const seen = linearResponse(plant, controller, 1, n);
    let ms = 0;
    for (let k = 1; k <= 1500; k++) {
        const w = 0.002 * (Math.PI / 0.002) ** (k / 1500);
        let [re, im] = [0, 0];
        for (let i = 0; i < n; i++) {
            re += seen[i] * Math.cos(w * i);
            im -= seen[i] * Math.sin(w * i);
        }
        ms = Math.max(ms, Math.hypot(re, im));
    }
    const { gainMargin, lowerGainMargin, delayMargin } = margins;
    return Object.entries({
        stable: margins.stable && stable(1),
        [`Ms ${margins.ms}, in time ${ms}`]: Math.abs(ms / margins.ms - 1) < 0.02,
        [`gain margin ${gainMargin}`]: gainMargin === null || (stable(0.97 * gainMargin) && !stable(1.03 * gainMargin)),
        [`dead time margin ${delayMargin} s`]: later(0.97) && !later(1.03),
        [`lower gain margin ${lowerGainMargin}`]: (s.preset === 'an964') === (lowerGainMargin !== null) &&
            (lowerGainMargin === null || (stable(1.03 * lowerGainMargin) && !stable(0.97 * lowerGainMargin))),
    }).filter(([, good]) => !good).map(([name]) => name);
}

// AN937's derivative has a period: its preset's margins are those of the mean.
const notes = ['flow', 'own', 'motor'].flatMap((id) => [1, 2].map((controller) => withinReason(withController(presetState(id), controller))));
for (const s of [...PRESETS.filter(({ preset }) => preset !== 'an937'), ...notes]) {
    checkNone(`${s.preset}, controller ${s.CONTROLLER}: margins are the loop’s in time`, marginFaults(s));
}
const unstable = { ...presetState('flow'), KP: 6 };
check('a loop with too much gain is unstable', !marginsOf(unstable, run(unstable).results).stable);

let [stays, becomes] = [0, 0];
const differ = [];
for (const { preset } of PRESETS.filter((one) => one.preset !== 'an937')) {
    for (const factor of [0.3, 1, 1.7, 3, 5]) {
        const s = ofLink(`p=${preset}`);
        s.KP *= s.CONTROLLER === 0 ? factor : 1;
        const { results } = run(s);
        const margins = marginsOf(s, results);
        const plant = sampledPlant(s, results.DEAD_S);
        const inTime = [1 - OFF, 1, 1 + OFF].every((gain) => isStable(plant, controllerOf(s, results), gain, responseSteps(s, results)));
        [stays, becomes] = [stays + Number(inTime), becomes + Number(margins.stable && !inTime)];
        differ.push(...(inTime === margins.off.stable ? [] : [`${preset} with ${s.KP}`]));
    }
}
checkNone(`a gain that is off leaves ${stays} loops stable, and ${becomes} not`, [...differ, ...(stays > 5 && becomes > 1 ? [] : ['too few of a kind'])]);

// --- By the formula ------------------------------------------------------------------------
const LAG = { ...presetState('own'), GAIN: 100, T1: 10, T2: 0, SENSOR_BITS: 12, SENSOR_RANGE: 100, OUTPUT_MAX: 1000, RATE: 10 };
const SWINGS = { KP: 0.49, KI: 0.49, KD: 0 }; // so much integral that less gain is worse
for (const [name, dead, more] of [['ten steps of dead time', 1, {}], ['a part of a step', 0.137, {}], ['500 steps', 50, {}], ['much integral', 0.1, SWINGS]]) {
    const s = { ...LAG, DEAD: dead, ...calmGains({ ...LAG, DEAD: dead }, 1), ...more };
    const { results } = run(s);
    const margins = marginsOf(s, results);
    const plant = { gain: 4.095, lag: 10, dead: results.DEAD_S, rate: 10 };
    const gains = { kp: results.KP / 256, ki: results.KI / 2 ** 24 };
    const at = (w) => loopByFormula(plant, gains, Math.min(w, Math.PI)); // the last one is π but for its last bit
    const { decibels, degrees } = bodeOf(margins);
    const away = margins.angles.map((w, i) => [Math.abs(decibels[i] - 20 * Math.log10(at(w).size)), Math.abs(degrees[i] - at(w).angle * 180 / Math.PI)]);
    const [size, angle] = [0, 1].map((k) => Math.max(...away.map((one) => one[k])));
    check(`${name}: all of Bode’s ${away.length} points`, away.length > 400 && size < 1e-6 && angle < 1e-5, `${size} dB, ${angle} degrees away`);
    const [crossing, turning] = [at(margins.crossover), at(margins.turnover)];
    check(`${name}: the crossover, with ${margins.phaseMargin.toFixed(2)} degrees`, Math.abs(crossing.size - 1) < 1e-6 && Math.abs(crossing.angle * 180 / Math.PI + 180 - margins.phaseMargin) < 1e-4 &&
        Math.abs(betweenAngles(degrees, margins.angles, margins.crossover) - crossing.angle * 180 / Math.PI) < 0.05, JSON.stringify(crossing));
    check(`${name}: −180 degrees, with a gain margin of ${margins.gainMargin.toFixed(3)}`, Math.abs(turning.angle + Math.PI) < 1e-6 && Math.abs(1 / turning.size / margins.gainMargin - 1) < 1e-6, JSON.stringify(turning));
    // Each gain from 20 % below to 20 % above, one after the other.
    const worst = Math.max(...Array.from({ length: 17 }, (_, i) => msByFormula({ ...plant, gain: plant.gain * (0.8 + 0.025 * i) }, gains, 8000)));
    check(`${name}: Ms of the worst gain within ${100 * OFF} % is ${margins.off.ms.toFixed(3)}`, Math.abs(margins.off.ms / worst - 1) < 0.005, `not ${worst}`);
}

// --- In words --------------------------------------------------------------------------------
for (const [link, off, bode] of [['p=oven', /^With the plant’s gain up to 20 % off, the shaded band, the loop stays stable and Ms is at most 1\.\d\d\.$/,
    /^Bode plot of the loop: its gain is 1 at 0\.\d+ rad\/s, \d\d° from −180°; −180° are at 0\.\d+ rad\/s, \d+\.\d dB below 1$/],
['p=flow&kp=2', /the loop becomes unstable\.$/, /^Bode/], ['p=flow&kp=4', /^$/, /^Bode plot of the loop, which is unstable$/], ['p=flow&kp=0.1&ki=0&kd=0', /./, /its gain is 1 at no frequency/]]) {
    const s = ofLink(link);
    const margins = marginsOf(s, run(s).results);
    check(`in words: ${link}`, off.test(offText(margins)) && bode.test(bodeText(margins, s.RATE)), `${offText(margins)} ${bodeText(margins, s.RATE)}`);
}
await finish();
