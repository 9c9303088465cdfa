// SPDX-License-Identifier: MIT
// The frequency response and what is said of it, against a lag's by its formula, and of a
// gain that is off against the loop in time; its pictures in the browser.
import { loopByFormula, msByFormula } from './formula.mjs';
import { check, checkNone, finish, frame, moduleOf, open, text } from './harness.mjs';

const { bodeOf, bodeText, betweenAngles, offText } = await moduleOf('response');
const { OFF, controllerOf, isStable, marginsOf, responseSteps, sampledPlant } = await moduleOf('margins');
const { calmGains } = await moduleOf('calm');
const { PRESETS, ofLink, presetState } = await moduleOf('state');
const { run, startEngine } = await moduleOf('engine');
await startEngine();

const LAG = { ...presetState('own'), GAIN: 100, T1: 10, T2: 0, SENSOR_BITS: 12, SENSOR_RANGE: 100, OUTPUT_MAX: 1000, RATE: 10 };
const marginsFor = (s) => {
    const { results } = run(s);
    return { results, margins: marginsOf(s, results) };
};

// --- By the formula ------------------------------------------------------------------------
const SWINGS = { KP: 0.49, KI: 0.49, KD: 0 }; // so much integral that less gain is worse
for (const [name, dead, more] of [['ten steps of dead time', 1, {}], ['a part of a step', 0.137, {}], ['500 steps', 50, {}], ['much integral', 0.1, SWINGS]]) {
    const s = { ...LAG, DEAD: dead, ...calmGains({ ...LAG, DEAD: dead }, 1), ...more };
    const { results, margins } = marginsFor(s);
    const plant = { gain: 4.095, lag: 10, dead: results.DEAD_S, rate: 10 };
    const gains = { kp: results.KP / 256, ki: results.KI / 2 ** 24 };
    const at = (w) => loopByFormula(plant, gains, Math.min(w, Math.PI)); // the last one is π but for its last bit
    const { decibels, degrees } = bodeOf(margins);
    const away = margins.angles.map((w, i) => [Math.abs(decibels[i] - 20 * Math.log10(at(w).size)), Math.abs(degrees[i] - at(w).angle * 180 / Math.PI)]);
    const [size, angle] = [0, 1].map((k) => Math.max(...away.map((one) => one[k])));
    check(`${name}: all of Bode’s ${away.length} points`, away.length > 400 && size < 1e-6 && angle < 1e-5, `${size} dB, ${angle} degrees away`);
    const [crossing, turning] = [at(margins.crossover), at(margins.turnover)];
    check(`${name}: the crossover, with ${margins.phaseMargin.toFixed(2)} degrees`, Math.abs(crossing.size - 1) < 1e-6 &&
        Math.abs(crossing.angle * 180 / Math.PI + 180 - margins.phaseMargin) < 1e-4, JSON.stringify(crossing));
    check(`${name}: −180 degrees, with a gain margin of ${margins.gainMargin.toFixed(3)}`, Math.abs(turning.angle + Math.PI) < 1e-6 &&
        Math.abs(1 / turning.size / margins.gainMargin - 1) < 1e-6, JSON.stringify(turning));
    check(`${name}: between the points`, Math.abs(betweenAngles(degrees, margins.angles, margins.crossover) - crossing.angle * 180 / Math.PI) < 0.05);
    // Each gain from 20 % below to 20 % above, one after the other.
    const every = Array.from({ length: 17 }, (_, i) => msByFormula({ ...plant, gain: plant.gain * (0.8 + 0.025 * i) }, gains, 8000));
    check(`${name}: Ms of the worst gain within ${100 * OFF} % is ${margins.off.ms.toFixed(3)}`, Math.abs(margins.off.ms / Math.max(...every) - 1) < 0.005, `not ${Math.max(...every)}`);
}

// --- Against the loop in time ---------------------------------------------------------------
let [stays, becomes] = [0, 0];
const differ = [];
for (const { preset } of PRESETS.filter((one) => one.preset !== 'an937')) { // its derivative is a mean there
    for (const factor of [0.3, 1, 1.7, 3, 5]) {
        const s = ofLink(`p=${preset}`);
        s.KP *= s.CONTROLLER === 0 ? factor : 1;
        const { results, margins } = marginsFor(s);
        const plant = sampledPlant(s, results.DEAD_S);
        const inTime = [1 - OFF, 1, 1 + OFF].every((gain) => isStable(plant, controllerOf(s, results), gain, responseSteps(s, results)));
        [stays, becomes] = [stays + Number(inTime), becomes + Number(margins.stable && !inTime)];
        differ.push(...(inTime === margins.off.stable ? [] : [`${preset} with ${s.KP}`]));
    }
}
checkNone(`a gain that is off leaves ${stays} loops stable, and ${becomes} not`, [...differ, ...(stays > 5 && becomes > 1 ? [] : ['too few of a kind'])]);

// --- In words --------------------------------------------------------------------------------
const said = (link) => {
    const s = ofLink(link);
    const { margins } = marginsFor(s);
    return [offText(margins), bodeText(margins, s.RATE)];
};
check('a good loop', /^With the plant’s gain up to 20 % off, the shaded band, the loop stays stable and Ms is at most 1\.\d\d\.$/.test(said('p=oven')[0]), said('p=oven')[0]);
check('its crossover and −180 degrees', /^Bode plot of the loop: its gain is 1 at 0\.\d+ rad\/s, \d\d° from −180°; −180° are at 0\.\d+ rad\/s, \d+\.\d dB below 1$/.test(said('p=oven')[1]), said('p=oven')[1]);
check('one that becomes unstable', said('p=flow&kp=2')[0].endsWith('the loop becomes unstable.'), said('p=flow&kp=2')[0]);
check('one that is unstable', said('p=flow&kp=4').join() === ',Bode plot of the loop, which is unstable', said('p=flow&kp=4').join());
check('one whose gain is never 1', said('p=flow&kp=0.1&ki=0&kd=0')[1].includes('its gain is 1 at no frequency'), said('p=flow&kp=0.1&ki=0&kd=0')[1]);

// --- In the browser ---------------------------------------------------------------------------
const here = await open('p=flow');
const picture = (id) => here.evaluate((one) => document.querySelector(one).toDataURL(), id);
const blank = (id) => here.evaluate((one) => {
    const canvas = document.querySelector(one);
    return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.every((byte) => byte === 0);
}, id);
for (const id of ['#nyquist', '#bode']) {
    const first = await picture(id);
    check(`${id} is drawn`, !(await blank(id)));
    await here.fill('#c-kp', id === '#bode' ? '0.9' : '0.3');
    await frame(here);
    check(`${id} follows a gain`, await picture(id) !== first);
}
check('what a gain that is off does is said beside it', /20 % off/.test(await text(here, '#off')));
check('a reader hears of Bode’s plot', (await here.getAttribute('#bode', 'aria-label')).startsWith('Bode plot of the loop: its gain is 1 at'));
await here.fill('#c-kp', '900');
await frame(here);
check('of refused gains nothing is left', await blank('#bode') && await blank('#nyquist') && (await text(here, '#off')) === '');
checkNone('no error', here.noted.errors);
await finish();
